#!/usr/bin/env python3
"""Holds files to 600 lines and functions to 60, so that each can be read in one sitting."""
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LONGEST_FILE = 600
LONGEST_FUNCTION = 60


def sources():
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "*.cpp", "*.h", "*.def", "*.py", "dev"],
                            cwd=ROOT, capture_output=True, text=True, check=True)
    return [Path(line) for line in listed.stdout.splitlines() if (ROOT / line).is_file()]


def functions(lines):
    """(line, length) of each function that starts at the margin, as clang-format lays them out."""
    start = None
    for number, line in enumerate(lines, 1):
        if start is None and line[:1].isalpha() and "(" in line and not line.rstrip().endswith(";"):
            start = number
        elif start is not None and line.startswith("}"):
            yield start, number - start + 1
            start = None
        elif start is not None and line[:1].isalpha() and "(" not in line:
            start = None


def main():
    violations = []
    files = sources()
    for path in files:
        lines = (ROOT / path).read_text(errors="replace").splitlines()
        if len(lines) > LONGEST_FILE:
            violations.append(f"{path}: {len(lines)} lines, at most {LONGEST_FILE}")
        if path.suffix in (".cpp", ".h"):
            violations += [f"{path}:{start}: a function of {length} lines, at most {LONGEST_FUNCTION}"
                           for start, length in functions(lines) if length > LONGEST_FUNCTION]
    print("\n".join(violations + [f"{len(files)} files, {len(violations)} violations"]))
    return 1 if violations or not files else 0


if __name__ == "__main__":
    sys.exit(main())
