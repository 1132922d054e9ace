#!/usr/bin/env python3
"""Writes docs/rules/README.md: every rule with its first sentence, by group, linked to its page.

    rule_index.py            write it
    rule_index.py --check    exit 1 when it is not what would be written
"""
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
INDEX = ROOT / "docs/rules/README.md"
HEAD = """# Rules

Made by `.ci/rule_index.py` from the pages in `rules/`; `./dev update-goldens` makes it anew. A page says why the rule is
there, and its examples are the tests of the rule. `feedhold explain RULE` prints a page.
"""


def first_sentence(page):
    """Name and first paragraph of a page."""
    title, _, rest = page.read_text().partition("\n\n")
    return title.removeprefix("# "), " ".join(rest.split("\n\n")[0].split())


def index():
    parts = [HEAD]
    for group in sorted(folder for folder in (ROOT / "rules").iterdir() if folder.is_dir()):
        rows = [first_sentence(page) + (page.relative_to(ROOT),) for page in sorted(group.glob("*.md"))]
        if rows:
            lines = [f"| [{name}](../../{path}) | {sentence.replace('|', chr(92) + '|')} |" for name, sentence, path in rows]
            parts.append(f"\n## {group.name}\n\n| rule | |\n|---|---|\n" + "\n".join(lines) + "\n")
    return "".join(parts)


def main():
    text = index()
    if "--check" in sys.argv:
        if not INDEX.exists() or INDEX.read_text() != text:
            sys.exit(f"{INDEX.relative_to(ROOT)} is not up to date; run .ci/rule_index.py")
        return
    INDEX.parent.mkdir(parents=True, exist_ok=True)
    INDEX.write_text(text)


main()
