// Numbers as texts, and how methods look.

const kMinus = "\u2212";
const kSuperscripts = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };

const powerOfTen = (exponent) =>
  "10" + [...String(exponent)].map((digit) => kSuperscripts[digit]).join("");

/** The power of ten that is taken out of numbers about as large as `value`. */
function commonExponent(value) {
  if (!Number.isFinite(value) || value === 0) return 0;
  const exponent = Math.floor(Math.log10(Math.abs(value)));
  return exponent < -3 || exponent > 4 ? exponent : 0;
}

/** `value` / 10^`exponent` with `digits` digits. */
function mantissa(value, exponent, digits) {
  if (Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return (value < 0 ? kMinus : "") + "∞";
  const scaled = value / 10 ** exponent;
  // Whole digits are never left out.
  const whole = Math.abs(scaled) < 1 ? 0 : Math.floor(Math.log10(Math.abs(scaled))) + 1;
  const text =
    scaled === 0 ? "0"
    : whole > 0 ? scaled.toFixed(Math.max(0, digits - whole))
    : Number(scaled.toPrecision(digits)).toFixed(
        Math.min(20, digits - 1 - Math.floor(Math.log10(Math.abs(scaled)))));
  return text.replace("-", kMinus);
}

const times = (exponent) => (exponent === 0 ? "" : `×${powerOfTen(exponent)}`);

/** Such as 12.34, 0.001235 or 1.234×10⁻⁷; NaN is a dash. */
function formatNumber(value, digits = 4) {
  const exponent = commonExponent(value);
  return mantissa(value, exponent, digits) + times(exponent);
}

/** Such as [1.1, 1.3]×10⁻⁷, with the power of ten of `value`. */
function formatInterval(interval, value, digits = 3) {
  const exponent = commonExponent(value);
  const [low, high] = [interval.low, interval.high].map((end) => mantissa(end, exponent, digits));
  return `[${low}, ${high}]${times(exponent)}`;
}

// The colours of Okabe and Ito (Color Universal Design, 2008), which people with any kind of colour
// blindness tell apart; the yellow, pale on paper, and black give way to greys. Charts tell methods
// apart by the shapes of their points too.
const kPalette = {
  light: ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#5d6670", "#1d2126"],
  dark: ["#4aa8e0", "#f0803c", "#2fc79b", "#e39ac3", "#f0b840", "#9ad4f5", "#9aa3ad", "#e4e6e8"],
};
const kPointStyles = ["circle", "triangle", "rect", "rectRot", "star", "crossRot", "cross", "dash"];

const theme = () => document.documentElement.dataset.theme;

function methodLook(method) {
  const index = report.methods.indexOf(method);
  const colors = kPalette[theme()];
  return {
    color: colors[index % colors.length],
    point: kPointStyles[(index + Math.floor(index / colors.length)) % kPointStyles.length],
  };
}

/** A dot in the method's colour, which follows the theme by the variables that paintMethods() sets. */
function swatch(method) {
  const dot = make("span", { className: "swatch" });
  dot.style.background = `var(--method-${report.methods.indexOf(method) % kPalette.light.length})`;
  return dot;
}

function paintMethods() {
  kPalette[theme()].forEach((color, i) =>
    document.documentElement.style.setProperty(`--method-${i}`, color));
}
