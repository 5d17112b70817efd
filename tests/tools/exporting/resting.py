"""Run by an interpreter with MoorDyn: a model that was exported, brought to rest, as JSON in the last line of output.

`python tests/tools/exporting/resting.py MODEL SECONDS [METRES]`. MoorDyn's own statics come first, then so many seconds
of its dynamics with the ends held, or with the last coupled point moved along X within the first third of them;
`change` is the largest change of the total reaction in the last second, as a share of it.
"""

from __future__ import annotations

import json
import os
import sys
from importlib import import_module
from importlib.metadata import version
from pathlib import Path
from types import ModuleType
from typing import Any, TypeAlias

Json: TypeAlias = Any
_STEP = 0.5


def ends(text: str) -> list[float]:
    """Where the coupled points are, one behind the other."""
    rows = (line.split() for line in text.split("--- POINTS")[1].split("--- LINES ---", maxsplit=1)[0].splitlines())
    return [float(word) for row in rows if row[1:2] == ["Coupled"] for word in row[2:5]]


def state(moordyn: ModuleType, system: Json, lines: int) -> list[Json]:
    """Places and vertical forces of the seabed at the nodes of each line."""
    found = []
    for number in range(1, lines + 1):
        line = moordyn.GetLine(system, number)
        nodes = range(moordyn.GetLineNumberNodes(line))
        places = [moordyn.GetLineNodePos(line, node) for node in nodes]
        forces = [moordyn.GetLineNodeSeabedForce(line, node)[2] for node in nodes]
        found.append({"places": places, "forces": forces})
    return found


def main() -> None:
    """Print the state at rest."""
    model, seconds, moordyn = Path(sys.argv[1]), float(sys.argv[2]), import_module("moordyn")
    text = model.read_text(encoding="ascii")
    held = ends(text)
    lines = len(
        [row for row in text.split("--- LINES ---")[1].split("--- OPTIONS")[0].splitlines() if row.endswith(" p")]
    )
    os.chdir(model.parent)  # it looks for the file of the seabed in the working folder
    system = moordyn.Create(model.name)
    if moordyn.Init(system, held, [0.0] * len(held)):
        sys.exit("MoorDyn did not start")
    metres = float(sys.argv[3]) if len(sys.argv) > 3 else 0.0
    totals, time, speed = [], 0.0, [0.0] * len(held)
    while time < seconds:
        if metres:
            speed[-3] = metres / (seconds / 3.0) if time < seconds / 3.0 else 0.0
            held[-3] += speed[-3] * _STEP
        moordyn.Step(system, held, speed, time, _STEP)
        time += _STEP
        totals.append(sum(sum(line["forces"]) for line in state(moordyn, system, lines)))
    found = state(moordyn, system, lines)
    moordyn.Close(system)
    change = max(abs(total / totals[-1] - 1.0) for total in totals[-3:])
    sys.stdout.write(
        "\n" + json.dumps({"program": f"MoorDyn {version('moordyn')}", "lines": found, "change": change}) + "\n"
    )


if __name__ == "__main__":
    main()
