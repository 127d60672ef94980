// Errors over the work done: a chart for each scene, of the chosen metric and axis.

const kAxisTitles = { samples: "samples a pixel", seconds: "seconds" };
let charts = [];

const chosenCurves = (metric, axis) =>
  report.curves.filter((curve) => curve.metric === metric && curve.axis === axis);

/** Points that a logarithmic axis can show. */
const drawnPoints = (curve) =>
  curve.points
    .map((point) => ({ x: toNumber(point.x), y: toNumber(point.y), interval: toInterval(point.interval) }))
    .filter((point) => point.x > 0 && point.y > 0 && Number.isFinite(point.x * point.y))
    .sort((a, b) => a.x - b.x);

/** From a little below to a little above all points and the ends of their intervals. */
function verticalRange(curves) {
  const ends = curves.flatMap((curve) =>
    drawnPoints(curve).flatMap((point) =>
      [point.y, point.interval?.low, point.interval?.high].filter((y) => y > 0 && Number.isFinite(y))));
  return { min: Math.min(...ends) / 1.4, max: Math.max(...ends) * 1.4 };
}

/** The curve and the two edges of its band, which no legend names. */
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

function logAxis(title, ink, line, limits = {}) {
  return {
    type: "logarithmic", ...limits,
    title: { display: true, text: title, color: ink },
    border: { color: ink },
    grid: { color: line },
    ticks: {
      color: ink, maxRotation: 0, autoSkip: true,
      // Decades and what lies well between them; more would crowd.
      callback: (value) => {
        const digit = Math.round(value / 10 ** Math.floor(Math.log10(value) + 1e-9));
        return [1, 2, 5].includes(digit) ? formatNumber(value, 1) : "";
      },
    },
  };
}

function chartOptions(table, axis, range, color) {
  const [ink, line] = [color("--quiet"), color("--line")];
  const unit = table.unit ? ` [${table.unit}]` : "";
  return {
    animation: false, maintainAspectRatio: false, color: ink,
    font: { family: "inherit" },
    interaction: { mode: "nearest", intersect: false },
    scales: {
      x: logAxis(kAxisTitles[axis], ink, line),
      y: logAxis(table.title + unit, ink, line, range),
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
  return `slope ${formatNumber(slope, 3)}` + (interval ? ` ${formatInterval(interval, slope)}` : "");
}

/** Buttons that show and hide curves, with their slopes. */
function legend(curves, chart) {
  return make("ul", { className: "legend" }, ...curves.map((curve, i) => {
    const button = make("button", { type: "button" }, swatch(curve.method), curve.method,
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
    const range = verticalRange(curves);
    const options = chartOptions(table, axis, range, (name) => style.getPropertyValue(name).trim());
    const datasets = curves.flatMap((curve) => datasetsOf(curve, range));
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

/** Offers the axes that the metric has curves over. */
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
