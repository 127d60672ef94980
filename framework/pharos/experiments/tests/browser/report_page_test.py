"""report_page_test.py BROWSER WRITE_SAMPLE_REPORT: the report page as people use it.

Drives the page of sample_report.h, which states the values that are expected here.
"""

import os
import subprocess
import sys
import tempfile
import time

from devtools import Browser
from page import (FAILURES, MAGENTA, SCENE_HEIGHT, SCENE_WIDTH, Page, check, check_equal, colored,
                  false_color, ramp)

CONTROLS = ["theme", "measure", "scene", "left-image", "right-image", "shown", "stage", "split",
            "exposure", "exposure-reset", "curve-metric", "curve-axis"]


def test_texts(page):
    title = "Guided & unguided: </script><script>alert(1)</script> \"été\" 測試"
    check_equal(page.text("h1"), title + "\x01", "heading")
    check(page.text("#description").endswith("<img src=x onerror=alert(2)>"), "description is text")
    check_equal(page.run("document.images.length"), 0, "images made of text")
    check("</script> & <b>" in page.text("#text-list pre"), "config is text")


def test_table(page):
    cell = "#tables .measure-block:not([hidden]) tbody tr:nth-child({}) td:nth-of-type({})"
    best = "[...document.querySelectorAll('#tables .measure-block:not([hidden]) tbody tr')]" \
           ".map(row => [...row.querySelectorAll('td')].map(cell => cell.matches('.best')))"
    check_equal(page.run(best), [[False, True, False], [False, False, False]],
                "best errors, one that intervals do not separate")
    text = page.text(cell.format(1, 2))
    for part in ("★ 0.004310", "[0.004138, 0.004482]", "× 0.345 [0.326, 0.364]"):
        check(part in text, f"'{part}' in the cell '{text}'")
    check_equal(page.text(cell.format(2, 2)), "–", "missing value")
    check("[0, ∞]" in page.text(cell.format(2, 1)), "unknown interval")
    check("×" not in page.text(cell.format(1, 1)), "the baseline has no ratio")
    page.choose("measure", "Samples a second")
    check_equal(page.run(best), [[True, False, False], [True, True, False]], "best rates, one a tie")


def test_images(page):
    page.choose("scene", "ramp")
    page.shows_ramp(0, 10, 20, "left image")
    page.shows_ramp(1, 50, 3, "right image")
    page.choose("right-image", "reference")
    page.shows_ramp(3, 50, 3, "reference on the right")
    check_equal(page.text("#right-label"), "reference", "label of the right image")
    page.browser.mouse("mouseMoved", *page.point(0.2 / SCENE_WIDTH, 0.2 / SCENE_HEIGHT))
    check_equal(page.texts("#pixel td")[:3], ["0.01953", "0.03906", "65504"], "values of (0, 0)")
    page.browser.mouse("mouseMoved", *page.point(1.2 / SCENE_WIDTH, 0.2 / SCENE_HEIGHT))
    check_equal(page.texts("#pixel td")[2], "9.537×10⁻⁷", "a denormal half")


def test_exposure(page):
    for exposure in (1.5, -3, 0):
        page.slide("exposure", exposure)
        page.shows_ramp(0, 10, 20, f"left at exposure {exposure}", exposure)
        page.shows_ramp(3, 50, 3, f"right at exposure {exposure}", exposure)
    page.slide("exposure", 2)
    page.run("document.getElementById('exposure-reset').click()")
    page.shows_ramp(0, 10, 20, "exposure reset")


def test_split(page):
    page.shows_ramp(0, 20, 7, "left of the line")
    page.browser.drag(page.point(0.5, 0.3), page.point(0.25, 0.3))
    check_equal(page.run("document.getElementById('split').getAttribute('aria-valuenow')"), "25",
                "dragged line")
    page.shows_ramp(3, 20, 7, "right of the dragged line")
    page.shows_ramp(0, 10, 7, "left of the dragged line")


def test_zoom(page):
    """The pixel under the pointer stays while zooming; dragging moves both sides alike."""
    spot = page.point(38.5 / SCENE_WIDTH, 16.5 / SCENE_HEIGHT)
    page.browser.mouse("mouseMoved", *spot)
    before, label = page.pixel(), page.text("#zoom-label")
    check_equal(before, (38, 16), "pixel under the pointer")
    page.browser.mouse("mouseWheel", *spot, deltaY=-900)
    check(page.browser.wait(f"document.getElementById('zoom-label').textContent !== '{label}'"),
          "the wheel zooms")
    check_equal(page.pixel(), before, "pixel under the pointer after zooming")
    page.shows(ramp(3, *before), 38.5 / SCENE_WIDTH, 16.5 / SCENE_HEIGHT, "zoomed pixel")
    end = page.point(0.45, 0.7)
    page.browser.drag(spot, end)
    check_equal(page.pixel(), before, "pixel under the pointer after dragging")
    page.shows(ramp(3, *before), 0.45, 0.7, "moved pixel, right side")
    page.browser.mouse("mouseMoved", *page.point(0.2, 0.7))
    page.shows(ramp(0, *page.pixel()), 0.2, 0.7, "moved pixel, left side")
    blocks = page.run("""(() => { const c = document.getElementById("comparison");
        const row = c.getContext("2d").getImageData(0, c.height >> 1, c.width, 1).data;
        const starts = []; for (let x = Math.ceil(c.width * 0.3); x < c.width; ++x)
            if (row[4 * x] !== row[4 * x - 4]) starts.push(x);
        return starts.slice(1).map((x, i) => x - starts[i]); })()""")
    check(len(blocks) > 5 and max(blocks) - min(blocks) <= 1 and min(blocks) > 20,
          f"pixels are equal squares: {blocks}")
    page.focus("stage")
    page.browser.key("0", "Digit0", "0")
    page.shows_ramp(0, 10, 20, "fitted again")


def test_pinch(page):
    """Two fingers that part double the zoom about their middle."""
    def touch(kind, *points):
        page.browser.send("Input.dispatchTouchEvent", type=kind,
                          touchPoints=[{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(points)])
    fitted = page.run("parseFloat(document.getElementById('zoom-label').textContent)")
    (left, y), (right, _) = page.point(0.4, 0.5), page.point(0.6, 0.5)
    spread = (right - left) / 2
    touch("touchStart", (left, y), (right, y))
    for part in (0.5, 1):
        touch("touchMove", (left - part * spread, y), (right + part * spread, y))
    touch("touchEnd")
    zoomed = page.run("parseFloat(document.getElementById('zoom-label').textContent)")
    check(abs(zoomed / fitted - 2) < 0.1, f"pinching doubles the zoom: from {fitted} to {zoomed}")
    page.focus("stage")
    page.browser.key("0", "Digit0", "0")


def test_keys(page):
    page.focus("stage")
    page.browser.key("End")
    page.shows_ramp(0, 60, 7, "line at the right end")
    page.browser.key("ArrowLeft")
    check_equal(page.run("document.getElementById('split').getAttribute('aria-valuenow')"), "98",
                "line moved by a key")
    page.focus("split")
    page.browser.key("Home")
    page.shows_ramp(3, 2, 7, "line at the left end")
    page.browser.key("3", "Digit3", "3")
    page.shows_ramp(2, 30, 7, "third image on the right")
    page.shows(MAGENTA, 5.5 / SCENE_WIDTH, 5.5 / SCENE_HEIGHT, "NaN is magenta")
    page.browser.key("@", "Digit2", "@", shift=True)
    check_equal(page.run("document.getElementById('left-image').value"), "1", "left image by a key")
    page.browser.key("x", "KeyX", "x")
    page.shows_ramp(1, 30, 7, "images exchanged")
    fitted = page.text("#zoom-label")
    page.focus("stage")
    for _ in range(4):
        page.browser.key("+", "Equal", "+", shift=True)
    check(page.text("#zoom-label") != fitted, "zoom by a key")
    before = page.pixel()
    for _ in range(2):
        page.browser.key("ArrowRight", shift=True)
    check(page.pixel()[0] > before[0] and page.pixel()[1] == before[1], "moved by a key")
    for _ in range(4):
        page.browser.key("-", "Minus", "-")
    check_equal(page.text("#zoom-label"), fitted, "zoomed back by a key")


def test_error_map(page):
    page.choose("left-image", "path")
    page.choose("right-image", "reference")
    page.focus("stage")
    page.browser.key("End")
    page.choose("shown", "error: relMSE")
    check(page.browser.wait("!document.getElementById('map-controls').hidden"), "range is offered")
    check(page.browser.wait("document.getElementById('left-label').textContent === 'path · relMSE'"),
          "label of the map")
    check_equal(page.text("#right-label"), "reference", "the reference has no map")
    for low, high in ((-3, -1), (-2.5, -1.5)):
        page.slide("map-low", low)
        page.slide("map-high", high)
        for x in (0, 13, 60):
            place = page.run(f"(Math.log10({(x + 1) / 1024}) - ({low})) / ({high} - ({low}))")
            page.shows(false_color(place), (x + 0.5) / SCENE_WIDTH, 0.5,
                       f"error of pixel {x} from 10^{low} to 10^{high}")
    check_equal(len(page.texts("#map-bar .ticks span")), 3, "numbers at the color bar")
    page.slide("map-high", -2.9)
    check(page.run("Number(document.getElementById('map-low').value) <= -2.95"), "range stays a range")
    page.browser.mouse("mouseMoved", *page.point(13.5 / SCENE_WIDTH, 0.5))
    check_equal(page.texts("#pixel td")[3], "0.01367", "value of the error")
    page.choose("shown", "radiance")
    page.shows_ramp(0, 13, 16, "radiance again")


def test_charts(page):
    blue, orange = [0, 114, 178], [213, 94, 0]
    check_equal(page.texts(".chart-title"), ["still life", "ramp"], "a chart for each scene")
    for chart in (0, 1):
        check(colored(page, chart, blue) > 300, f"blue curve of chart {chart}")
        check(colored(page, chart, orange) > 300, f"orange curve of chart {chart}")
        drawn = page.run(f"""(() => {{
            const {{ scales, data }} = Chart.getChart(document.querySelectorAll("#charts canvas")[{chart}]);
            return [scales.x.type, scales.y.type, data.datasets.map(d => d.data.length)]; }})()""")
        # The second curve of the first chart has a point without value.
        expected = [9, 9, 9, 8, 8, 8, 9, 9, 9] if chart == 0 else [9] * 9
        check_equal(drawn, ["logarithmic", "logarithmic", expected], f"curves and bands of chart {chart}")
    check(colored(page, 0, blue, alpha=51) > 1000, "the band of an unknown interval")
    check("slope −0.98 [−1.01, −0.94]" in page.text("#charts .legend"), "slope with its interval")
    page.run("document.querySelector('#charts .legend button').click()")
    check(colored(page, 0, blue) == 0, "a curve is hidden by the legend")
    check(colored(page, 0, orange) > 300, "others are not hidden")
    page.choose("curve-axis", "seconds")
    check(colored(page, 0, blue) > 300, "curves over seconds")
    page.choose("curve-metric", "MSE")
    check_equal(page.run("document.getElementById('curve-axis').value"), "seconds", "the axis stays")
    check_equal(len(page.texts("#charts figure")), 2, "charts are replaced")


def test_pictures(page):
    check(page.browser.wait("document.querySelectorAll('#gallery figure').length === 2"), "two pictures")
    check(page.text("#gallery figcaption").endswith("4 iterations <i>"), "caption")
    middle = page.run("[...document.querySelector('#gallery canvas').getContext('2d')"
                      ".getImageData(60, 30, 1, 1).data].slice(0, 3)")
    check_equal(middle, false_color(1), "the largest value is brightest")
    check("3.0×10⁵" in page.texts("#gallery .ticks span"), "the largest value is told")


def test_saving(page, folder):
    page.browser.send("Browser.setDownloadBehavior", behavior="allow", downloadPath=folder,
                      eventsEnabled=True)
    page.browser.send("Browser.grantPermissions",
                      permissions=["clipboardReadWrite", "clipboardSanitizedWrite"])
    page.run("document.querySelectorAll('#text-list details')[1].open = true")
    page.run("document.querySelectorAll('#text-list details')[1].querySelectorAll('button')[1].click()")
    path = os.path.join(folder, "results.csv")
    end = time.monotonic() + 10
    while not (os.path.exists(path) and os.path.getsize(path)) and time.monotonic() < end:
        page.run("0")
        time.sleep(0.05)
    check(os.path.exists(path), "a text is saved by its name")
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            check(file.read().startswith("scene,method,relative_mse\n"), "saved text")
    page.run("document.querySelectorAll('#text-list details')[1].querySelector('button').click()")
    check(page.browser.wait("document.querySelectorAll('#text-list details')[1]"
                            ".querySelector('button').textContent === 'Copied'"), "a text is copied")


def test_theme(page):
    background = "getComputedStyle(document.body).backgroundColor"
    check_equal(page.run(background), "rgb(253, 253, 251)", "light page")
    page.focus("theme")
    page.browser.key("Enter")
    check_equal(page.run(background), "rgb(21, 24, 28)", "dark page")
    check(colored(page, 0, [74, 168, 224]) > 300, "charts follow the theme")
    page.browser.send("Page.printToPDF", printBackground=True)
    check_equal(page.run(background), "rgb(21, 24, 28)", "dark again after printing")
    page.browser.key("Enter")
    check_equal(page.run(background), "rgb(253, 253, 251)", "light again")


def test_keyboard_only(page):
    """Every control is reached by Tab, has a name, and works by keys alone."""
    page.run("document.activeElement.blur(), scrollTo(0, 0)")
    reached = []
    for _ in range(80):
        page.browser.key("Tab")
        reached.append(page.run("document.activeElement.id || document.activeElement.className || "
                                "document.activeElement.tagName"))
    for control in CONTROLS + ["SUMMARY", "BUTTON", "A", "scroll"]:
        check(control in reached, f"Tab reaches '{control}'")
    nodes = page.browser.send("Accessibility.getFullAXTree")["nodes"]
    roles = ("button", "combobox", "slider", "link", "DisclosureTriangle")
    named = [(n["role"]["value"], n["name"]["value"]) for n in nodes
             if n.get("role", {}).get("value") in roles and "name" in n]
    check(len(named) > 20, f"controls in the accessibility tree: {len(named)}")
    for role, name in named:
        check(name.strip() != "", f"a {role} has a name")
    page.focus("scene")
    page.browser.key("ArrowUp")
    check_equal(page.run("document.getElementById('scene').selectedOptions[0].text"), "still life",
                "a choice by keys")
    check(page.browser.wait("document.getElementById('scene-note').textContent.includes('65,536')"),
          "the scene follows the choice")
    page.focus("exposure")
    page.browser.key("ArrowRight")
    check_equal(page.text("#exposure-value"), "+0.25 EV", "exposure by keys")


def test_sizes(page):
    for width in (360, 400, 768, 1920):
        page.browser.size(width, 900)
        # Charts follow a little later.
        check(page.browser.wait(f"document.documentElement.scrollWidth <= {width}", 3), f"fits {width} pixels")


def test_silence(page, url):
    """Nothing was loaded, nothing went wrong, and the page's policy would stop it anyway."""
    outside = [request for request in page.browser.requests
               if request != url and not request.startswith("blob:")]
    check_equal(outside, [], "requests")
    check_equal(page.browser.problems, [], "errors and warnings")
    check_equal(page.run("fetch('http://127.0.0.1:9/').then(() => 'sent', () => 'stopped')"), "stopped",
                "a request")
    check(any("Content Security Policy" in problem for problem in page.browser.problems),
          "the policy stops requests")


def main(program, writer):
    with tempfile.TemporaryDirectory(prefix="pharos-report-") as folder:
        path = os.path.join(folder, "sample.html")
        subprocess.run([writer, path], check=True)
        browser = Browser(program)
        try:
            page, url = Page(browser), "file://" + path
            browser.size(1280, 1000)
            browser.open(url)
            test_texts(page)
            test_table(page)
            test_images(page)
            test_exposure(page)
            test_split(page)
            test_zoom(page)
            test_pinch(page)
            test_keys(page)
            test_error_map(page)
            test_charts(page)
            test_pictures(page)
            test_saving(page, folder)
            test_theme(page)
            test_keyboard_only(page)
            test_sizes(page)
            test_silence(page, url)
        finally:
            browser.close()
    print(f"{len(FAILURES)} checks failed" if FAILURES else "the report page works")
    return 1 if FAILURES else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
