"""What was found, as files: the program, the claim, the call, and how to see it."""
from pathlib import Path

from . import files


def write_report(folder: Path, seed: int, number: int, project, contradiction):
    name = "".join(c if c.isalnum() else "-" for c in contradiction.kind)
    place = folder / f"{name}-{seed}"
    files.write_project(project, place)
    command = files.run_arguments(project, place, contradiction.program, contradiction.inputs)
    lines = [contradiction.kind, "", contradiction.what, ""]
    lines += ["Inputs: " + "; ".join(f"#{n}={v}" for n, v in sorted({**contradiction.inputs.locals,
                                                                  **contradiction.inputs.cells}.items())
                                    if v is not None),
              f"Modes at the start that differ from power-on: {contradiction.inputs.modes}",
              f"Place: { {a: str(v) for a, v in contradiction.inputs.place.items()} }",
              f"Choices: {contradiction.choices}",
              "See it: feedhold run " + " ".join(command),
              f"The claims: feedhold prove --dialect {project.dialect} {place}", ""]
    for file in project.files:
        lines += [f"--- {file.name}", file.text()]
    (place / "REPORT.txt").write_text("\n".join(lines))
