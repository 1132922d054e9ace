"""The page in Chromium, opened from a file: findings as one types, proofs, drawings, ranges, links, and no request at all."""
import base64
import io
import json
import subprocess
import sys
import tarfile
import tempfile
import time
import unittest
from pathlib import Path

from packaged import PROVED, ROOT, VERSION, linux_program
from page import PAGE, WEB, main

sys.path.insert(0, str(ROOT / "tests/browser"))
from chromium import Page  # noqa: E402

EXAMPLES = json.loads((WEB / "examples/examples.json").read_text())
LONGEST_PROOF = 400
TEXT = "[...document.querySelectorAll('.cm-line')].map(line => line.textContent).join('\\n')"
CHECKED = "Number(document.body?.dataset.checked ?? 0)"
RULES = "[...document.querySelectorAll('#findings [data-rule]')].map(item => item.dataset.rule)"
PROOF_ENDED = "document.getElementById('verdicts') && document.getElementById('stop').hidden"
# Lets a test reach the workers of the page and what it saves.
WORKERS = """window.workers = [];
window.Worker = class extends Worker { constructor(...all) { super(...all); workers.push(this); } };
const makeURL = URL.createObjectURL;
URL.createObjectURL = blob => { window.lastBlob = blob; return makeURL.call(URL, blob); };"""
SWEEP = """O2000
#1=0
WHILE[#1LT3]DO1
G01X#1F100.
#1=#1+1
END1
M30
"""


class InBrowser(unittest.TestCase):
    """One browser for all; each test opens the page anew."""
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        cls.browser = Page()
        cls.addClassCleanup(cls.browser.close)
        cls.browser.before(WORKERS)
        cls.browser.call("Network.emulateNetworkConditions", offline=True, latency=0, downloadThroughput=-1,
                         uploadThroughput=-1)

    def setUp(self):
        self.browser.seen.clear()
        self.browser.open("about:blank")
        self.open("")

    def open(self, fragment):
        self.browser.open(PAGE.as_uri() + fragment)
        self.browser.wait(f"document.readyState == 'complete' && {CHECKED} > 0")

    def choose(self, file):
        self.browser.evaluate(f"""(() => {{ const list = document.getElementById('example'); list.value = {json.dumps(file)};
            list.dispatchEvent(new Event('change')); }})()""")

    def write(self, text):
        """Over the whole program, as by hand."""
        before = self.browser.evaluate(CHECKED)
        self.browser.evaluate("document.querySelector('.cm-content').focus()")
        self.browser.call("Input.dispatchKeyEvent", type="keyDown", key="a", code="KeyA", windowsVirtualKeyCode=65,
                          modifiers=2, commands=["selectAll"])
        self.browser.type(text)
        self.browser.wait(f"{CHECKED} > {before}")

    def click(self, identity):
        self.browser.evaluate(f"document.getElementById({json.dumps(identity)}).click()")

    def prove(self):
        self.click("prove")
        self.browser.wait("document.getElementById('stop').hidden == false || " + PROOF_ENDED)
        self.browser.wait(PROOF_ENDED, LONGEST_PROOF)

    def of_verdict(self, verdict):
        return self.browser.evaluate(
            f"[...document.querySelectorAll('#proof .{verdict}')].map(item => item.dataset.id)")


class Try(InBrowser):
    # ---- findings ----

    def test_findings_as_one_types(self):
        self.write("O1\n#1-1\nM30\n")
        self.assertEqual(self.browser.evaluate(RULES), ["missing-equals"])
        self.browser.wait("document.querySelector('.cm-lintRange-error')")
        self.write("O1\nM30\n")
        self.assertEqual(self.browser.evaluate(RULES), [])
        self.assertIn("No findings", self.browser.evaluate("document.getElementById('findings').textContent"))

    def test_control_is_detected_or_chosen(self):
        self.write("o100 while [#<a> LT 1]\n#<a>=[#<a>+1]\no100 endwhile\nM2\n")
        self.browser.evaluate("""(() => { const list = document.getElementById('dialect'); list.value = '';
            list.dispatchEvent(new Event('change')); })()""")
        self.browser.wait("document.getElementById('detected').textContent == 'Detect: linuxcnc'")
        self.browser.wait("document.querySelectorAll('#dialect option').length == 12")

    def test_rule_is_explained(self):
        self.browser.evaluate("document.querySelector('#findings [title]').click()")
        self.assertIn("Why it matters", self.browser.wait(
            "document.getElementById('explanation').open && document.getElementById('explanation-text').textContent"))

    def test_words_are_coloured(self):
        self.write(SWEEP)
        colours = self.browser.evaluate("""[...new Set([...document.querySelectorAll('.cm-line span')].map(
            span => getComputedStyle(span).color))].length""")
        self.assertGreaterEqual(colours, 4)

    # ---- what is known ----

    def test_ranges_on_hover(self):
        self.write(SWEEP)
        self.browser.wait("document.body.dataset.ranges == 'ready'")
        x, y = self.browser.evaluate("""(() => { const line = document.querySelectorAll('.cm-line')[3];
            const walker = document.createTreeWalker(line, NodeFilter.SHOW_TEXT); let node;
            while ((node = walker.nextNode()) && !node.data.includes('1')) {}
            const range = document.createRange(); range.selectNodeContents(node);
            const box = range.getBoundingClientRect(); return [box.right - 3, box.top + box.height / 2]; })()""")
        self.browser.move(x - 40, y)
        self.browser.move(x, y)
        self.assertTrue(self.browser.wait("document.querySelector('.facts')?.textContent", 20))

    # ---- proofs, runs ----

    def test_stop(self):
        self.choose("pocket-gouge.nc")
        self.browser.wait("document.getElementById('stop').hidden == false")
        self.click("stop")
        self.browser.wait("document.getElementById('stop').hidden")
        self.write("O1\n#1-1\nM30\n")
        self.assertEqual(self.browser.evaluate(RULES), ["missing-equals"])

    def test_refutation_is_drawn(self):
        self.choose("unguarded-division.nc")
        self.browser.wait("document.querySelector('#proof .refuted')", LONGEST_PROOF)
        self.assertIn("O9115.no-control-alarm.N10", self.of_verdict("refuted"))
        self.browser.evaluate("document.querySelector('#proof .refuted .draw').click()")
        self.browser.wait("document.querySelector('#drawing .picture')?.shadowRoot.querySelector('svg')")
        self.assertIn("PS0112", self.browser.wait("document.querySelector('#drawing details pre')?.textContent"))

    def test_certificates_are_verified_and_saved(self):
        self.write(PROVED)
        self.prove()
        self.assertEqual(len(self.of_verdict("proved")), 2)
        self.browser.evaluate("document.querySelector('#certificates button').click()")
        told = self.browser.wait("/Save/.test(document.getElementById('certificates')?.textContent) && "
                                 "document.getElementById('certificates').textContent")
        self.assertRegex(told, r"[1-9]\d* certificates? in exact arithmetic, verified by the solver-free checker")
        self.browser.evaluate("document.querySelector('#certificates button').click()")
        saved = self.browser.evaluate("""new Promise(done => { const reader = new FileReader();
            reader.onload = () => done(reader.result.split(',')[1]); reader.readAsDataURL(lastBlob); })""")
        with tempfile.TemporaryDirectory() as folder:
            with tarfile.open(fileobj=io.BytesIO(base64.b64decode(saved))) as archive:
                archive.extractall(f"{folder}/evidence")
            (Path(folder) / "O9101.nc").write_text(PROVED)
            told = subprocess.run([linux_program(), "recheck", "evidence"], cwd=folder, capture_output=True, text=True)
            self.assertEqual(told.returncode, 0, told.stdout + told.stderr)

    # ---- links ----

    def test_link_carries_the_program(self):
        program = "O77(LINK \u00e4 \u65e5)\n#1-1\nM30\n"
        self.write(program)
        self.browser.evaluate("document.getElementById('arguments').value = 'A=5 #500=1'")
        self.click("link")
        fragment = self.browser.wait("location.hash.startsWith('#1.') && location.hash")
        self.browser.open("about:blank")
        self.open(fragment)
        self.assertEqual(self.browser.evaluate(TEXT), program)
        self.assertEqual(self.browser.evaluate("document.getElementById('arguments').value"), "A=5 #500=1")
        self.assertEqual(self.browser.wait(RULES), ["missing-equals"])

    def test_damaged_link(self):
        self.browser.open("about:blank")
        self.open("#1.x.y.%%%")
        self.assertTrue(self.browser.evaluate(TEXT).startswith("O5"))

    # ---- faults ----

    def test_failing_worker_is_replaced(self):
        self.browser.evaluate("""workers.forEach(worker => { worker.postMessage = function () {
            this.dispatchEvent(new ErrorEvent('error', { message: 'out of memory' })); }; })""")
        count = self.browser.evaluate("workers.length")
        self.browser.evaluate("document.querySelector('.cm-content').focus()")
        self.browser.type("(A)")
        told = self.browser.wait("document.querySelector('#findings .fault')?.textContent")
        self.assertIn("out of memory", told)
        self.write("O1\n#1-1\nM30\n")
        self.assertEqual(self.browser.evaluate(RULES), ["missing-equals"])
        self.assertGreater(self.browser.evaluate("workers.length"), count)

    def test_run_without_end_is_reported(self):
        self.write("O1\nN1G01X1.F100.\nG01X2.\nGOTO1\nM30\n")
        self.click("run")
        self.assertIn("runs for ever", self.browser.wait("document.querySelector('#drawing details pre')?.textContent"))

    # ---- the page as a whole ----

    def test_console_is_silent_and_nothing_is_requested(self):
        self.choose("unguarded-division.nc")
        self.browser.wait(PROOF_ENDED, LONGEST_PROOF)
        self.click("run")
        self.browser.wait("document.querySelector('#drawing details')")
        for method in ("Runtime.consoleAPICalled", "Runtime.exceptionThrown", "Log.entryAdded"):
            self.assertEqual(self.browser.events(method), [], method)
        asked = [each["request"]["url"] for each in self.browser.events("Network.requestWillBeSent")]
        self.assertEqual([url for url in asked if not url.startswith(("blob:", "data:", "about:", PAGE.as_uri()))], [])
        policy = self.browser.evaluate("fetch('https://example.com/').then(() => 'sent', () => 'refused')")
        self.assertEqual(policy, "refused")

    def test_narrow_window(self):
        self.browser.call("Emulation.setDeviceMetricsOverride", width=500, height=800, deviceScaleFactor=1, mobile=False)
        self.addCleanup(self.browser.call, "Emulation.clearDeviceMetricsOverride")
        self.assertLessEqual(self.browser.evaluate("document.documentElement.scrollWidth - innerWidth"), 0)

    def test_version(self):
        self.browser.wait(f"document.getElementById('version').textContent == 'Feedhold {VERSION}'")


class Examples(InBrowser):
    """Each example shows what its text says."""

    def test_list(self):
        self.assertEqual(len(EXAMPLES), 10)
        self.assertEqual({each["file"] for each in EXAMPLES}, {path.name for path in (WEB / "examples").glob("*.nc")})

    def test_findings_are_those_of_the_packaged_program(self):
        for example in EXAMPLES:
            with self.subTest(example["file"]):
                told = subprocess.run([linux_program(), "check", "--format", "json", "--dialect", example["dialect"],
                                       WEB / "examples" / example["file"]], capture_output=True, text=True)
                native = [finding["rule"] for finding in json.loads(told.stdout)["findings"]]
                self.assertEqual(native, example["expect"]["rules"])
                before = self.browser.evaluate(CHECKED)
                self.choose(example["file"])
                self.browser.wait(f"{CHECKED} > {before}")
                self.assertEqual(self.browser.evaluate(RULES), native)
                self.click("stop")

    def test_proofs(self):
        for example in EXAMPLES:
            expect = example["expect"]
            if not {"proved", "refuted"} & expect.keys():
                continue
            with self.subTest(example["file"]):
                self.choose(example["file"])
                self.browser.wait("document.getElementById('stop').hidden == false || document.body.dataset.checked > 0")
                self.click("stop")
                self.prove()
                self.assertLessEqual(set(expect.get("refuted", [])), set(self.of_verdict("refuted")))
                if "proved" in expect:
                    self.assertEqual(self.of_verdict("refuted") + self.of_verdict("unknown"), [])
                    self.assertGreater(len(self.of_verdict("proved")), 10)
                if "guards" in expect:
                    self.assertIn("holds if", self.browser.evaluate("document.getElementById('proof').textContent"))

    def test_runs(self):
        for example in EXAMPLES:
            if "runs" not in example["expect"]:
                continue
            with self.subTest(example["file"]):
                self.choose(example["file"])
                self.assertIn("ends with M", self.browser.wait("document.querySelector('#drawing details pre')?.textContent"))
                self.assertGreater(self.browser.evaluate(
                    "document.querySelector('#drawing .picture').shadowRoot.querySelectorAll('svg path, svg line').length"), 5)


class Dark(unittest.TestCase):
    def test_dark_and_time(self):
        browser = Page(dark=True)
        self.addCleanup(browser.close)
        began = time.monotonic()
        browser.open(PAGE.as_uri())
        browser.wait(f"{CHECKED} > 0")
        print(f"first finding after {time.monotonic() - began:.2f} s", file=sys.stderr)
        self.assertEqual(browser.evaluate("getComputedStyle(document.body).backgroundColor"), "rgb(13, 17, 23)")


if __name__ == "__main__":
    main()
