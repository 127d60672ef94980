// Pictures that are only shown, not compared, in false colors of their logarithm.

const kPictureDecades = 4;

async function picture({ caption, image }) {
  const map = await loadImage(image);
  let [least, most] = [Infinity, 0];
  for (const half of map.halfs) {
    const value = halfValues[half] * map.scale;
    if (!(value > 0 && value < Infinity)) continue;
    least = Math.min(least, value);
    most = Math.max(most, value);
  }
  if (most === 0) most = 1;
  // A constant picture also needs a range.
  const low = Math.min(Math.max(least, most / 10 ** kPictureDecades), most / 2);
  const canvas = toCanvas(mapPixels(map, low, most));
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", caption);
  return make("figure", {}, canvas, colorBar(low, most), make("figcaption", {}, caption));
}

function startPictures() {
  const scenes = report.scenes.filter((scene) => scene.pictures.length > 0);
  for (const scene of scenes) {
    const grid = make("div", { className: "gallery" });
    find("gallery").append(make("h3", {}, scene.name), grid);
    Promise.all(scene.pictures.map(picture)).then((figures) => grid.append(...figures));
  }
  return scenes.length > 0;
}
