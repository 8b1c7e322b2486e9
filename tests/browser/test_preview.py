#!/usr/bin/env python3
"""`rtc --preview` and `--watch` in a real browser: RTC names the program. Screenshots go to the
folder PAGES, build/page by default."""

import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import threading
import traceback
import urllib.error
import urllib.request

import chromium

RTC = os.path.abspath(os.environ.get("RTC", "build/rtc"))
PAGES = os.path.abspath(os.environ.get("PAGES", "build/page"))

SCENE = """camera { eye 0 1.5 -5  look_at 0 0.8 0  fov 45 }
film { width 160  height 120 }
material white { kd 0.7 }
material red { kd 0.8 0.1 0.1 }
quad { corner -4 0 -4  edge1 0 0 8  edge2 8 0 0  material white }
sphere { centre -1 1 0  radius 1  material red }
sphere { centre 1 1 0  radius 0.9  material white }
quad { corner -1 4 -1  edge1 2 0 0  edge2 0 0 2  material white  radiance 8 }
"""


class Run:
    """rtc under way in a folder of its own; what it says is kept."""

    def __init__(self, options, scene=SCENE):
        self.folder = tempfile.TemporaryDirectory(prefix="rtc-page.")
        self.write(scene)
        self.process = subprocess.Popen([RTC, "s.rts", *options.split()], text=True,
                                        cwd=self.folder.name, stderr=subprocess.PIPE)
        self.said = self.process.stderr.readline()
        self.url = re.search(r"http://127\.0\.0\.1:\d+/[0-9a-f]{32}/", self.said)[0]
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self):
        for line in self.process.stderr:
            self.said += line

    def write(self, text):
        new, name = (os.path.join(self.folder.name, n) for n in ("new", "s.rts"))
        with open(new, "w") as file:
            file.write(text)
        os.replace(new, name)

    def has(self, name):
        return os.path.exists(os.path.join(self.folder.name, name))

    def end(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        return self.process.wait(60)


NUMBER = "Number(document.querySelector('canvas').dataset.number || 0)"
PHASE = "document.body.dataset.phase"
# The mean of what the canvas shows, to see that it is a picture.
MEAN = """(() => { const c = document.querySelector('canvas'), d = c.getContext('2d')
    .getImageData(0, 0, c.width, c.height).data; let sum = 0;
    for (let i = 0; i < d.length; i += 4) sum += d[i] + d[i + 1] + d[i + 2];
    return sum / (d.length / 4 * 3); })()"""
OVERFLOWS = "document.documentElement.scrollWidth > innerWidth"


def choose(page, selector, value):
    page.value("(e => { e.value = %s; e.dispatchEvent(new Event('input'));"
               " e.dispatchEvent(new Event('change')); })(document.querySelector(%s))"
               % (json.dumps(value), json.dumps(selector)))


def expect_clean(page, run):
    """Neither errors in the console, nor requests to anywhere else."""
    assert not page.errors, page.errors
    foreign = [url for url in page.requests if not url.startswith((run.url, "data:"))]
    assert page.requests and not foreign, foreign


def picture_grows_and_stop_writes_it(browser):
    run = Run("--spp 16000000 --aov --out o.pfm --preview")
    page = browser.open(run.url)
    first = page.wait(NUMBER)
    later = page.wait(f"{NUMBER} > {first} && {NUMBER}")
    page.wait(f"{NUMBER} > {later}")
    assert page.value(MEAN) > 10
    assert page.value("document.querySelector('progress').value") > 0
    assert "remaining" in page.value("document.querySelector('#state').textContent")
    page.click("#stop")
    page.wait(f"{PHASE} === 'stopped'")
    assert run.process.wait(60) == 130 and run.has("o.pfm"), run.said
    assert page.value("document.querySelector('#stop').disabled")
    expect_clean(page, run)
    page.close()


def exposure_layers_zoom_and_values_are_the_pages_own(browser):
    run = Run("--spp 16000000 --aov --out o.pfm --preview page")
    page = browser.open(run.url)
    page.wait(NUMBER)
    dark = page.value(MEAN)
    choose(page, "#stops", "2")
    assert page.value(MEAN) > 1.2 * dark
    choose(page, "#stops", "0")
    choose(page, "#layer", "shape")
    page.wait("shown && layer === 'shape' && shown.channels === 1")
    assert page.value("new Set(shown.values).size") >= 4
    choose(page, "#layer", "")
    box = page.value("(r => [r.x, r.y, r.width, r.height])"
                     "(document.querySelector('canvas').getBoundingClientRect())")
    x, y = box[0] + box[2] / 2, box[1] + box[3] / 2
    before = page.value("view.scale")
    page.mouse("mouseWheel", x, y, deltaX=0, deltaY=-600)
    page.wait(f"view.scale > 3.9 * {before}")
    page.mouse("mouseMoved", x, y)
    text = page.wait("(t => t.includes('W/') && t)(document.querySelector('#values').textContent)")
    column, row = map(int, re.match(r"(\d+), (\d+)", text).groups())
    assert abs(column - 80) <= 1 and abs(row - 60) <= 1, text
    at = page.value("view.x")
    page.mouse("mousePressed", x, y, button="left", clickCount=1)
    page.mouse("mouseMoved", x + 30, y + 10, button="left", buttons=1)
    page.mouse("mouseReleased", x + 30, y + 10, button="left")
    assert abs(page.value("view.x") - at - 30) < 1
    page.click("#fit")
    assert abs(page.value("view.scale") - before) < 1e-6
    expect_clean(page, run)
    run.end()
    page.close()


def the_page_stays_when_rtc_has_ended(browser):
    run = Run("--spp 64 --aov --out o.pfm --preview")
    page = browser.open(run.url)
    page.wait(f"{PHASE} === 'finished'")
    assert run.process.wait(60) == 0 and run.has("o.pfm")
    assert "wrote o.pfm" in page.value("document.querySelector('#messages').textContent")
    assert page.value(MEAN) > 10
    choose(page, "#layer", "normal")
    assert page.value("shown.channels") == 3 and page.value(MEAN) > 10
    expect_clean(page, run)
    page.close()


def errors_stand_beside_the_last_good_picture(browser):
    run = Run("--spp 16 --out o.pfm --watch --preview")
    page = browser.open(run.url)
    page.wait(f"{PHASE} === 'waiting'")
    number = page.wait(NUMBER)
    run.write(SCENE.replace("sphere", "shpere", 1))
    text = page.wait("(e => e && e.textContent)(document.querySelector('#messages .error'))")
    assert "s.rts:6:1" in text and "unknown block 'shpere'" in text, text
    assert page.value(NUMBER) == number and page.value(MEAN) > 10
    page.screenshot(os.path.join(PAGES, "error.png"))
    run.write(SCENE.replace("0.8 0.1 0.1", "0.1 0.8 0.1"))
    page.wait(f"{NUMBER} > {number} && !document.querySelector('#messages .error')")
    page.wait(f"{PHASE} === 'waiting'")
    run.write(SCENE.replace("width 160  height 120", "width 200  height 80"))
    page.wait("shown.width === 200 && shown.height === 80")
    expect_clean(page, run)
    assert run.end() in (0, 130)
    page.wait(f"{PHASE} === 'finished' || {PHASE} === 'stopped'")
    page.close()


def it_fits_phones_laptops_and_wide_screens(browser):
    run = Run("--spp 16000000 --aov --out o.pfm --preview")
    for name, width, height, phone in (("phone", 390, 844, True), ("laptop", 1280, 800, False),
                                       ("wide", 2560, 1080, False)):
        for dark in (False, True):
            page = browser.open(run.url, width=width, height=height, dark=dark, phone=phone)
            page.wait(NUMBER)
            assert not page.value(OVERFLOWS), name
            assert page.value("document.querySelector('canvas').clientHeight") > height * 0.4, name
            page.screenshot(os.path.join(PAGES, "%s-%s.png" % (name, "dark" if dark else "light")))
            expect_clean(page, run)
            page.close()
    run.end()


def another_program_gets_403(browser):
    del browser
    run = Run("--spp 16000000 --out o.pfm --preview")
    port = run.url.split(":")[2].split("/")[0]
    for path in ("", "picture", "0" * 32 + "/", "0" * 32 + "/picture"):
        try:
            urllib.request.urlopen("http://127.0.0.1:%s/%s" % (port, path), timeout=20)
            raise AssertionError(path)
        except urllib.error.HTTPError as error:
            assert error.code == 403, error.code
    run.end()


TESTS = (picture_grows_and_stop_writes_it, exposure_layers_zoom_and_values_are_the_pages_own,
         the_page_stays_when_rtc_has_ended, errors_stand_beside_the_last_good_picture,
         it_fits_phones_laptops_and_wide_screens, another_program_gets_403)


def main():
    failed = 0
    os.makedirs(PAGES, exist_ok=True)
    with chromium.Browser() as browser:
        for test in TESTS:
            try:
                test(browser)
                print("ok", test.__name__, flush=True)
            except Exception:  # each test is told, whatever it was
                failed += 1
                print("not ok", test.__name__, flush=True)
                traceback.print_exc()
    print("%d passed, %d failed" % (len(TESTS) - failed, failed))
    return failed > 0


sys.exit(main())
