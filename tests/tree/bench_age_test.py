#!/usr/bin/env python3
""".ci/bench_age.py on a repository of two commits: fresh, stale, unmarked and unknown tables."""
import subprocess
import sys
import tempfile
from pathlib import Path

CHECKER = Path(__file__).resolve().parents[2] / ".ci" / "bench_age.py"


def git(root, *words):
    name = ["-c", "user.name=Bench", "-c", "user.email=bench@example.org", "-c", "commit.gpgsign=false"]
    return subprocess.run(["git", "-C", str(root), *name, *words], check=True, capture_output=True, text=True).stdout


def commit(root, files, message):
    for name, text in files.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    git(root, "add", "-A")
    git(root, "commit", "-qm", message)
    return git(root, "rev-parse", "--short", "HEAD").strip()


def table(mark):
    return (f"{mark}\n\n" if mark else "") + "| a | b |\n|---|---|\n| 1 | 2 |\n\n"


def report(root):
    result = subprocess.run([sys.executable, str(CHECKER), "--root", str(root)], capture_output=True, text=True)
    return result.returncode, result.stdout


def main():
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        git(root, "init", "-q")
        first = commit(root, {"analyzer/base/a.cpp": "1\n", "docs/benchmarks.md": "\n"}, "first")
        second = commit(root, {"analyzer/surface/lsp/b.cpp": "1\n"}, "second")

        def with_docs(*marks):
            (root / "docs/benchmarks.md").write_text("".join(table(mark) for mark in marks))
            return report(root)

        status, text = with_docs(f"<!-- bench engine at {first} -->")
        assert (status, text) == (0, "docs/benchmarks.md:3: engine: fresh\n"), text
        status, text = with_docs(f"<!-- bench lsp at {first} -->", f"<!-- bench lsp at {second} -->")
        assert status == 1 and f"lsp: stale: what it measures has changed since {first} (commits: 1)" in text, text
        assert text.endswith("lsp: fresh\n"), text
        for mark, wrong in ((None, "no comment says"), ("<!-- bench engine at 0000000 -->", "is no revision"),
                            ("<!-- bench speed at 0000000 -->", "is no benchmark")):
            status, text = with_docs(mark)
            assert status == 1 and wrong in text, text
        (root / "analyzer/base/a.cpp").write_text("2\n")  # not committed yet
        status, text = with_docs(f"<!-- bench engine at {second} -->")
        assert status == 1 and "stale" in text, text
    return 0


if __name__ == "__main__":
    sys.exit(main())
