"""Headless Chromium by the Chrome DevTools protocol, through its pipe: messages of JSON, each with
a zero byte behind. For tests of pages, with nothing but Python's standard library."""

import base64
import json
import os
import shutil
import subprocess
import sys
import tempfile
import threading
import time

PROGRAMS = ("chromium", "chromium-browser", "google-chrome")


def program():
    """The browser's path, by CHROMIUM or the usual names; ends with a word where there is none."""
    found = os.environ.get("CHROMIUM") or next(filter(None, map(shutil.which, PROGRAMS)), None)
    if not found:
        sys.exit("no browser: Chromium is not installed (Debian: chromium), and CHROMIUM names "
                 "none; nothing was checked")
    return found


class Browser:
    """One browser, without a profile of anybody's, that knows no name but this machine's."""

    def __init__(self):
        self.folder = tempfile.mkdtemp(prefix="rtc-browser.")
        commands, self.to = os.pipe()
        self.back, answers = os.pipe()
        flags = ["--headless=new", "--remote-debugging-pipe", "--user-data-dir=" + self.folder,
                 "--no-first-run", "--no-default-browser-check", "--disable-background-networking",
                 "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage",
                 "--disable-gpu", "--mute-audio",
                 "--host-resolver-rules=MAP * ~NOTFOUND , EXCLUDE 127.0.0.1"]
        if os.geteuid() == 0:
            flags.append("--no-sandbox")
        line = 'exec "$0" "$@" 3<&%d 4>&%d' % (commands, answers)
        self.process = subprocess.Popen(["sh", "-c", line, program(), *flags],
                                        pass_fds=(commands, answers), stdin=subprocess.DEVNULL,
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(commands)
        os.close(answers)
        self.lock = threading.Condition()
        self.number, self.answers, self.pages, self.is_gone = 0, {}, {}, False
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self):
        rest = b""
        while True:
            try:
                more = os.read(self.back, 1 << 20)
            except OSError:
                more = b""
            *messages, rest = (rest + more).split(b"\0")
            with self.lock:
                for message in map(json.loads, messages):
                    if "id" in message:
                        self.answers[message["id"]] = message
                    elif message.get("sessionId") in self.pages:
                        self.pages[message["sessionId"]].hear(message)
                self.is_gone = not more
                self.lock.notify_all()
            if not more:
                return

    def call(self, method, parameters=None, session=None, patience=60):
        """Sends a command, and returns its result."""
        with self.lock:
            self.number += 1
            number = self.number
        message = {"id": number, "method": method, "params": parameters or {}}
        if session:
            message["sessionId"] = session
        data = json.dumps(message).encode() + b"\0"
        while data:
            data = data[os.write(self.to, data):]
        with self.lock:
            if not self.lock.wait_for(lambda: number in self.answers or self.is_gone, patience):
                raise TimeoutError(method)
            answer = self.answers.pop(number, {"error": "the browser has gone"})
        if "error" in answer:
            raise RuntimeError("%s: %s" % (method, answer["error"]))
        return answer["result"]

    def open(self, url, **options):
        return Page(self, url, **options)

    def close(self):
        try:
            self.call("Browser.close", patience=10)
        except (RuntimeError, TimeoutError, OSError):
            pass
        try:
            self.process.wait(10)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


class Page:
    """A page, what its console says of errors, and all that it asked for."""

    def __init__(self, browser, url, width=1280, height=800, dark=False, phone=False):
        self.browser, self.errors, self.requests = browser, [], []
        target = browser.call("Target.createTarget", {"url": "about:blank"})["targetId"]
        self.target = target
        self.session = browser.call("Target.attachToTarget",
                                    {"targetId": target, "flatten": True})["sessionId"]
        browser.pages[self.session] = self
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(domain + ".enable")
        self.size(width, height, phone)
        self.colours(dark)
        self.call("Page.navigate", {"url": url})
        self.wait("document.readyState === 'complete' && location.href !== 'about:blank'")

    def hear(self, message):
        method, data = message["method"], message["params"]
        if method == "Runtime.exceptionThrown":
            self.errors.append(json.dumps(data["exceptionDetails"]))
        elif method == "Runtime.consoleAPICalled" and data["type"] in ("error", "assert"):
            self.errors.append(json.dumps(data["args"]))
        elif method == "Log.entryAdded" and data["entry"]["level"] == "error":
            self.errors.append(data["entry"]["text"] + " " + data["entry"].get("url", ""))
        elif method == "Network.requestWillBeSent":
            self.requests.append(data["request"]["url"])

    def call(self, method, parameters=None):
        return self.browser.call(method, parameters, self.session)

    def size(self, width, height, phone=False):
        self.call("Emulation.setDeviceMetricsOverride",
                  {"width": width, "height": height, "deviceScaleFactor": 2 if phone else 1,
                   "mobile": phone})

    def colours(self, dark):
        self.call("Emulation.setEmulatedMedia",
                  {"features": [{"name": "prefers-color-scheme",
                                 "value": "dark" if dark else "light"}]})

    def value(self, expression):
        """What an expression of JavaScript, or its promise, comes to."""
        result = self.call("Runtime.evaluate", {"expression": expression, "awaitPromise": True,
                                                "returnByValue": True})
        if "exceptionDetails" in result:
            raise RuntimeError(json.dumps(result["exceptionDetails"])[:800])
        return result["result"].get("value")

    def wait(self, expression, patience=60):
        """Waits until an expression is true, and returns its value."""
        end = time.monotonic() + patience
        while time.monotonic() < end:
            value = self.value(expression)
            if value:
                return value
            time.sleep(0.02)
        raise TimeoutError(expression)

    def mouse(self, kind, x, y, **more):
        self.call("Input.dispatchMouseEvent", {"type": kind, "x": x, "y": y, **more})

    def click(self, selector):
        x, y = self.value("(r => [r.x + r.width / 2, r.y + r.height / 2])"
                          "(document.querySelector(%s).getBoundingClientRect())"
                          % json.dumps(selector))
        for kind in ("mousePressed", "mouseReleased"):
            self.mouse(kind, x, y, button="left", clickCount=1)

    def screenshot(self, path):
        data = self.call("Page.captureScreenshot", {"format": "png"})["data"]
        with open(path, "wb") as file:
            file.write(base64.b64decode(data))

    def close(self):
        self.browser.call("Target.closeTarget", {"targetId": self.target})
