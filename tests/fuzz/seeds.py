#!/usr/bin/env python3
"""seeds.py ROOT FOLDER: writes the programs of corpus/ and of every page's `nc` fences as seeds for the fuzzer."""
import hashlib
import re
import sys
from pathlib import Path

FENCE = re.compile(r"^```nc (\S+)[^\n]*\n(.*?)^```", re.MULTILINE | re.DOTALL)
DIALECT = re.compile(r'^DIALECT\(\w+, "([^"]+)"', re.MULTILINE)


def programs(root):
    """Texts with the number of their dialect, which is the first byte that the fuzzer reads."""
    dialects = DIALECT.findall((root / "dialects/dialects.def").read_text())
    for page in [*root.glob("rules/*/*.md"), *root.glob("tests/golden/**/*.md")]:
        for dialect, text in FENCE.findall(page.read_text()):
            yield dialects.index(dialect) if dialect in dialects else 0, text.encode()
    for path in root.glob("corpus/**/*"):
        if path.is_file() and path.suffix not in (".md", ".toml"):
            yield 0, path.read_bytes()


def main():
    root, folder = Path(sys.argv[1]), Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    for dialect, text in programs(root):
        (folder / hashlib.sha1(text).hexdigest()).write_bytes(bytes([dialect]) + text)
    print(f"{len(list(folder.iterdir()))} seeds")


if __name__ == "__main__":
    main()
