// The data of the page, as write_report() wrote it into <script> elements that are not scripts.

const report = JSON.parse(document.getElementById("report-data").textContent);

/** Returns a number of the data: null is NaN, and infinities are strings. */
const toNumber = (value) => (value === null ? NaN : Number(value));

/** Returns {low, high} of an interval of the data, or null. */
const toInterval = (value) =>
  value === null ? null : { low: toNumber(value[0]), high: toNumber(value[1]) };

const find = (id) => document.getElementById(id);

/**
 * Makes an element with properties and children. Children are elements or texts; texts are never
 * parsed as HTML.
 */
function make(name, properties = {}, ...children) {
  const element = Object.assign(document.createElement(name), properties);
  element.append(...children);
  return element;
}

/** Fills a <select> with [value, text] pairs. */
function fillSelect(select, choices) {
  select.replaceChildren(...choices.map(([value, text]) => make("option", { value }, text)));
}

/** The values of all 65536 halfs (IEEE 754 binary16). */
const halfValues = Float32Array.from({ length: 65536 }, (_, bits) => {
  const sign = bits & 0x8000 ? -1 : 1;
  const exponent = (bits >> 10) & 31;
  const mantissa = bits & 1023;
  if (exponent === 31) return mantissa ? NaN : sign * Infinity;
  return sign * (exponent ? (mantissa + 1024) * 2 ** (exponent - 25) : mantissa * 2 ** -24);
});

/** Unpacks a PackedImage to {width, height, channels, scale, halfs} with the halfs in planes. */
async function unpackImage(index) {
  const element = find(`image-${index}`);
  const [width, height, channels, scale] = ["width", "height", "channels", "scale"].map((key) =>
    Number(element.dataset[key]));
  const packed = Uint8Array.from(atob(element.textContent), (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  const halfs = new Uint16Array(width * height * channels);
  for (let i = 0; i < halfs.length; ++i) halfs[i] = (bytes[i] << 8) | bytes[halfs.length + i];
  return { width, height, channels, scale, halfs };
}

const unpacked = new Map();

/** Returns the image with this index, which is unpacked only once. */
function loadImage(index) {
  if (!unpacked.has(index)) unpacked.set(index, unpackImage(index));
  return unpacked.get(index);
}
