"""The other programs, each in an environment of its own (see `tests.benchmarks.peers`), and what they found.

Rows of a program that is not installed are those that the tables have already.
"""

from __future__ import annotations

import json
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from tests.benchmarks.dynamics.bouncing import DECK, EVERY, TIMES, fall, for_exudyn
from tests.benchmarks.dynamics.chains import (
    CASES,
    PULLS,
    Case,
    Chain,
    Equilibrium,
    Tensions,
    catenary,
    lowered,
    on_springs,
    read_chain,
)
from tests.benchmarks.dynamics.reference import Tolerance
from tests.benchmarks.peers import Environment, Peer
from tests.benchmarks.runner import ROOT
from tests.benchmarks.tables import Cell, Row

MOORDYN = Peer("moordyn", ("moordyn==2.7.2", "numpy==2.4.6"), "static chain, and its fairlead pulled away")
EXUDYN = Peer("exudyn", ("exudyn==1.13.6", "numpy==2.4.6"), "bouncing beam")

CHAINS = ("depth [m]", "when", "friction", "source", "fairlead [kN]", "anchor [kN]")
ANCHOR = ("depth [m]", "node", "share of its weight", "friction missing up to it [kN]")
BOUNCES = ("step [s]", "program", "to 0.5 s [m]", "to 1 s [m]", "to 2 s [m]")
BOUNCE_PATH = ("time [s]", "reference, first node [m]", "last node [m]", "Exudyn, last node [m]")

CORRECTED, LOWERED = "corrected catenary", "lowered catenary"
"""Sources: the catenary as elements on an elastic seabed have it, and as the published tensions are."""
REST, PULLED, HELD = "at rest", "pulled", "pulled and held"
USUAL, STEEP = ("FricDamp 200", 200.0, 1e-3), ("FricDamp 3e7", 3e7, 1e-4)
"""Friction of MoorDyn: its name in the table, force over velocity (N s/m; the default, and one as steep as its step
allows), and the step it is run with (s)."""
STEEP_IN = 200
"""Metres of water where the steep one is run as well."""
_NEAR = 10
"""Nodes from the anchor that are looked at."""
_OVER, HOLD = 100.0, 100.0
"""Seconds of a pull in MoorDyn, and after it."""
_LONGEST = 900
_TOLERANCE = Tolerance(1e-9, 5e-4)


def ask(place: Environment, script: str, given: dict[str, Any]) -> dict[str, Any]:
    """What a peer's script answers; its last line is JSON. Raises RuntimeError with what it said if it failed."""
    words = [str(place.program("python")), str(Path(__file__).parent / script)]
    done = subprocess.run(
        words, input=json.dumps(given), capture_output=True, text=True, check=False, timeout=_LONGEST, cwd=ROOT
    )
    if done.returncode:
        raise RuntimeError((done.stderr.strip().splitlines() or ["no message"])[-1])
    answer: dict[str, Any] = json.loads(done.stdout.strip().splitlines()[-1])
    return answer


# ------------------------------------------------------------------------------------------------------------- chains


def chains(
    progress: Callable[[str], None], place: Environment, before: list[Row]
) -> tuple[list[tuple[Cell, ...]], list[tuple[Cell, ...]]]:
    """The rows of `CHAINS` and of `ANCHOR`."""
    rows: list[tuple[Cell, ...]] = []
    pressing: list[tuple[Cell, ...]] = []
    for case in CASES:
        progress(f"chain in {case.depth} m")
        tensions, shares = own(case)
        rows, pressing = rows + tensions, pressing + shares
        if place.reason:
            rows += [tuple(row.values()) for row in before if _of_moordyn(row, case)]
        else:
            rows += _moordyn(place, case)
    return rows, pressing


def _of_moordyn(row: Row, case: Case) -> bool:
    return row["source"].startswith("MoorDyn") and row["depth [m]"] == str(case.depth)


def own(case: Case) -> tuple[list[tuple[Cell, ...]], list[tuple[Cell, ...]]]:
    """Rows of `CHAINS`: published, by the evaluator's forces, and of the catenary; at rest, then pulled.

    And those of `ANCHOR`: how the anchor and the nodes next to it press in the end.
    """
    chain, pull = read_chain(case), PULLS[case.depth]
    free = Equilibrium.hanging(chain.smooth(), case.depth, case.distance)
    found = [
        (REST, "no", "published", Tensions(case.fairlead, case.anchor)),
        (REST, "no", "mudline", free.tensions()),
        (REST, "no", "catenary", catenary(chain, case.depth, case.distance, 0.0)),
        (REST, "no", CORRECTED, on_springs(chain, case.depth, case.distance)),
        (REST, "no", LOWERED, lowered(chain, case.depth, case.distance)),
    ]
    held = free.with_friction(chain)
    for friction, line, coefficient in (("no", free, 0.0), ("yes", held, chain.friction)):
        line.pull(pull)
        found.append((PULLED, friction, "mudline", line.tensions()))
        found.append((PULLED, friction, "catenary", catenary(chain, case.depth, case.distance + pull, coefficient)))
    shares = held.pressing()[:_NEAR]
    missing = np.cumsum((1.0 - shares) * chain.share[:_NEAR]) * chain.friction * chain.weight / 1e3
    near = zip(shares.tolist(), missing.tolist(), strict=True)
    return (
        [(case.depth, when, friction, source, *tensions) for when, friction, source, tensions in found],
        [(case.depth, node, *cells) for node, cells in enumerate(near, start=1)],
    )


def _moordyn(place: Environment, case: Case) -> list[tuple[Cell, ...]]:
    """With its default friction, and in one depth with a steep one."""
    chain = read_chain(case)
    rows: list[tuple[Cell, ...]] = []
    for friction, damping, step in (USUAL, STEEP) if case.depth == STEEP_IN else (USUAL,):
        answer = ask(place, "peer_moordyn.py", for_moordyn(chain, case, damping, step))
        for when, tensions in zip((REST, PULLED, HELD), answer["tensions"], strict=True):
            if when == REST and rows:
                continue
            rows.append((case.depth, when, friction, answer["program"], *tensions))
    return rows


def for_moordyn(chain: Chain, case: Case, damping: float, step: float) -> dict[str, Any]:
    """What `peer_moordyn` takes: all from the deck, but the published damping of the seabed."""
    seabed = chain.spring / chain.diameter
    return {
        "depth": case.depth,
        "distance": case.distance,
        "length": float(chain.length.sum()),
        "segments": len(chain.length),
        "diameter": chain.diameter,
        "mass": chain.mass,
        "axial": chain.axial,
        "seabed": seabed,
        "seabed_damping": 0.1 * seabed,
        "friction": chain.friction,
        "friction_damping": damping,
        "gravity": chain.gravity,
        "step": step,
        "pull": PULLS[case.depth],
        "over": _OVER,
        "hold": HOLD,
    }


# ------------------------------------------------------------------------------------------------------ bouncing beam


def bounces(
    progress: Callable[[str], None], place: Environment
) -> tuple[list[tuple[Cell, ...]], list[tuple[Cell, ...]]]:
    """The rows of `BOUNCES` and of `BOUNCE_PATH`; Exudyn must be there."""
    progress(f"reference of {DECK}")
    beam, path = fall(_TOLERANCE)
    exact = path.displacements[:, : beam.nodes] + beam.start[:, 0]
    rows: list[tuple[Cell, ...]] = []
    for steps in (2000, 8000, 32000):
        progress(f"Exudyn, {steps} steps")
        answer = ask(place, "peer_exudyn.py", for_exudyn(beam, steps))
        found = np.array(answer["heights"])
        off = np.abs(found - exact).max(axis=1)
        ends = (round(end / EVERY) + 1 for end in (0.5, 1.0, 2.0))
        rows.append((TIMES[-1] / steps, answer["program"], *(float(off[:end].max()) for end in ends)))
    picture = np.column_stack([TIMES, exact[:, 0], exact[:, -1], found[:, -1]])
    return rows, [tuple(float(cell) for cell in row) for row in picture]
