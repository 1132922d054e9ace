#!/usr/bin/env python3
"""Checks the architecture that .ci/layers.txt states: who includes whom, and what only one place may know.

    check_layers.py [ROOT]      prints each violation as path:line: reason; exit 1 when there is one
"""
import re
import sys
from dataclasses import dataclass, field
from pathlib import Path

INCLUDE = re.compile(r'^\s*#\s*include\s+(?:"([^"]+)"|<([^>]+)>)')
COMMENT = re.compile(r"//.*")


@dataclass
class Layers:
    libraries: list = field(default_factory=list)  # in order: each may include itself and those before it
    below: dict = field(default_factory=dict)  # folder -> first library that it may not include
    free: list = field(default_factory=list)  # folders that may include everything
    doors: list = field(default_factory=list)  # (prefix of a library header, places that may include it)
    words: list = field(default_factory=list)  # (pattern, places that may say it)


def read_layers(path):
    layers = Layers()
    for line in path.read_text().splitlines():
        fields = line.split()
        if not fields or fields[0].startswith("#"):
            continue
        if fields[0].startswith("<"):
            layers.doors.append((fields[0][1:], fields[1:]))
        elif fields[0].startswith("word:"):
            layers.words.append((re.compile(fields[0][5:], re.IGNORECASE), fields[1:]))
        elif fields[1:] == ["*"]:
            layers.free.append(fields[0])
        elif fields[1:2] == ["<"]:
            layers.below[fields[0]] = fields[2]
        else:
            layers.libraries.append(fields[0])
    return layers


def inside(path, folders):
    return any(path == folder or path.startswith(folder + "/") for folder in folders)


def library_of(path, layers):
    folders = layers.libraries + list(layers.below) + layers.free
    return next((folder for folder in folders if inside(path, [folder])), None)


def may_include(user, used, layers):
    if user == used or user in layers.free:
        return True
    if used not in layers.libraries:
        return False
    limit = layers.below.get(user, user)
    return layers.libraries.index(used) < layers.libraries.index(limit)


def resolve(root, path, target):
    for candidate in (Path("analyzer") / target, Path(target), path.parent / target):
        if (root / candidate).is_file():
            return candidate.as_posix()
    return None


def violations_of_include(root, path, quoted, angled, layers):
    if angled:
        for prefix, places in layers.doors:
            if angled.startswith(prefix) and not inside(path.as_posix(), places):
                yield f"<{angled}> may only be included in {', '.join(places)}"
        return
    used = resolve(root, path, quoted)
    if used is None:
        yield f'"{quoted}" is no file below analyzer/ or the project'
        return
    user_library, used_library = library_of(path.as_posix(), layers), library_of(used, layers)
    if used_library is None:
        yield f"{used} is in no library of .ci/layers.txt"
    elif not may_include(user_library, used_library, layers):
        yield f"{user_library} may not include {used_library} ({quoted})"


def violations_of_file(root, path, layers):
    if library_of(path.as_posix(), layers) is None:
        yield 1, "this folder is in no library of .ci/layers.txt"
        return
    for number, line in enumerate((root / path).read_text(errors="replace").splitlines(), 1):
        include = INCLUDE.match(line)
        if include:
            for reason in violations_of_include(root, path, include[1], include[2], layers):
                yield number, reason
            continue
        for pattern, places in layers.words:
            said = pattern.search(COMMENT.sub("", line))
            if said and not inside(path.as_posix(), places):
                yield number, f"only {', '.join(places)} may say `{said[0]}`: ask the dialect's data"


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent).resolve()
    layers = read_layers(root / ".ci" / "layers.txt")
    files = sorted(p.relative_to(root) for top in ("analyzer", "dialects", "rules")
                   for p in (root / top).rglob("*") if p.suffix in (".h", ".cpp", ".def"))
    count = 0
    for path in files:
        for number, reason in violations_of_file(root, path, layers):
            print(f"{path}:{number}: {reason}")
            count += 1
    print(f"{len(files)} files, {count} violations")
    return 1 if count or not files else 0


if __name__ == "__main__":
    sys.exit(main())
