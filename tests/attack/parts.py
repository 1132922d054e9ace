"""Which parts of the languages a project has, by its text: evidence that all of them are tried."""
import re

PARTS = {
    "calls": r"(G65|M98)P", "calls with L": r"(G65|M98)P[^\n]*L", "modal calls": r"\bG66P|\dG66P", "G66 with L": r"G66P\d+L",
    "local subprograms M97": r"M97P", "M99 P": r"M99P", "computed GOTO": r"GOTO[\[#]",
    "indirect variables": r"#\[", "aliased system variables": r"#(2[0-3]\d\d|25\d\d|52\d\d|70\d\d|1[014]\d{3}|11[0-3]\d)\b",
    "block skip": r"^/", "vacant": r"#0\b", "WHILE": r"WHILE\[", "DO alone": r"^DO\d|^N\d+DO\d", "functions": r"SQRT|FIX|FUP|ABS",
    "bits": r"\d(AND|OR|XOR|MOD)[\[#\d]", "alarms": r"#3000=", "decimal numbers": r"=\.\d|[A-Z]\.\d",
    "@PARAM": r"@PARAM", "@GLOBAL": r"@GLOBAL", "@REQUIRE": r"@REQUIRE", "@MODAL": r"@MODAL", "@START": r"@START",
    "@ENSURE": r"@ENSURE", "@ENSURE MODAL PRESERVED": r"MODAL PRESERVED", "@ASSIGNS": r"@ASSIGNS", "@GUARDED": r"@GUARDED",
    "@ALARM": r"@ALARM", "@INVARIANT": r"@INVARIANT", "@VARIANT": r"@VARIANT", "@CYCLIC": r"@CYCLIC",
    "@KEEPIN": r"@KEEPIN", "@KEEPOUT": r"@KEEPOUT", "@CLEARANCE": r"@CLEARANCE", "@TRAVEL": r"@TRAVEL", "@LIMIT": r"@LIMIT",
    "@OFFSET": r"@OFFSET G5", "@LENGTH": r"@LENGTH", "@MACHINE": r"@MACHINE", "G43": r"G43", "G44": r"G44", "G49": r"^[^(\n]*G49",
   
    "mirrors": r"G51\.1", "rotation": r"G68", "scaling": r"G51[XYZP]", "cycles": r"G8[1-59]|G73",
    "G52": r"G52", "G92": r"G92", "G10": r"G10L2", "G54 to G59": r"^G5[4-9]|[^.\d]G5[5-9]", "G54.1": r"G54\.1|G154", "G28": r"G28",
    "G53": r"G53",
    "arcs by R": r"G[23]X[^\n]*R", "arcs by I, J, K": r"G[23]X[^\n]*[IJK]", "G91": r"G91", "inches": r"G20",
    "o-word sub": r"o<?\w+>? sub", "o-word call": r"o<?\w+>? call", "o-word repeat": r"o\d+ repeat", "o-word while": r"o\d+ while",
    "o-word if": r"o\d+ if", "named variables": r"#<",
}
COMPILED = {name: re.compile(pattern, re.M) for name, pattern in PARTS.items()}
REGION = re.compile(r"@KEEP(?:IN|OUT) (\w+)")


def parts_of(files: dict) -> set:
    text = "\n".join(files.values())
    found = {name for name, pattern in COMPILED.items() if pattern.search(text)}
    programs = re.split(r"^(?=O\d)", text, flags=re.M)[1:]
    if len(programs) > 1:
        found.add("several programs")
    if len(files) > 1:
        found.add("several files")
    if any("G66P" in program for program in programs[1:]):
        found.add("G66 in a callee")
    if any(f"P{re.match('O([0-9]+)', p)[1]}" in re.sub(r"M99P\d+|M97P\d+", "", p) for p in programs):
        found.add("recursion")
    for program in programs:
        names = REGION.findall(program)
        if len(names) > len(set(names)):
            found.add("regions of several parts")
    if sum("repeat" in body for body in files.values()) > 1:
        found.add("repeat in several files")
    return found


def all_parts() -> list:
    return [*PARTS, "several programs", "several files", "G66 in a callee", "recursion", "regions of several parts",
            "repeat in several files"]
