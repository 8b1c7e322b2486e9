"""The page of `rtc study` in headless Chromium: pictures, values, plots, sizes and themes, and that
it asks nobody for anything. RTC is the program, PAGES a folder where pictures of the page go, at
three sizes, light and dark."""

import json
import math
import os
import re
import struct
import subprocess
import sys
import tempfile

import chromium

SCENE = """camera { eye 0 1 -5  look_at 0 0.6 0 }
film { width 24  height 16 }
material red { kd 0.8 0.2 0.1 }
material white { kd 0.7 }
plane { point 0 0 0  normal 0 1 0  material white }
sphere { centre 0 1 0  radius 1  material red }
light environment { radiance 0.5 0.7 1 }
"""
LIST = """= Two <b>studies</b>
== one Samples & sampler
A text.
$ a.rts --sweep spp=1,4,16 --sweep sampler=all --repeat 2 --reference auto
== two Modes
$ a.rts --sweep mode=path,normals --spp 4
== three Caustics
$ sun.rts --sweep mode=path,vcm --spp 64 --repeat 4 --reference path --reference-error 0.2
"""
SUN = """include "a.rts"
material glass { kt 1  fresnel dielectric }
sphere { centre 1 0.3 -1  radius 0.3  material glass }
light directional { direction 0.5 -1 0.5  irradiance 3 }
"""
SIZES = {"phone": (390, 844), "laptop": (1280, 800), "wide": (2200, 1200)}
failed = passed = 0


class Page(chromium.Page):
    """A page that has been drawn whenever a call returns, and all that its console says."""

    def __init__(self, *arguments, **options):
        self.said = []
        super().__init__(*arguments, **options)
        self.settle()

    def hear(self, message):
        super().hear(message)
        if message["method"] == "Log.entryAdded":
            text = message["params"]["entry"]["text"]
            if "getImageData" not in text:  # which is what the tests themselves call
                self.said.append(text)
        elif message["method"] in ("Runtime.consoleAPICalled", "Runtime.exceptionThrown"):
            self.said.append(json.dumps(message["params"]))

    def settle(self):
        """Waits until the page has been drawn twice."""
        self.value("new Promise(done => requestAnimationFrame(() => "
                   "requestAnimationFrame(() => setTimeout(done, 30))))")

    def mouse(self, kind, x, y, **more):
        super().mouse(kind, x, y, **more)
        self.settle()

    def key(self, name):
        self.call("Input.dispatchKeyEvent", {"type": "keyDown", "key": name})
        self.settle()

    def drag(self, start, end):
        self.mouse("mouseMoved", *start)
        self.mouse("mousePressed", *start, button="left", buttons=1, clickCount=1)
        self.mouse("mouseMoved", *end, button="left", buttons=1)
        self.mouse("mouseReleased", *end, button="left", clickCount=1)


def test(name):
    """Runs a function as a test of this name."""
    def decorate(function):
        global failed, passed
        try:
            function()
            passed += 1
            print("ok", name, flush=True)
        except Exception as error:  # of any kind: the test has failed
            failed += 1
            print("not ok", name, flush=True)
            print("   ", type(error).__name__, error, flush=True)
        return function
    return decorate


def equal(a, b, what=""):
    if a != b:
        raise AssertionError(f"{what} {a!r}, not {b!r}")


def read_pfm(path):
    """Rows from the top of a picture as PFM, and its width."""
    with open(path, "rb") as file:
        file.readline()
        width, height = map(int, file.readline().split())
        file.readline()
        values = struct.unpack(f"<{3 * width * height}f", file.read())
    rows = [values[3 * width * y:3 * width * (y + 1)] for y in range(height)]
    return rows[::-1], width


def render(rtc):
    """The page and two of its pictures, in the current folder."""
    with open("a.rts", "w") as file:
        file.write(SCENE)
    with open("sun.rts", "w") as file:
        file.write(SUN)
    with open("l.studies", "w") as file:
        file.write(LIST)
    for line in (["study", "--list", "l.studies", "--out", "page.html"],
                 ["a.rts", "--spp", "1", "--out", "a.pfm"],
                 ["a.rts", "--spp", "16", "--out", "b.pfm"]):
        subprocess.run([rtc, *line, "--quiet"], check=True)


def main(rtc, folder):
    render(rtc)
    address = "file://" + os.path.abspath("page.html")
    with chromium.Browser() as browser:
        page = Page(browser, address)
        run_tests(page)
        heard = [page] + run_sizes(browser, address, folder)

        @test("console_is_silent_and_no_request_leaves_the_page")
        def _():
            equal([text for page in heard for text in page.said + page.errors], [])
            equal({url for page in heard for url in page.requests}, {address})
    print(f"{passed} passed, {failed} failed")
    return 1 if failed else 0


def box(page, what):
    """Where an element is in the window, scrolled to."""
    return page.value(f"""(() => {{ const e = document.querySelector({json.dumps(what)});
        e.scrollIntoView({{ block: "center" }});
        const r = e.getBoundingClientRect(); return [r.x, r.y, r.width, r.height]; }})()""")


def inside(place, x, y):
    return (place[0] + x * place[2], place[1] + y * place[3])


def view(page):
    return page.value("(() => { const d = document.querySelector('#one .viewer').dataset;"
                    " return [d.zoom, d.x, d.y].map(Number); })()")


def choose(page, index, value):
    """Picks an entry of the two lists of pictures."""
    page.value(f"""(() => {{ const s = document.querySelectorAll("#one .bar select")[{index}];
        s.value = [...s.options].findIndex(o => o.text === {json.dumps(value)});
        s.dispatchEvent(new Event("change")); }})()""")
    page.settle()


def press(page, what):
    page.value(f"document.querySelector({json.dumps(what)}).click()")
    page.settle()


def readout(page):
    """The three rows of numbers below the pictures."""
    lines = page.value("document.querySelector('#one .readout').textContent").split("\n")
    return lines[0], [[float(v) for v in re.findall(r"-?[\d.]+(?:e-?\d+)?", line)[:3]]
                      for line in lines[1:]]


def colour(page, x, y):
    """Of a point of the first canvas, in parts of its size."""
    return page.value(f"""(() => {{ const c = document.querySelector("#one .viewer canvas");
        return [...c.getContext("2d").getImageData({x} * c.width, {y} * c.height, 1, 1).data]
            .slice(0, 3); }})()""")


def as_srgb(value):
    v = min(max(value, 0), 1)
    return 255 * (12.92 * v if v <= 0.0031308 else 1.055 * v ** (1 / 2.4) - 0.055)


def run_tests(page):
    rows_a, width = read_pfm("a.pfm")
    rows_b, _ = read_pfm("b.pfm")
    first, second = "spp 1, sampler sobol", "spp 16, sampler sobol"
    place = box(page, "#one .viewer canvas")

    @test("studies_titles_and_texts_are_shown_as_written")
    def _():
        equal(page.value("document.querySelector('h1').textContent"), "Two <b>studies</b>")
        equal(page.value("document.title"), "Two <b>studies</b>")
        equal(page.value("[...document.querySelectorAll('h2')].map(e => e.textContent)"),
              ["Samples & sampler", "Modes", "Caustics"])
        equal(page.value("document.querySelector('#one p').textContent"), "A text.")
        equal(page.value("[...document.querySelectorAll('nav a')].map("
                         "e => e.getAttribute('href'))"), ["#one", "#two", "#three"])

    @test("slider_moves_by_mouse_and_by_keys")
    def _():
        choose(page, 0, first)
        choose(page, 1, second)
        at = inside(place, 0.5, 0.5)
        page.drag(at, inside(place, 0.2, 0.5))
        left = page.value("parseFloat(document.querySelector('#one .divider').style.left)")
        if abs(left - 20) > 1:
            raise AssertionError(f"the divider is at {left} %")
        page.value("document.querySelector('#one .divider').focus()")
        for _ in range(5):
            page.key("ArrowRight")
        now = page.value("parseFloat(document.querySelector('#one .divider').style.left)")
        if abs(now - left - 10) > 0.5:
            raise AssertionError(f"five keys moved the divider from {left} to {now} %")
        # On the left of it there is the first picture, on the right the second.
        for x, rows in ((0.1, rows_a), (0.9, rows_b)):
            pixel = [rows[8][3 * int(x * width) + c] for c in range(3)]
            for got, wanted in zip(colour(page, x, 8.5 / 16), pixel):
                if abs(got - as_srgb(wanted)) > 1.5:
                    raise AssertionError(f"colour {got} at {x}, not {as_srgb(wanted)}")

    @test("pixel_values_are_those_of_rtc")
    def _():
        for x, y in ((5, 3), (12, 8), (20, 14)):
            page.mouse("mouseMoved", *inside(place, (x + 0.5) / width, (y + 0.5) / 16))
            head, numbers = readout(page)
            equal(head, f"pixel {x}, {y}")
            for c in range(3):
                a, b = rows_a[y][3 * x + c], rows_b[y][3 * x + c]
                # nine bits below the largest of three, and three digits
                room = max(rows_a[y][3 * x:3 * x + 3]) / 256 + 0.006 * abs(a)
                for got, wanted in ((numbers[0][c], a), (numbers[1][c], b),
                                    (numbers[2][c], a - b)):
                    if abs(got - wanted) > 2 * room:
                        raise AssertionError(f"{got}, not {wanted}, at {x}, {y}")

    @test("wheel_zooms_about_the_pointer_and_keys_move")
    def _():
        at = inside(place, 0.25, 0.25)
        page.mouse("mouseWheel", *at, deltaX=0, deltaY=-600)
        zoom, x, y = view(page)
        equal(zoom, 4.0)
        # The point below the pointer stays: 6 = x + 6 / 4.
        if abs(x - 4.5) > 0.1 or abs(y - 3) > 0.1:
            raise AssertionError(f"the view is at {x}, {y}")
        page.value("document.querySelector('#one .viewer canvas').focus()")
        page.key("ArrowRight")
        if not view(page)[1] > x:
            raise AssertionError("the arrow does not move the view")
        page.drag(inside(place, 0.6, 0.7), inside(place, 0.65, 0.7))
        if not view(page)[1] < x + 0.6:
            raise AssertionError("dragging does not move the view")

    @test("both_panes_show_the_same_part_side_by_side")
    def _():
        press(page, "#one button[data-mode=beside]")
        panes = box(page, "#one .viewer canvas")
        for x in (0.05, 0.2, 0.45):
            page.mouse("mouseMoved", *inside(panes, x, 0.5))
            left = readout(page)[0]
            page.mouse("mouseMoved", *inside(panes, x + 0.5, 0.5))
            equal(readout(page)[0], left)
        before = view(page)
        page.mouse("mouseWheel", *inside(panes, 0.75, 0.5), deltaX=0, deltaY=-300)
        after = view(page)
        equal(after[0], 2 * before[0])
        page.mouse("mouseMoved", *inside(panes, 0.25, 0.5))
        left = readout(page)[0]
        page.mouse("mouseMoved", *inside(panes, 0.75, 0.5))
        equal(readout(page)[0], left)
        for _ in range(12):
            press(page, "#one button[aria-label='zoom out']")
        equal(view(page), [1, 0, 0])

    @test("difference_is_red_where_the_first_is_brighter_and_blue_where_the_second_is")
    def _():
        press(page, "#one button[data-mode=difference]")
        seen = set()
        for y in range(16):
            for x in range(width):
                apart = max((rows_a[y][3 * x + c] - rows_b[y][3 * x + c] for c in range(3)),
                            key=abs)
                if abs(apart) < 0.02:
                    continue
                red, green, blue = colour(page, (x + 0.5) / width, (y + 0.5) / 16)
                wanted = max(0, 255 * (1 - 8 * abs(apart)))
                if abs(green - wanted) > 14 or (red if apart > 0 else blue) != 255:
                    raise AssertionError(f"{(red, green, blue)} for a difference of {apart}")
                seen.add(apart > 0)
        equal(seen, {True, False})
        choose(page, 1, first)
        equal(colour(page, 0.4, 0.4), [255, 255, 255])
        press(page, "#one button[data-mode=slider]")

    @test("exposure_brightens_the_viewer_and_the_sheet")
    def _():
        dark = [colour(page, 0.05, 0.05), page.value(SHEET_COLOUR)]
        page.value("""(() => { const s = document.querySelector("#one select[aria-label=exposure]");
            s.value = 1; s.dispatchEvent(new Event("change")); })()""")
        page.settle()
        for before, after in zip(dark, (colour(page, 0.05, 0.05), page.value(SHEET_COLOUR))):
            if not after[0] > before[0]:
                raise AssertionError(f"{before} has become {after}")

    @test("sheet_has_every_picture_with_its_label_and_numbers")
    def _():
        equal(page.value("document.querySelectorAll('#one .sheet button').length"), 7)
        text = page.value("document.querySelectorAll('#one .sheet button')[5].textContent")
        if not re.match(r"spp 16, sampler independentrelMSE [\d.e-]+, [\d.e-]+ s$", text):
            raise AssertionError(text)
        press(page, "#one .sheet button:nth-child(5)")
        equal(page.value("document.querySelector('#one .name.a').textContent"), second)
        if "rtc a.rts --spp 16" not in page.value(
                "document.querySelector('#one .command code').textContent"):
            raise AssertionError("the command is not that of the picture")

    run_plots(page)


SHEET_COLOUR = """(() => { const c = document.querySelector("#one .sheet canvas");
    return [...c.getContext("2d").getImageData(1, 1, 1, 1).data]; })()"""


def run_plots(page):
    @test("plots_have_axes_and_values_to_hover")
    def _():
        plots = page.value("""[...document.querySelectorAll("#one svg")].map(s => ({
            texts: [...s.querySelectorAll("text")].map(t => t.textContent),
            titles: [...s.querySelectorAll("circle title")].map(t => t.textContent),
            nan: s.outerHTML.includes("NaN") }))""")
        equal(len(plots), 2)
        for plot, name in zip(plots, ("root of relMSE", "time, s")):
            if "spp" not in plot["texts"] or name not in plot["texts"] or plot["nan"]:
                raise AssertionError(str(plot))
            ticks = [t for t in plot["texts"] if re.fullmatch(r"[\d.e-]+", t)]
            if len(ticks) < 4:
                raise AssertionError(f"ticks {ticks}")
        if not re.match(r"noise, sampler sobol: spp 1, root of relMSE [\d.e-]+$",
                        plots[0]["titles"][0]):
            raise AssertionError(plots[0]["titles"][0])
        equal(len(plots[1]["titles"]), 6)

    @test("plots_and_table_have_the_numbers_of_the_csv")
    def _():
        with open("page.one.csv") as file:
            head, *lines = [line.split(",") for line in file.read().splitlines()]
        for index, name in ((0, "relmse"), (1, "relative_rmse"), (2, "flip")):
            page.value("""(() => { const s = document.querySelector(
                "#one select[aria-label='the error that is plotted']"); s.value = "%s";
                s.dispatchEvent(new Event("change")); })()""" % name.replace("relative_", ""))
            shown = page.value("""[...document.querySelectorAll("#one svg")][0]
                .querySelectorAll("circle title").length""")
            equal(shown, 6)
            titles = page.value("""[...[...document.querySelectorAll("#one svg")][0]
                .querySelectorAll("circle title")].map(t => t.textContent)""")
            table = page.value(f"""[...document.querySelectorAll("#one tbody tr")].map(
                row => row.children[2 + {index}].textContent)""")
            wanted = [float(line[head.index(name)]) for line in lines]
            for value, text in zip(wanted, table):
                if not math.isclose(value, float(text), rel_tol=0.006):
                    raise AssertionError(f"{text} in the table, not {value}")
            for value in wanted:
                if not any(math.isclose(value, float(t.split()[-1]), rel_tol=0.006)
                           for t in titles):
                    raise AssertionError(f"{value} is not in the plot: {titles}")

    @test("what_a_reference_lacks_stands_above_and_beside_the_numbers")
    def _():
        warnings = page.value("[...document.querySelectorAll('#three .warning')]"
                              ".map(e => e.textContent)")
        if not any("leaves out caustics of point, spot and directional" in w for w in warnings):
            raise AssertionError(warnings)
        table = page.value("""[...document.querySelectorAll("#three tr")].map(
            row => [...row.children].map(e => e.textContent))""")
        head, path, vcm, reference = table
        column, own = head.index("leaves out"), float(reference[head.index("noise")])
        for row, lacks in ((path, True), (vcm, False), (reference, True)):
            equal(row[column].startswith("caustics of point"), lacks, row[0])
        value, beside = vcm[head.index("bias")].split(" ± ")
        if not (float(value) > 0 and math.isclose(float(beside), own, rel_tol=0.01)):
            raise AssertionError(f"{value} ± {beside}, and the reference has {own}")


OVERFLOW = """document.documentElement.scrollWidth - document.documentElement.clientWidth"""
CONTRAST = """(() => {
    const light = c => { const v = c.match(/[\\d.]+/g).slice(0, 3).map(x => x / 255)
        .map(x => x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4);
        return 0.2126 * v[0] + 0.7152 * v[1] + 0.0722 * v[2]; };
    const of = e => light(getComputedStyle(e).color);
    const card = light(getComputedStyle(document.querySelector("section.study")).backgroundColor);
    const ratio = v => (Math.max(v, card) + 0.05) / (Math.min(v, card) + 0.05);
    return ["h2", "#one p", "#one td", "#one .legend span", "#one figcaption"].map(
        s => ratio(of(document.querySelector(s)))); })()"""


def run_sizes(browser, address, folder):
    grounds, pages = {}, []
    for size, (width, height) in SIZES.items():
        for is_dark in (False, True):
            name = f"{size}-{'dark' if is_dark else 'light'}"
            page = Page(browser, address, width=width, height=height, dark=is_dark,
                        phone=size == "phone")
            pages.append(page)

            @test("page_fits_" + name)
            def _():
                page.screenshot(os.path.join(folder, name + ".png"))
                equal(page.value(OVERFLOW), 0, "wider than the window by")
                place = box(page, "#one .viewer canvas")
                if place[2] < min(width - 70, 400) or place[0] < 0:
                    raise AssertionError(f"the viewer is {place}")
                if min(page.value(CONTRAST)) < 4.5:
                    raise AssertionError(f"contrasts {page.value(CONTRAST)}")
                grounds[is_dark] = page.value("getComputedStyle(document.body).backgroundColor")

    @test("theme_follows_the_system_and_the_button")
    def _():
        if grounds[True] == grounds[False]:
            raise AssertionError(f"both are {grounds}")
        press(pages[-1], "#theme")
        equal(pages[-1].value("getComputedStyle(document.body).backgroundColor"), grounds[False])
    return pages


if __name__ == "__main__":
    program = os.path.abspath(os.environ.get("RTC", "build/rtc"))
    pictures = os.path.abspath(os.environ.get("PAGES", "build/page"))
    os.makedirs(pictures, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="librt-page.") as scratch:
        os.chdir(scratch)
        code = main(program, pictures)
        os.chdir("/")
    sys.exit(code)
