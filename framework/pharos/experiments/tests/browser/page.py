"""The report page in words: what people do on it, and what it has to show for sample_report.h."""

import re
import time

FAILURES = []
SCENE_WIDTH, SCENE_HEIGHT = 64, 32  # of "ramp"
MAGENTA = [255, 0, 255]
VIRIDIS = ["440154", "482878", "3e4989", "31688e", "26828e", "1f9e89", "35b779", "6ece58", "b5de2b",
           "fde725"]


def check(holds, what):
    if not holds:
        FAILURES.append(what)
        print(f"FAILED: {what}")


def check_equal(found, expected, what):
    check(found == expected, f"{what}: {found!r}, expected {expected!r}")


def tone(value, exposure=0):
    """The byte of sRGB that a linear value is shown as."""
    linear = min(1, max(0, value * 2 ** exposure))
    encoded = 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055
    return int(255 * encoded + 0.5)


def ramp(image, x, y, exposure=0):
    """The color of a pixel of "ramp": the three methods are images 0 to 2, the reference 3."""
    factor = [1.25, 1.5, 1.75, 1][image]
    values = [factor * (x + 1) / 64, factor * (y + 1) / 32, factor / 4]
    if (x, y) == (0, 0):
        values[2] = 65504
    if (image, x, y) == (2, 5, 5):
        return MAGENTA
    return [tone(value, exposure) for value in values]


def false_color(place):
    place = min(1, max(0, place)) * (len(VIRIDIS) - 1)
    index = min(len(VIRIDIS) - 2, int(place))
    ends = [[int(VIRIDIS[index + k][c:c + 2], 16) for c in (0, 2, 4)] for k in (0, 1)]
    return [int(a + (place - index) * (b - a) + 0.5) for a, b in zip(*ends)]


class Page:
    """The page with words for what people do on it."""

    def __init__(self, browser):
        self.browser = browser
        self.run = browser.run

    def text(self, selector):
        return self.run(f"document.querySelector({selector!r}).textContent")

    def texts(self, selector):
        return self.run(f"[...document.querySelectorAll({selector!r})].map(e => e.textContent)")

    def choose(self, control, text):
        """Picks a choice of a <select> by its text, as a person would."""
        self.run(f"""(() => {{
            const select = document.getElementById({control!r});
            select.value = [...select.options].find(o => o.text === {text!r}).value;
            select.dispatchEvent(new Event("input")); select.dispatchEvent(new Event("change"));
        }})()""")

    def slide(self, control, value):
        self.run(f"""(() => {{
            const slider = document.getElementById({control!r});
            slider.value = {value}; slider.dispatchEvent(new Event("input"));
        }})()""")

    def stage(self):
        return self.run("""(() => { const s = document.getElementById("stage");
            s.scrollIntoView({block: "center"}); const b = s.getBoundingClientRect();
            return [b.left, b.top, b.width, b.height]; })()""")

    def point(self, u, v):
        """The point of the window at fractions of the stage."""
        left, top, width, height = self.stage()
        return left + u * width, top + v * height

    def color(self, u, v):
        """What the canvas shows at fractions of the stage."""
        return self.run(f"""(() => {{ const c = document.getElementById("comparison");
            return [...c.getContext("2d").getImageData(
                Math.floor({u} * c.width), Math.floor({v} * c.height), 1, 1).data].slice(0, 3); }})()""")

    def shows(self, color, u, v, what):
        """Waits for a color, since images are unpacked on the side."""
        end = time.monotonic() + 5
        while self.color(u, v) != color and time.monotonic() < end:
            time.sleep(0.02)
        check_equal(self.color(u, v), color, what)

    def shows_ramp(self, image, x, y, what, exposure=0):
        """At the fitted zoom."""
        self.shows(ramp(image, x, y, exposure), (x + 0.5) / SCENE_WIDTH, (y + 0.5) / SCENE_HEIGHT, what)

    def focus(self, control):
        self.run(f"document.getElementById({control!r}).focus()")

    def pixel(self):
        """The (x, y) whose values are shown."""
        found = re.findall(r"\d+", self.text("#pixel-place"))
        return tuple(int(part) for part in found)


def colored(page, chart, color, alpha=255):
    """How many pixels of a chart have about that color and opacity."""
    return page.run(f"""(() => {{ const c = document.querySelectorAll("#charts canvas")[{chart}];
        const d = c.getContext("2d").getImageData(0, 0, c.width, c.height).data; let n = 0;
        for (let i = 0; i < d.length; i += 4) n += Math.abs(d[i + 3] - {alpha}) < 6 &&
            {color}.every((v, k) => Math.abs(d[i + k] - v) < 8);
        return n; }})()""")
