// Charts of errors over the work done: one per scene (or other subject), for the chosen metric and
// axis.

const kAxisTitles = { samples: "samples a pixel", seconds: "seconds", points: "points" };
let charts = [];

const chosenCurves = (metric, axis) =>
  report.curves.filter((curve) => curve.metric === metric && curve.axis === axis);

/** Returns the points that a logarithmic axis can show. */
const drawnPoints = (curve) =>
  curve.points
    .map((point) => ({ x: toNumber(point.x), y: toNumber(point.y), interval: toInterval(point.interval) }))
    .filter((point) => point.x > 0 && point.y > 0 && Number.isFinite(point.x * point.y))
    .sort((a, b) => a.x - b.x);

/** Returns the range from a little below to a little above the values, all of them positive. */
function padded(values, factor) {
  return { min: Math.min(...values) / factor, max: Math.max(...values) * factor };
}

/** Returns the ranges {x, y} of the axes, which contain all points and the ends of their intervals. */
function rangesOf(curves) {
  const points = curves.flatMap(drawnPoints);
  const ends = points.flatMap((point) =>
    [point.y, point.interval?.low, point.interval?.high].filter((y) => y > 0 && Number.isFinite(y)));
  return { x: padded(points.map((point) => point.x), 1.2), y: padded(ends, 1.4) };
}

/** Returns the datasets of the curve and of the two edges of its band. The legend does not list the edges. */
function datasetsOf(curve, range) {
  const look = methodLook(curve.method);
  const points = drawnPoints(curve);
  const inside = (y) => Math.min(range.max, Math.max(range.min, y));
  const edge = (end) => ({
    data: points.filter((point) => point.interval)
      .map((point) => ({ x: point.x, y: inside(point.interval[end]) })),
    borderWidth: 0, pointRadius: 0, pointHitRadius: 0, backgroundColor: look.color + "33",
  });
  return [
    { label: curve.method, data: points, borderColor: look.color, backgroundColor: look.color,
      borderWidth: 2, pointStyle: look.point, pointRadius: 4, pointHoverRadius: 6 },
    { ...edge("low"), band: true },
    { ...edge("high"), band: true, fill: "-1" },
  ];
}

function logAxis(title, ink, line, limits) {
  // Labels decades. If there are only a few decades, it also labels 2 and 5 within each.
  const digits = Math.log10(limits.max / limits.min) > 1.7 ? [1] : [1, 2, 5];
  const label = (value) => {
    const exponent = Math.floor(Math.log10(value) + 1e-9);
    const leading = value / 10 ** exponent;
    const digit = Math.round(leading);
    // A value without a label has no grid line either.
    if (!digits.includes(digit) || Math.abs(leading - digit) > 1e-6) return null;
    return digit === 1 && commonExponent(value) !== 0 ? powerOfTen(exponent) : formatNumber(value, 1);
  };
  return {
    type: "logarithmic", ...limits,
    title: { display: true, text: title, color: ink },
    grid: { color: line, borderColor: ink },
    ticks: { color: ink, maxRotation: 0, autoSkip: false, callback: label },
  };
}

function chartOptions(table, axis, ranges, color) {
  const [ink, line] = [color("--quiet"), color("--line")];
  const unit = table.unit ? ` [${table.unit}]` : "";
  return {
    animation: false, maintainAspectRatio: false, color: ink,
    interaction: { mode: "nearest", intersect: false },
    scales: {
      x: logAxis(kAxisTitles[axis], ink, line, ranges.x),
      y: logAxis(table.title + unit, ink, line, ranges.y),
    },
    plugins: {
      legend: { display: false },
      tooltip: {
        filter: (item) => !item.dataset.band,
        callbacks: {
          title: (items) => (items.length ? `${formatNumber(items[0].raw.x)} ${kAxisTitles[axis]}` : ""),
          label: (item) => {
            const { y, interval } = item.raw;
            return `${item.dataset.label}: ${formatNumber(y)}` +
              (interval ? ` ${formatInterval(interval, y)}` : "");
          },
        },
      },
    },
  };
}

function slopeText(curve) {
  const slope = toNumber(curve.slope);
  if (Number.isNaN(slope)) return "";
  const interval = toInterval(curve.slope_interval);
  const [text, low, high] = [slope, interval?.low, interval?.high].map((value) => fixed(value, 2));
  return `slope ${text}` + (interval ? ` [${low}, ${high}]` : "");
}

/** Returns buttons that show and hide curves, with the slopes of the curves. */
function legend(curves, chart) {
  return make("ul", { className: "legend" }, ...curves.map((curve, i) => {
    const button = make("button", { type: "button" }, mark(curve.method), curve.method,
      make("span", { className: "slope" }, slopeText(curve)));
    button.setAttribute("aria-pressed", "true");
    button.addEventListener("click", () => {
      const shown = button.getAttribute("aria-pressed") !== "true";
      button.setAttribute("aria-pressed", String(shown));
      for (const part of [0, 1, 2]) chart().setDatasetVisibility(3 * i + part, shown);
      chart().update();
    });
    return make("li", {}, button);
  }));
}

function sceneChart(scene, curves, table, axis) {
  const canvas = make("canvas");
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", `${table.title} over ${kAxisTitles[axis]} on ${scene}: ` +
    curves.map((curve) => `${curve.method} ${slopeText(curve)}`).join(", "));
  let chart = null;
  const figure = make("figure", {}, make("div", { className: "chart-title" }, scene),
    make("div", { className: "chart" }, canvas), legend(curves, () => chart));
  const draw = () => {
    const style = getComputedStyle(document.documentElement);
    const ranges = rangesOf(curves);
    const options = chartOptions(table, axis, ranges, (name) => style.getPropertyValue(name).trim());
    const datasets = curves.flatMap((curve) => datasetsOf(curve, ranges.y));
    if (chart === null) {
      chart = new Chart(canvas, { type: "line", data: { datasets }, options });
    } else {
      chart.data.datasets.forEach((dataset, i) => Object.assign(dataset, datasets[i]));
      chart.options = options;
      chart.update();
    }
  };
  return { figure, draw, destroy: () => chart.destroy() };
}

function showCharts() {
  const table = report.tables.find((candidate) => candidate.key === find("curve-metric").value);
  const axis = find("curve-axis").value;
  const curves = chosenCurves(table.key, axis);
  for (const chart of charts) chart.destroy();
  const scenes = [...new Set(curves.map((curve) => curve.scene))];
  charts = scenes.map((scene) =>
    sceneChart(scene, curves.filter((curve) => curve.scene === scene), table, axis));
  find("charts").replaceChildren(...charts.map((chart) => chart.figure));
  for (const chart of charts) chart.draw();
}

/** Offers the axes for which the metric has curves. */
function offerAxes() {
  const metric = find("curve-metric").value;
  const select = find("curve-axis");
  const before = select.value;
  const axes = Object.keys(kAxisTitles).filter((axis) => chosenCurves(metric, axis).length > 0);
  fillSelect(select, axes.map((axis) => [axis, kAxisTitles[axis]]));
  if (axes.includes(before)) select.value = before;
}

function startCharts() {
  if (report.curves.length === 0) return false;
  const metrics = new Set(report.curves.map((curve) => curve.metric));
  fillSelect(find("curve-metric"),
    report.tables.filter((table) => metrics.has(table.key)).map((table) => [table.key, table.title]));
  Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
  find("curve-metric").addEventListener("change", () => (offerAxes(), showCharts()));
  find("curve-axis").addEventListener("change", showCharts);
  onTheme(() => charts.forEach((chart) => chart.draw()));
  offerAxes();
  showCharts();
  return true;
}
