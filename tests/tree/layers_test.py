#!/usr/bin/env python3
"""The checker of the layers must see what it is for: a small tree with one violation of each kind."""
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CHECKER = ROOT / ".ci" / "check_layers.py"

GOOD = {
    "analyzer/base/source/file.h": '#include "base/support/id.h"\n// as in the FANUC manual\n',
    "analyzer/base/support/id.h": "#pragma once\n",
    "analyzer/surface/cli/main.cpp": "#include <CLI/CLI.hpp>\n#include <nlohmann/json.hpp>\n",
}
BAD = {
    "a library below": ("analyzer/base/support/id.h", '#include "base/source/file.h"\n'),
    "a dialect that sees the lexer": ("dialects/one/one.cpp", '#include "language/lex/lexer.h"\n'),
    "a rule that sees a dialect": ("rules/words/rule.cpp", '#include "dialects/one/one.h"\n'),
    "a second door": ("analyzer/base/support/id.h", "#include <nlohmann/json.hpp>\n"),
    "a maker's name": ("rules/words/rule.cpp", 'if (id == "haas-ngc") return;\n'),
    "a missing header": ("analyzer/base/support/id.h", '#include "base/support/gone.h"\n'),
    "an unknown library": ("analyzer/base/attic/id.h", "\n"),
}


def run(files):
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        needed = {"analyzer/language/lex/lexer.h": "", "dialects/one/one.h": "",
                  ".ci/layers.txt": (ROOT / ".ci" / "layers.txt").read_text()}
        for name, text in {**GOOD, **needed, **files}.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text)
        return subprocess.run([sys.executable, CHECKER, root], capture_output=True, text=True)


def main():
    failures = 0
    good = run({})
    if good.returncode != 0:
        print(f"a clean tree is refused:\n{good.stdout}")
        failures += 1
    for name, (path, text) in BAD.items():
        result = run({path: text})
        if result.returncode != 1 or f"{path}:1: " not in result.stdout:
            print(f"not seen: {name}\n{result.stdout}{result.stderr}")
            failures += 1
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
