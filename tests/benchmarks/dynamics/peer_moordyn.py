"""Run by the interpreter that has MoorDyn: a chain from JSON on standard input, its tensions as JSON in the last line.

MoorDyn finds its own static shape by dynamic relaxation. Z is up there, the fairlead is at the origin.
"""

from __future__ import annotations

import json
import sys
import tempfile
from importlib import import_module
from importlib.metadata import version
from pathlib import Path
from types import ModuleType
from typing import Any, TypeAlias

System: TypeAlias = Any
"""MoorDyn ships no types."""

_DECK = """A chain from the anchor to the fairlead
--- LINE TYPES
TypeName Diam Mass/m EA BA/-zeta EI Cd Ca CdAx CaAx
(name) (m) (kg/m) (N) (N-s/-) (N-m^2) (-) (-) (-) (-)
chain {diameter} {mass} {axial} -1.0 0 1.37 1.0 0.64 0.0
--- POINTS
ID Type X Y Z Mass Volume CdA Ca
(#) (-) (m) (m) (m) (kg) (m3) (m2) (-)
1 Fixed {distance} 0.0 -{depth} 0 0 0 0
2 Vessel 0.0 0.0 0.0 0 0 0 0
--- LINES
ID LineType AttachA AttachB UnstrLen NumSegs Outputs
(#) (name) (#) (#) (m) (-) (-)
1 chain 1 2 {length} {segments} -
--- OPTIONS
0 writeLog
0.001 dtM
{seabed} kBot
{seabed_damping} cBot
1025.0 WtrDnsty
{depth} WtrDpth
1.0 dtIC
400.0 TmaxIC
4.0 CdScaleIC
1.0e-5 threshIC
{gravity} g
---
"""


def tensions(system: System, moordyn: ModuleType) -> list[float]:
    """Of the line at the fairlead and at the anchor, kN."""
    line = moordyn.GetLine(system, 1)
    last = moordyn.GetLineNumberNodes(line) - 1
    found = []
    for node in (last, 0):
        x, y, z = moordyn.GetLineNodeTen(line, node)
        found.append((x * x + y * y + z * z) ** 0.5 / 1e3)
    return found


def main() -> None:
    """The tensions at rest."""
    given, moordyn = json.load(sys.stdin), import_module("moordyn")
    with tempfile.TemporaryDirectory() as folder:
        deck = Path(folder) / "chain.txt"
        deck.write_text(_DECK.format(**given), encoding="ascii")
        system = moordyn.Create(str(deck))
        if moordyn.Init(system, [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]):
            sys.exit("MoorDyn did not start")
        found = tensions(system, moordyn)
        moordyn.Close(system)
    print("\n" + json.dumps({"program": f"MoorDyn {version('moordyn')}", "tensions": found}))


if __name__ == "__main__":
    main()
