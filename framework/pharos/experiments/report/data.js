// What the page shows, as write_report() left it in <script> elements that are no scripts.

const report = JSON.parse(document.getElementById("report-data").textContent);

/** A number of the data: null is NaN; infinities come as text. */
const toNumber = (value) => (value === null ? NaN : Number(value));

/** {low, high} of an interval of the data, or null. */
const toInterval = (value) =>
  value === null ? null : { low: toNumber(value[0]), high: toNumber(value[1]) };

const find = (id) => document.getElementById(id);

/** A new element with properties, then children: elements or texts, which stay texts. */
function make(name, properties = {}, ...children) {
  const element = Object.assign(document.createElement(name), properties);
  element.append(...children);
  return element;
}

/** Fills a <select> with [value, text] pairs. */
function fillSelect(select, choices) {
  select.replaceChildren(...choices.map(([value, text]) => make("option", { value }, text)));
}

/** The value of each of the 65536 halfs (IEEE 754 binary16). */
const halfValues = Float32Array.from({ length: 65536 }, (_, bits) => {
  const sign = bits & 0x8000 ? -1 : 1;
  const exponent = (bits >> 10) & 31;
  const mantissa = bits & 1023;
  if (exponent === 31) return mantissa ? NaN : sign * Infinity;
  return sign * (exponent ? (mantissa + 1024) * 2 ** (exponent - 25) : mantissa * 2 ** -24);
});

/** Unpacks what PackedImage describes: {width, height, channels, scale, halfs}, planes of halfs. */
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

/** The image of that number, unpacked once. */
function loadImage(index) {
  if (!unpacked.has(index)) unpacked.set(index, unpackImage(index));
  return unpacked.get(index);
}
