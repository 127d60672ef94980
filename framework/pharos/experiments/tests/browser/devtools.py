"""Chromium by its DevTools protocol over a pipe: no driver, no library, no port.

Commands and events are JSON, one a NUL, on the browser's file descriptors 3 (in) and 4 (out).
"""

import json
import os
import select
import shutil
import subprocess
import tempfile
import time

FLAGS = [
    "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
    "--disable-extensions", "--disable-dev-shm-usage", "--hide-scrollbars",
    "--force-device-scale-factor=1", "--remote-debugging-pipe",
]


class Browser:
    """One headless browser with one page; what the page logs, throws and requests is kept."""

    def __init__(self, program):
        self.folder = tempfile.mkdtemp(prefix="pharos-browser-")
        ours_out, theirs_in = os.pipe()[::-1]
        ours_in, theirs_out = os.pipe()

        def give_descriptors():
            # Copied up first: either may sit on the number that the other has to take.
            reading, writing = os.dup(theirs_in), os.dup(theirs_out)
            os.dup2(reading, 3)
            os.dup2(writing, 4)

        self.process = subprocess.Popen(
            [program, *FLAGS, f"--user-data-dir={self.folder}", "about:blank"],
            preexec_fn=give_descriptors, close_fds=False,
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(theirs_in)
        os.close(theirs_out)
        self.out, self.inp = ours_out, ours_in
        self.buffer, self.number, self.session = b"", 0, None
        self.problems, self.requests, self.downloads = [], [], []
        pages = self.send("Target.getTargets")["targetInfos"]
        page = next(info for info in pages if info["type"] == "page")["targetId"]
        self.session = self.send("Target.attachToTarget", targetId=page, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Network", "Log"):
            self.send(f"{domain}.enable")

    def close(self):
        try:
            self.session = None
            self.send("Browser.close")
            self.process.wait(10)
        except (OSError, RuntimeError, subprocess.TimeoutExpired):
            self.process.kill()
            self.process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def receive(self, seconds):
        """The next message, or None after that time."""
        end = time.monotonic() + seconds
        while b"\0" not in self.buffer:
            ready, _, _ = select.select([self.inp], [], [], max(0, end - time.monotonic()))
            if not ready:
                return None
            chunk = os.read(self.inp, 1 << 20)
            if not chunk:
                raise RuntimeError("the browser ended")
            self.buffer += chunk
        message, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(message)

    def note(self, message):
        """Keeps what a test wants to know of an event."""
        method, values = message.get("method"), message.get("params", {})
        if method == "Runtime.exceptionThrown":
            details = values["exceptionDetails"]
            self.problems.append(details.get("exception", {}).get("description", details["text"]))
        elif method == "Runtime.consoleAPICalled" and values["type"] in ("error", "warning", "assert"):
            self.problems.append(f"console: {values['args']}")
        elif method == "Log.entryAdded" and values["entry"]["level"] in ("error", "warning"):
            # Reading a canvas back is what tests do, not the page.
            if "willReadFrequently" not in values["entry"]["text"]:
                self.problems.append(f"log: {values['entry']['text']}")
        elif method == "Network.requestWillBeSent":
            self.requests.append(values["request"]["url"])
        elif method == "Page.downloadWillBegin":
            self.downloads.append(values["suggestedFilename"])

    def send(self, method, **values):
        """Sends a command and returns its result."""
        self.number += 1
        number = self.number
        command = {"id": number, "method": method, "params": values}
        if self.session:
            command["sessionId"] = self.session
        os.write(self.out, json.dumps(command).encode() + b"\0")
        while True:
            message = self.receive(30)
            if message is None:
                raise RuntimeError(f"no answer to {method} within 30 s")
            if message.get("id") != number:
                self.note(message)
                continue
            if "error" in message:
                raise RuntimeError(f"{method}: {message['error']}")
            return message["result"]

    def run(self, script):
        """The value of a JavaScript expression, awaited."""
        answer = self.send("Runtime.evaluate", expression=script, awaitPromise=True,
                           returnByValue=True, userGesture=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(f"{script}: {answer['exceptionDetails']}")
        return answer["result"].get("value")

    def wait(self, script, seconds=10):
        """Waits until the expression is true; False when it does not become so."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if self.run(script):
                return True
            time.sleep(0.02)
        return False

    def open(self, url):
        self.send("Page.navigate", url=url)
        if not self.wait("document.readyState === 'complete'"):
            raise RuntimeError(f"{url} is not loaded within 10 s")

    def size(self, width, height):
        self.send("Emulation.setDeviceMetricsOverride", width=width, height=height,
                  deviceScaleFactor=1, mobile=False)

    def mouse(self, kind, x, y, **more):
        values = {"button": "left", "buttons": 1, "clickCount": 1}
        if kind == "mouseMoved":
            values = {}
        if kind == "mouseWheel":
            values = {"deltaX": 0, "deltaY": 0}
        self.send("Input.dispatchMouseEvent", type=kind, x=x, y=y, **{**values, **more})

    def drag(self, start, end):
        self.mouse("mouseMoved", *start)
        self.mouse("mousePressed", *start)
        for part in (0.5, 1):
            self.mouse("mouseMoved", *(a + part * (b - a) for a, b in zip(start, end)), buttons=1)
        self.mouse("mouseReleased", *end)

    def key(self, key, code="", text="", shift=False):
        """A key pressed and let go, as a keyboard would."""
        codes = {"Tab": 9, "Enter": 13, " ": 32, "ArrowLeft": 37, "ArrowUp": 38, "ArrowRight": 39,
                 "ArrowDown": 40, "Home": 36, "End": 35}
        values = {"key": key, "code": code or key, "modifiers": 8 if shift else 0,
                  "windowsVirtualKeyCode": codes.get(key, 0)}
        text = text or {"Enter": "\r", " ": " "}.get(key, "")
        self.send("Input.dispatchKeyEvent", type="keyDown", text=text, **values)
        self.send("Input.dispatchKeyEvent", type="keyUp", **values)
