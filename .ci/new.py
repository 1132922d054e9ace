#!/usr/bin/env python3
"""Scaffolds what the project grows by: ./dev new rule GROUP NAME, ./dev new dialect NAME."""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]

RULE_CPP = """// {name}: SAY WHAT IT LOOKS FOR.
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules::{file} {{
namespace {{

void check(const Statement &statement, BlockId, const FileContext &context, const Reporter &reporter) {{
  if (!std::holds_alternative<BrokenStatement>(statement.node))
    return;
  reporter.report({{.message = fmt::format("{{}} SAY WHAT WAS SEEN", context.quoted(statement.span)),
                   .span = statement.span,
                   .notes = {{"SAY WHAT HAPPENS ON THE MACHINE", "SAY WHAT TO DO"}}}});
}}

}} // namespace

extern const Rule {symbol};
const Rule {symbol}{{.info = {{"{name}", Category::{category}, Severity::Warning, "Reports SAY WHAT."}},
                     .hooks = {{.statement = check}}}};

}} // namespace feedhold::rules::{file}
"""

RULE_PAGE = """# {name}

Reports SAY WHAT.

## Why it matters

SAY WHAT HAPPENS ON THE MACHINE.

## What to do

SAY HOW TO CORRECT THE PROGRAM.

## Reported: SAY WHAT IS WRONG

```nc fanuc-30i
O1000
M30
```

```findings
```

## Not reported: SAY WHAT IS DIFFERENT

```nc fanuc-30i
O1000
M30
```

```findings
```
"""

DIALECT_CPP = """// SAY WHICH CONTROLS THESE ARE.
#include "dialects/common/fanuc.h"

namespace feedhold {{

const Dialect &{symbol}() {{
  static const Dialect kDialect = [] {{
    Dialect dialect = makeFanuc(MachineKind::Milling);
    dialect.id = "{name}";
    dialect.title = "SAY ITS NAME";
    dialect.controls = "SAY WHICH CONTROLS";
    return dialect;
  }}();
  return kDialect;
}}

}} // namespace feedhold
"""

DIALECT_PARITY = """# {name}: what is modelled

| topic | modelled | source |
|---|---|---|
| SAY EACH FACT | yes / no / as another control | MANUAL, PAGE |
"""

# A group of another name holds rules about expressions, until its author says otherwise.
CATEGORIES = {"variables": "Variable", "alarms": "Alarm", "words": "Word", "calls": "Call",
              "comments": "Comment", "structure": "Structure", "suppressions": "Suppression",
              "flow": "Flow", "motion": "Motion", "contract": "Contract"}


def symbol_of(name):
    head, *rest = name.split("-")
    return head + "".join(part.capitalize() for part in rest)


def fail(message):
    print(f"new: {message}", file=sys.stderr)
    sys.exit(2)


def create(path, text):
    if path.exists():
        fail(f"{path.relative_to(ROOT)} exists")
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    print(path.relative_to(ROOT))


def add_line(path, macro, line, sort):
    """Adds a row to a .def table: among the others in order, or behind the last one."""
    lines = path.read_text().splitlines()
    rows = [index for index, text in enumerate(lines) if text.startswith(macro)]
    place = next((index for index in rows if sort and lines[index].split(",")[1] > line.split(",")[1]),
                 rows[-1] + 1 if rows else len(lines))
    path.write_text("\n".join([*lines[:place], line, *lines[place:]]) + "\n")
    print(f"{path.relative_to(ROOT)}: {line}")


def new_rule(group, name):
    category = CATEGORIES.get(group, "Expression")
    file, symbol = name.replace("-", "_"), symbol_of(name)
    folder = ROOT / "rules" / group
    create(folder / f"{file}.cpp", RULE_CPP.format(name=name, file=file, symbol=symbol, category=category))
    create(folder / f"{file}.md", RULE_PAGE.format(name=name))
    add_line(ROOT / "rules" / "rules.def", "RULE(", f"RULE({symbol}, {file})", sort=True)
    print("next: write both, then ./dev update-goldens rules and review `git diff`")


def new_dialect(name):
    folder, symbol = name.replace("-", "_"), symbol_of(name)
    create(ROOT / "dialects" / folder / f"{folder}.cpp", DIALECT_CPP.format(name=name, symbol=symbol))
    create(ROOT / "dialects" / folder / "parity.md", DIALECT_PARITY.format(name=name))
    add_line(ROOT / "dialects" / "dialects.def", "DIALECT(", f'DIALECT({symbol}, "{name}", "{folder}")', sort=False)


def main():
    arguments = sys.argv[1:]
    if arguments and not all(re.fullmatch(r"[a-z][a-z0-9-]*", argument) for argument in arguments):
        fail("names are kebab-case: divide-by-zero")
    if len(arguments) == 3 and arguments[0] == "rule":
        new_rule(*arguments[1:])
    elif len(arguments) == 2 and arguments[0] == "dialect":
        new_dialect(arguments[1])
    else:
        fail("usage: new rule GROUP NAME | new dialect NAME")


if __name__ == "__main__":
    main()
