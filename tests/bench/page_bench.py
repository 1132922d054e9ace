#!/usr/bin/env python3
"""Measures the page (./dev web): its size, and in Chromium the time to the first finding, and to the next ones.

    page_bench.py [--page FILE] [--times N]

Each time a browser with an empty profile opens the file; the page itself notes when its list of findings first has one,
counted from the beginning of the navigation.  Then a key is typed, and the time until the list is made anew counts the
pause of a quarter of a second that the page waits for more keys.
"""
import argparse
import gzip
import statistics
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/browser"))
from chromium import Page  # noqa: E402

# When the list of findings was filled, in milliseconds of the page.
NOTES = """window.filled = [];
new MutationObserver(() => {
  const list = document.getElementById("findings");
  if (list?.querySelector("[data-rule]") && list.firstChild !== window.lastFirst) {
    window.lastFirst = list.firstChild;
    window.filled.push(performance.now());
  }
}).observe(document, { childList: true, subtree: true });"""


def megabytes(size):
    return f"{size / 1e6:.1f} MB"


def times_of(page):
    browser = Page()
    try:
        browser.before(NOTES)
        browser.open(page.as_uri())
        browser.wait("window.filled?.length > 0")
        first = browser.evaluate("filled[0]")
        browser.evaluate("document.querySelector('.cm-content').focus()")
        browser.evaluate("window.filled = []; window.typed = performance.now()")
        browser.type(" ")
        browser.wait("filled.length > 0")
        return first, browser.evaluate("filled[0] - typed")
    finally:
        browser.close()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--page", type=Path, default=ROOT / "dist/web/index.html")
    parser.add_argument("--times", type=int, default=9)
    options = parser.parse_args()
    data = options.page.read_bytes()
    print(f"the page: {megabytes(len(data))}, {megabytes(len(gzip.compress(data, 9)))} compressed by gzip")
    first, again = zip(*(times_of(options.page.resolve()) for _ in range(options.times)))
    for name, times in (("first finding", first), ("after a key", again)):
        print(f"{name}: median {statistics.median(times):.0f} ms, {min(times):.0f} to {max(times):.0f} ms of {len(times)}")


if __name__ == "__main__":
    main()
