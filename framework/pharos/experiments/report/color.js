// Conversion of halfs to the bytes of a canvas, by tables of all 65536 halfs. Changing the exposure
// costs one table and one look-up per value.

const kNoNumber = [255, 0, 255];
const isNoNumber = (half) => (half & 0x7fff) > 0x7c00;

/** Returns the sRGB byte (IEC 61966-2-1) of each half times 2^exposure, clipped. */
function toneTable(exposure) {
  const scale = 2 ** exposure;
  return Uint8Array.from(halfValues, (value) => {
    const linear = Math.min(1, Math.max(0, value * scale));
    const encoded = linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055;
    return Math.round(255 * encoded);
  });
}

function radiancePixels(image, table) {
  const pixels = new ImageData(image.width, image.height);
  const count = image.width * image.height;
  const { halfs } = image;
  for (let i = 0, out = 0; i < count; ++i, out += 4) {
    const r = halfs[i], g = halfs[i + count], b = halfs[i + 2 * count];
    const broken = isNoNumber(r) || isNoNumber(g) || isNoNumber(b);
    pixels.data[out] = broken ? kNoNumber[0] : table[r];
    pixels.data[out + 1] = broken ? kNoNumber[1] : table[g];
    pixels.data[out + 2] = broken ? kNoNumber[2] : table[b];
    pixels.data[out + 3] = 255;
  }
  return pixels;
}

// Ten samples of "viridis" (van der Walt and Smith, 2015; dedicated to the public domain). The map
// is perceptually uniform, also without colors and for color-blind people.
const kFalseColors = ["440154", "482878", "3e4989", "31688e", "26828e", "1f9e89", "35b779", "6ece58",
  "b5de2b", "fde725"].map((hex) => [0, 2, 4].map((at) => parseInt(hex.slice(at, at + 2), 16)));

/** Returns the color at `t` in [0,1]. Values outside of the range have the color of the nearest end. */
function falseColor(t) {
  if (Number.isNaN(t)) return kNoNumber;
  const place = Math.min(1, Math.max(0, t)) * (kFalseColors.length - 1);
  const index = Math.min(kFalseColors.length - 2, Math.floor(place));
  return kFalseColors[index].map((from, channel) =>
    Math.round(from + (place - index) * (kFalseColors[index + 1][channel] - from)));
}

/**
 * Returns the position of `value` between `low` and `high` on a logarithmic scale. Zero and
 * negative values are at 0.
 */
function logPlace(value, low, high) {
  if (Number.isNaN(value)) return NaN;
  return value <= 0 ? 0 : Math.log(value / low) / Math.log(high / low);
}

function mapPixels(map, low, high) {
  const table = new Uint32Array(65536);  // whole pixels, in the machine's byte order
  const bytes = new Uint8Array(table.buffer);
  halfValues.forEach((value, half) =>
    bytes.set([...falseColor(logPlace(value * map.scale, low, high)), 255], 4 * half));
  const pixels = new ImageData(map.width, map.height);
  const out = new Uint32Array(pixels.data.buffer);
  for (let i = 0; i < map.halfs.length; ++i) out[i] = table[map.halfs[i]];
  return pixels;
}

/** Returns a canvas of the pixels' own size. */
function toCanvas(pixels) {
  const canvas = make("canvas", { width: pixels.width, height: pixels.height });
  canvas.getContext("2d").putImageData(pixels, 0, 0);
  return canvas;
}

/** Returns a bar of the false colors with numbers below, for values from `low` to `high`. */
function colorBar(low, high) {
  const canvas = make("canvas", { width: 256, height: 1 });
  const pixels = new ImageData(256, 1);
  for (let i = 0; i < 256; ++i) pixels.data.set([...falseColor(i / 255), 255], 4 * i);
  canvas.getContext("2d").putImageData(pixels, 0, 0);
  const ticks = make("div", { className: "ticks" });
  const tick = (place, text) => {
    const label = make("span", {}, text);
    label.style.left = `${100 * place}%`;
    ticks.append(label);
  };
  tick(0, formatNumber(low, 2));
  tick(1, formatNumber(high, 2));
  const decades = Math.log10(high / low);
  const step = Math.max(1, Math.ceil(decades / 4));
  for (let e = Math.ceil(Math.log10(low)); e <= Math.log10(high); e += step) {
    const place = logPlace(10 ** e, low, high);
    if (place > 0.16 && place < 0.84) tick(place, commonExponent(10 ** e) === 0 ? formatNumber(10 ** e, 1) : powerOfTen(e));
  }
  return make("div", { className: "color-bar" }, canvas, ticks);
}
