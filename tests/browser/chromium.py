"""Chromium, headless, driven by its own protocol over a pipe (--remote-debugging-pipe): a page, its console, its requests."""
import base64
import json
import os
import select
import shutil
import subprocess
import tempfile
import time

BROWSER = shutil.which("chromium")
LONGEST_WAIT = 120  # seconds


class Failed(Exception):
    """What the page threw, or the browser refused."""


class Page:
    """One page in a profile of its own.  `seen` has the events of the protocol, in order."""

    def __init__(self, dark=False):
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        to_browser, self.output = os.pipe()
        self.input, from_browser = os.pipe()
        self.process = subprocess.Popen(
            [BROWSER, "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run",
             "--remote-debugging-pipe", f"--user-data-dir={self.profile.name}", "--window-size=1300,900",
             f"--blink-settings=preferredColorScheme={0 if dark else 1}"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, close_fds=False,
            preexec_fn=lambda: self.place(to_browser, from_browser))
        os.close(to_browser)
        os.close(from_browser)
        self.count, self.rest, self.seen, self.session = 0, b"", [], None
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Network", "Log"):
            self.call(f"{domain}.enable")

    @staticmethod
    def place(reading, writing):
        """Descriptors 3 and 4 are those of the protocol."""
        reading, writing = os.dup2(reading, 20), os.dup2(writing, 21)
        os.dup2(reading, 3)
        os.dup2(writing, 4)

    def close(self):
        self.process.terminate()
        self.process.wait()
        for descriptor in (self.input, self.output):
            os.close(descriptor)
        self.profile.cleanup()

    def receive(self, seconds):
        while b"\0" not in self.rest:
            if not select.select([self.input], [], [], seconds)[0]:
                raise TimeoutError("the browser does not answer")
            self.rest += os.read(self.input, 1 << 20)
        message, _, self.rest = self.rest.partition(b"\0")
        return json.loads(message)

    def call(self, method, **parameters):
        self.count += 1
        message = {"id": self.count, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        data = json.dumps(message).encode() + b"\0"
        while data:
            data = data[os.write(self.output, data):]
        while True:
            told = self.receive(LONGEST_WAIT)
            if told.get("id") != self.count:
                self.seen.append(told)
            elif "error" in told:
                raise Failed(told["error"]["message"])
            else:
                return told["result"]

    def evaluate(self, expression):
        told = self.call("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in told:
            raise Failed(json.dumps(told["exceptionDetails"])[:1000])
        return told["result"].get("value")

    def before(self, script):
        """Runs in each page before its own scripts."""
        self.call("Page.addScriptToEvaluateOnNewDocument", source=script)

    def open(self, address):
        self.call("Page.navigate", url=address)

    def wait(self, expression, seconds=LONGEST_WAIT):
        """Until the expression is true in the page; what it was then, True for a part of the page."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if value := self.evaluate(f"(value => value instanceof Node ? true : value)({expression})"):
                return value
            time.sleep(0.05)
        raise TimeoutError(f"never true: {expression}")

    def events(self, method):
        """Of those that came so far."""
        self.evaluate("0")
        return [each["params"] for each in self.seen if each.get("method") == method]

    def type(self, text):
        self.call("Input.insertText", text=text)

    def move(self, x, y):
        self.call("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y)

    def picture(self, path):
        path.write_bytes(base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"]))
