// The image comparison: the choice of images, their conversion to colors, and the values under the
// pointer.

const kRadiance = "";  // the choice of "Show" without an error map
const kMapDecades = 4;  // initial range below the 99.5 % quantile
const kMapQuantile = 0.995;

const comparison = {
  scene: null,  // scene of the data
  loaded: { left: null, right: null },  // {label, radiance, map} of each side
  ranges: new Map(),  // [low, high] as exponents, by scene and metric
  point: null,  // point of the stage whose pixel is read
  view: null,
  turn: 0,  // counts choices, so that images unpacked late do not replace those of a later choice
};

const mapMetric = () => find("shown").value;
const mapOf = (image, metric) => image.error_maps.find((map) => map.metric === metric);

/** Returns the exponents that the positive values of maps span: {least, most, usual}. */
function exponentsOf(maps) {
  const counts = new Map();
  for (const map of maps) {
    for (const half of map.halfs) {
      const value = halfValues[half] * map.scale;
      if (value > 0 && value < Infinity) counts.set(value, (counts.get(value) ?? 0) + 1);
    }
  }
  const values = [...counts.keys()].sort((a, b) => a - b);
  if (values.length === 0) return { least: -kMapDecades, most: 0, usual: 0 };
  let left = kMapQuantile * [...counts.values()].reduce((a, b) => a + b);
  const usual = values.find((value) => (left -= counts.get(value)) <= 0) ?? values.at(-1);
  return { least: Math.log10(values[0]), most: Math.log10(values.at(-1)), usual: Math.log10(usual) };
}

/** Returns the range for the scene and metric: as it was last set, or determined from all maps. */
async function prepareRange() {
  const metric = mapMetric();
  const key = JSON.stringify([comparison.scene.name, metric]);
  if (!comparison.ranges.has(key)) {
    const maps = comparison.scene.images.map((image) => mapOf(image, metric)).filter(Boolean);
    const { least, most, usual } = exponentsOf(await Promise.all(maps.map((map) => loadImage(map.image))));
    const high = Math.ceil(usual * 4) / 4;
    const range = { low: high - kMapDecades, high };
    Object.assign(range, { min: Math.floor(Math.min(least, range.low)), max: Math.ceil(Math.max(most, high)) });
    comparison.ranges.set(key, range);
  }
  return comparison.ranges.get(key);
}

function showRange(range) {
  for (const end of ["low", "high"]) {
    const slider = find(`map-${end}`);
    Object.assign(slider, { min: range.min, max: range.max });
    slider.value = range[end];
    find(`map-${end}-value`).textContent = formatNumber(10 ** range[end], 3);
  }
  find("map-bar").replaceChildren(colorBar(10 ** range.low, 10 ** range.high));
}

/** Moves one end of the range. The ends stay a tenth of a decade apart, and the moved one has priority. */
async function moveRange(moved) {
  const range = await prepareRange();
  range[moved] = Number(find(`map-${moved}`).value);
  if (range.high - range.low < 0.1) {
    if (moved === "low") range.high = range.low + 0.1;
    else range.low = range.high - 0.1;
  }
  paint();
}

/** Unpacks the images of one side: the radiance, and the map if one is chosen and exists. */
async function loadSide(side) {
  const image = comparison.scene.images[find(`${side}-image`).value];
  const map = mapOf(image, mapMetric());
  return {
    label: image.label,
    radiance: await loadImage(image.image),
    map: map ? await loadImage(map.image) : null,
  };
}

/** Shows the chosen images as soon as they are unpacked. */
async function update() {
  const turn = ++comparison.turn;
  try {
    const [left, right] = await Promise.all([loadSide("left"), loadSide("right")]);
    if (mapMetric() !== kRadiance) await prepareRange();
    if (turn !== comparison.turn) return;
    comparison.loaded = { left, right };
    await paint();
  } catch (error) {
    find("scene-note").textContent = `The images cannot be unpacked by this browser: ${error.message}`;
    throw error;
  }
}

async function paint() {
  const metric = mapMetric();
  const exposure = Number(find("exposure").value);
  find("exposure-value").textContent = `${exposure < 0 ? kMinus : "+"}${Math.abs(exposure)} EV`;
  const tones = toneTable(exposure);
  const range = metric === kRadiance ? null : await prepareRange();
  if (range) showRange(range);
  find("map-controls").hidden = !range;
  // The reference has no map, so it shows its radiance beside maps.
  find("radiance-controls").hidden = range !== null && ["left", "right"].every((side) => comparison.loaded[side].map);
  const sides = ["left", "right"].map((side) => {
    const { label, radiance, map } = comparison.loaded[side];
    const asMap = range && map;
    find(`${side}-label`).textContent = asMap ? `${label} · ${metric}` : label;
    return toCanvas(asMap ? mapPixels(map, 10 ** range.low, 10 ** range.high) : radiancePixels(radiance, tones));
  });
  comparison.view.show(...sides);
}

/** Fills the table of the pixel under the pointer. */
function showPixel() {
  const { view, point, loaded } = comparison;
  find("zoom-label").textContent = `${formatNumber(view.zoom, 2)}×`;
  const metric = mapMetric();
  find("pixel-map").textContent = metric;
  const { width, height } = view.size;
  const at = point && view.imagePoint(point.x, point.y);
  const inside = at && at.x >= 0 && at.y >= 0 && at.x < width && at.y < height;
  const [x, y] = inside ? [Math.floor(at.x), Math.floor(at.y)] : [0, 0];
  find("pixel-place").textContent = inside ? `Pixel ${x}, ${y}` : "Pixel";
  find("pixel").replaceChildren(...["left", "right"].map((side) => {
    const { label, radiance, map } = loaded[side];
    const index = y * width + x;
    const values = [0, 1, 2].map((c) => halfValues[radiance.halfs[c * width * height + index]]);
    values.push(map ? halfValues[map.halfs[index]] * map.scale : null);
    const texts = values.map((value) => (value === null || !inside ? "" : formatNumber(value)));
    return make("tr", {}, make("th", { scope: "row" }, label), ...texts.map((text) => make("td", {}, text)));
  }));
}

function chooseScene(index) {
  comparison.scene = report.scenes[index];
  const { images, note } = comparison.scene;
  find("scene-note").textContent = note;
  const before = ["left", "right"].map((side) => find(`${side}-image`).selectedOptions[0]?.text);
  const choices = images.map((image, i) => [String(i), image.label]);
  ["left", "right"].forEach((side, i) => {
    const select = find(`${side}-image`);
    fillSelect(select, choices);
    const same = images.findIndex((image) => image.label === before[i]);
    select.value = String(same >= 0 ? same : Math.min(i, images.length - 1));
  });
  const metrics = [...new Set(images.flatMap((image) => image.error_maps.map((map) => map.metric)))];
  const shown = mapMetric();
  fillSelect(find("shown"), [[kRadiance, "radiance"], ...metrics.map((metric) => [metric, `error: ${metric}`])]);
  if (metrics.includes(shown)) find("shown").value = shown;
  return update();
}

function startComparison() {
  const scenes = report.scenes.map((scene, i) => [String(i), scene.name])
    .filter(([i]) => report.scenes[i].images.length > 0);
  if (scenes.length === 0) return false;
  const onPoint = (point) => ((comparison.point = point), showPixel());
  comparison.view = new ImageView(find("stage"), find("comparison"), find("split"), showPixel);
  const pick = (side, index) => {
    if (index >= comparison.scene.images.length) return;
    find(`${side}-image`).value = String(index);
    update();
  };
  const exchange = () => {
    const [left, right] = ["left-image", "right-image"].map(find);
    [left.value, right.value] = [right.value, left.value];
    update();
  };
  fillSelect(find("scene"), scenes);
  find("scene").addEventListener("change", () => chooseScene(Number(find("scene").value)));
  for (const id of ["left-image", "right-image", "shown"]) find(id).addEventListener("change", update);
  // The rest needs images.
  chooseScene(Number(scenes[0][0])).then(() => {
    takePointers(comparison.view, onPoint);
    takeKeys(comparison.view, { pick, exchange, onPoint });
    find("exposure").addEventListener("input", paint);
    find("exposure-reset").addEventListener("click", () => ((find("exposure").value = 0), paint()));
    for (const end of ["low", "high"]) find(`map-${end}`).addEventListener("input", () => moveRange(end));
  });
  return true;
}
