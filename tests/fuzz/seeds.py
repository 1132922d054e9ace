#!/usr/bin/env python3
"""seeds.py ROOT FOLDER: writes the programs of corpus/ and of every page's `nc` fences as seeds for the fuzzer."""
import hashlib
import re
import sys
from pathlib import Path

FENCE = re.compile(r"^```nc[^\n]*\n(.*?)^```", re.MULTILINE | re.DOTALL)


def programs(root):
    for page in [*root.glob("rules/*/*.md"), *root.glob("tests/golden/**/*.md")]:
        yield from (text.encode() for text in FENCE.findall(page.read_text()))
    for path in root.glob("corpus/**/*"):
        if path.is_file() and path.suffix not in (".md", ".toml"):
            yield path.read_bytes()


def main():
    root, folder = Path(sys.argv[1]), Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    for text in programs(root):
        (folder / hashlib.sha1(text).hexdigest()).write_bytes(b"\0" + text)
    print(f"{len(list(folder.iterdir()))} seeds")


if __name__ == "__main__":
    main()
