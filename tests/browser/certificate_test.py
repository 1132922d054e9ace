"""The page of `certify` in Chromium: it renders, says nothing on the console, is light and dark, draws calls, and prints."""
import hashlib
import html.parser
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FEEDHOLD = os.environ["FEEDHOLD"]
BROWSER = shutil.which("chromium")
ORACLES = os.environ.get("FEEDHOLD_ORACLES") == "1"
SKIPPED = 77  # ctest's word for a test that could not run here
PROGRAMS = ["O9311.nc", "O9313.nc"]  # one is proved, one gouges
CALLING = """O9399(EACH AFTER THE OTHER, AND SOMETHING THAT IS NOT HERE)
N10G65P9311
N20G65P9313
N30G65P9399
N40G65P8999
N50M30
"""
# Of each box in a drawing of calls: how far the widest of its texts is from its side, in pixels of the drawing.
MEASURE = """<script>
const rooms = [...document.querySelectorAll(".call-graph .node")].map(node => {
  const box = node.querySelector(".box").getBBox();
  return Math.min(...[...node.querySelectorAll("text")].map(text => {
    const words = text.getBBox();
    return Math.min(words.x - box.x, box.x + box.width - words.x - words.width,
                    words.y - box.y, box.y + box.height - words.y - words.height);
  }));
});
document.body.dataset.rooms = rooms.map(room => room.toFixed(1)).join(" ");
document.body.dataset.wide = document.documentElement.scrollWidth - window.innerWidth;
</script>"""
DARK = "--blink-settings=preferredColorScheme=0"
LIGHT = "--blink-settings=preferredColorScheme=1"


class Anchors(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.ids, self.targets = set(), set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name == "id":
                self.ids.add(value)
            if name == "href" and value.startswith("#"):
                self.targets.add(value[1:])


def rows_of(png):
    """The pixels of a picture as the browser writes it: 8 bits a channel, not interlaced."""
    data = png.read_bytes()
    width, height = int.from_bytes(data[16:20], "big"), int.from_bytes(data[20:24], "big")
    assert (data[24], data[28]) == (8, 0), "another kind of PNG"
    size = {2: 3, 6: 4}[data[25]]
    packed, at = b"", 8
    while at < len(data):
        length = int.from_bytes(data[at:at + 4], "big")
        if data[at + 4:at + 8] == b"IDAT":
            packed += data[at + 8:at + 8 + length]
        at += 12 + length
    raw, stride, before = zlib.decompress(packed), width * size, bytearray(width * size)
    for y in range(height):
        kind = raw[y * (stride + 1)]
        row = bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for x in range(stride):
            left = row[x - size] if x >= size else 0
            up, corner = before[x], before[x - size] if x >= size else 0
            if kind == 4:
                guess = left + up - corner
                left = min((left, up, corner), key=lambda each: abs(guess - each))
            row[x] = (row[x] + (0, left, up, (left + up) // 2, left)[kind]) & 255
        before = row
        yield [tuple(row[x:x + 3]) for x in range(0, stride, size)]


class Certificate(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.holder.cleanup)
        cls.folder = Path(cls.holder.name)
        for name in PROGRAMS:
            shutil.copy(ROOT / "corpus" / "packages" / "pocket" / name, cls.folder)
        (cls.folder / "O9399.nc").write_text(CALLING)
        result = subprocess.run([FEEDHOLD, "certify", *PROGRAMS, "O9399.nc", "-o", "report"], cwd=cls.folder, timeout=120)
        assert result.returncode == 1, "one of the programs gouges"
        cls.page = cls.folder / "report" / "index.html"

    def browse(self, *options, page=None):
        """One visit in a profile of its own; the result has the console on standard error."""
        profile = self.folder / "profile"
        result = subprocess.run([BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
                                 "--disable-dev-shm-usage", f"--user-data-dir={profile}", "--enable-logging=stderr",
                                 "--no-pdf-header-footer", *options, (page or self.page).as_uri()],
                                capture_output=True, text=True, timeout=120)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def pixels(self, name, *options):
        path = self.folder / f"{name}.png"
        self.browse(f"--screenshot={path}", "--window-size=700,900", *options)
        return [pixel for row in rows_of(path) for pixel in row]

    def test_console_is_silent(self):
        told = self.browse("--dump-dom").stderr
        self.assertNotIn("CONSOLE", told)
        self.assertNotIn("ERR_", told)

    def test_anchors_lead_somewhere(self):
        anchors = Anchors(self.browse("--dump-dom").stdout)
        self.assertGreaterEqual(len(anchors.targets), 4)
        self.assertEqual(anchors.targets - anchors.ids, set())

    def test_words_fit_into_their_boxes_and_nothing_is_wider_than_the_window(self):
        measured = self.page.with_name("measured.html")
        measured.write_text(self.page.read_text().replace("</body>", MEASURE + "</body>"))
        self.addCleanup(measured.unlink)
        for width in (1100, 700):
            told = self.browse("--dump-dom", f"--window-size={width},900", page=measured).stdout
            rooms = [float(room) for room in re.search('data-rooms="([^"]*)"', told).group(1).split()]
            self.assertEqual(len(rooms), 4)
            self.assertGreater(min(rooms), 1)
            self.assertLessEqual(int(re.search('data-wide="([^"]*)"', told).group(1)), 0)

    def test_light_and_dark(self):
        light, dark = self.pixels("light", LIGHT), self.pixels("dark", DARK)
        for pixels, ground in ((light, (255, 255, 255)), (dark, (13, 17, 23))):
            self.assertEqual(max(set(pixels), key=pixels.count), ground)
            self.assertGreater(len(set(pixels)), 50, "the page is blank")
            self.assertGreater(len(pixels) - pixels.count(ground), len(pixels) // 50)

    def test_paper_is_light_and_has_pages(self):
        path = self.folder / "report.pdf"
        self.browse(f"--print-to-pdf={path}", DARK)
        content = path.read_bytes()
        self.assertTrue(content.startswith(b"%PDF-"))
        pages = len(re.findall(rb"/Type\s*/Page\b", content))
        self.assertGreater(pages, 4, "the first page is for who signs, the others for who checks")
        ink = b".1216 .1373 .1569 rg"  # 31, 35, 40 of 255: that of the light page
        self.assertIn(ink, b"".join(self.streams(content)))

    @unittest.skipUnless(shutil.which("pdftotext"), "needs pdftotext")
    def test_first_page_is_for_who_signs(self):
        path = self.folder / "pages.pdf"
        self.browse(f"--print-to-pdf={path}")
        text = subprocess.run(["pdftotext", "-layout", path, "-"], capture_output=True, text=True, check=True).stdout
        pages = text.split("\f")[:-1]
        hashes = [hashlib.sha256((self.folder / name).read_bytes()).hexdigest() for name in (*PROGRAMS, "O9399.nc")]
        first = "".join(pages[0].split())  # a hash may go over two lines
        for words in ("Not fit for release", "Summary", "Sign-off", "Author", "Checker", "Approver",
                      hashlib.sha256((self.page.parent / "certificate.json").read_bytes()).hexdigest(), *hashes):
            self.assertIn("".join(words.split()), first)
        self.assertNotIn("Contract", pages[0])
        for number, page in enumerate(pages, 1):
            self.assertIn(f"page {number} of {len(pages)}", page)
            lines = [line.strip() for line in page.splitlines() if line.strip() and "page " not in line]
            self.assertNotIn(lines[-1], ("Claims", "Contract", "Calls", "Identity", "Assumptions", "Summary"),
                             "a heading without what it heads")
        claims = [page for page in pages if re.search(r"^\s*✓ +[0-9]+ +O9311", page, re.MULTILINE)]
        self.assertGreater(len(claims), 1, "the table goes over pages")
        for page in claims:
            self.assertRegex(page, r"Verdict +Line +Claim +How", "each part of a table has its head")

    @staticmethod
    def streams(content):
        for match in re.finditer(rb"stream\r?\n", content):
            try:
                yield zlib.decompressobj().decompress(content[match.end():])
            except zlib.error:  # a stream that is not packed: a font
                continue


if __name__ == "__main__":
    if not (ORACLES and BROWSER):
        print("skipped: needs `--oracles` and Chromium")
        sys.exit(SKIPPED)
    unittest.main()
