#!/usr/bin/env python3
"""CMakeLists.txt owns the version: where another file must say it, too, it says the same."""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
OWNER = ("CMakeLists.txt", r"^project\(feedhold VERSION (\S+)")
COPIES = [
    ("CHANGELOG.md", r"^## (\S+)"),
    ("docs/install.md", r"packaging/github@v(\S+)"),
    ("docs/pre-commit.md", r"rev: v(\S+)"),
    ("editors/emacs/feedhold-mode.el", r"^;; Version: (\S+)"),
    ("editors/vscode/package.json", r'^  "version": "([^"]+)"'),
    ("editors/vscode/package-lock.json", r'^  "version": "([^"]+)"'),
    ("packaging/github/action.yml", r"packaging/github@v([0-9.]+)"),
]


def version_in(name, pattern):
    found = re.search(pattern, (ROOT / name).read_text(), re.MULTILINE)
    return found[1] if found else None


def main():
    version = version_in(*OWNER)
    wrong = [f"{name}: {version_in(name, pattern)}, not {version}" for name, pattern in COPIES
             if version_in(name, pattern) != version]
    print("\n".join(wrong + [f"{len(COPIES)} copies of the version, {len(wrong)} wrong"]))
    return 1 if wrong or not version else 0


if __name__ == "__main__":
    sys.exit(main())
