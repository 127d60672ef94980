// Formatting of numbers, and the looks of methods.

const kMinus = "\u2212";
const kSuperscripts = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };

const powerOfTen = (exponent) =>
  "10" + [...String(exponent)].map((digit) => kSuperscripts[digit]).join("");

/** Returns the power of ten that is factored out of numbers about as large as `value`. */
function commonExponent(value) {
  if (!Number.isFinite(value) || value === 0) return 0;
  const exponent = Math.floor(Math.log10(Math.abs(value)));
  return exponent < -3 || exponent > 4 ? exponent : 0;
}

/**
 * Returns the number of decimals that `value` needs for this number of digits. Digits before the
 * decimal point are never dropped.
 */
function decimalsFor(value, digits) {
  if (!Number.isFinite(value) || value === 0) return digits - 1;
  return Math.min(20, Math.max(0, digits - 1 - Math.floor(Math.log10(Math.abs(value)))));
}

function fixed(value, decimals) {
  if (Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return (value < 0 ? kMinus : "") + "∞";
  return value === 0 ? "0" : value.toFixed(decimals).replace("-", kMinus);
}

const times = (exponent) => (exponent === 0 ? "" : `×${powerOfTen(exponent)}`);

/** Formats a number, such as 12.34, 0.001235 or 1.234×10⁻⁷; NaN is a dash. */
function formatNumber(value, digits = 4) {
  const exponent = commonExponent(value);
  const scaled = value / 10 ** exponent;
  return fixed(scaled, decimalsFor(scaled, digits)) + times(exponent);
}

/** Formats an interval, such as [1.10, 1.35]×10⁻⁷, with the decimals and the power of ten of `value`. */
function formatInterval(interval, value, digits = 4) {
  const exponent = commonExponent(value);
  const decimals = decimalsFor(value / 10 ** exponent, digits);
  const ends = [interval.low, interval.high];
  const [low, high] = ends.map((end) => fixed(end / 10 ** exponent, decimals));
  const scales = ends.some((end) => Number.isFinite(end) && end !== 0);
  return `[${low}, ${high}]${scales ? times(exponent) : ""}`;
}

// The colors of Okabe and Ito (Color Universal Design, 2008), which people with any kind of color
// blindness can tell apart. The yellow, which is pale on paper, and black are replaced by grays.
// Shapes distinguish methods without any color.
const kPalette = {
  light: ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#5d6670", "#1d2126"],
  dark: ["#4aa8e0", "#f0803c", "#2fc79b", "#e39ac3", "#f0b840", "#9ad4f5", "#9aa3ad", "#e4e6e8"],
};
/** The shapes of points, for Chart.js and as characters. */
const kPoints = [["circle", "●"], ["triangle", "▲"], ["rect", "■"], ["rectRot", "◆"], ["star", "✳"],
  ["crossRot", "✕"], ["cross", "✚"], ["dash", "▬"]];

const theme = () => document.documentElement.dataset.theme;

function methodLook(method) {
  const index = report.methods.indexOf(method);
  const slot = index % kPalette.light.length;
  // If colors repeat, the shapes differ.
  const [point, letter] = kPoints[(index + Math.floor(index / kPalette.light.length)) % kPoints.length];
  return { color: kPalette[theme()][slot], slot, point, letter };
}

/** Returns the method's mark. Its color follows the theme by the variables of paintMethods(). */
function mark(method) {
  const { slot, letter } = methodLook(method);
  const element = make("span", { className: "mark" }, letter);
  element.style.color = `var(--method-${slot})`;
  element.setAttribute("aria-hidden", "true");
  return element;
}

function paintMethods() {
  kPalette[theme()].forEach((color, i) =>
    document.documentElement.style.setProperty(`--method-${i}`, color));
}
