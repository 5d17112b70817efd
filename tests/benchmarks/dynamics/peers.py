"""The chain by MoorDyn, in an environment of its own (see `tests.benchmarks.peers`), and by us.

Rows of MoorDyn, if it is not installed, are those that the table has already.
"""

from __future__ import annotations

import json
import subprocess
from collections.abc import Callable
from pathlib import Path

from tests.benchmarks.dynamics.chains import (
    CASES,
    Case,
    Equilibrium,
    Tensions,
    catenary,
    lowered,
    on_springs,
    read_chain,
)
from tests.benchmarks.peers import Environment, Peer
from tests.benchmarks.runner import ROOT
from tests.benchmarks.tables import Cell, Row

MOORDYN = Peer("moordyn", ("moordyn==2.7.2", "numpy==2.4.6"), "static chain")

CHAINS = ("depth [m]", "source", "fairlead [kN]", "anchor [kN]")
CORRECTED, LOWERED = "corrected catenary", "lowered catenary"
"""Sources: the catenary as elements on an elastic seabed have it, and as the published tensions are."""
_LONGEST = 900


def chains(progress: Callable[[str], None], place: Environment, before: list[Row]) -> list[tuple[Cell, ...]]:
    """The rows of `CHAINS`."""
    rows: list[tuple[Cell, ...]] = []
    for case in CASES:
        progress(f"chain in {case.depth} m")
        rows += own(case)
        if place.reason:
            rows += [tuple(row.values()) for row in before if _of_moordyn(row, case)]
        else:
            rows.append(_moordyn(place, case))
    return rows


def _of_moordyn(row: Row, case: Case) -> bool:
    return row["source"].startswith("MoorDyn") and row["depth [m]"] == str(case.depth)


def own(case: Case) -> list[tuple[Cell, ...]]:
    """Rows of `CHAINS`: published, by the evaluator's forces, and of the catenary."""
    chain, place = read_chain(case), (case.depth, case.distance)
    found = {
        "published": Tensions(case.fairlead, case.anchor),
        "mudline": Equilibrium.hanging(chain, *place).tensions(),
        "catenary": catenary(chain, *place),
        CORRECTED: on_springs(chain, *place),
        LOWERED: lowered(chain, *place),
    }
    return [(case.depth, source, *tensions) for source, tensions in found.items()]


def _moordyn(place: Environment, case: Case) -> tuple[Cell, ...]:
    """Its row: all from the deck, but the published damping of the seabed. Raises RuntimeError if it failed."""
    chain = read_chain(case)
    seabed = chain.spring / chain.diameter
    given = {
        "depth": case.depth,
        "distance": case.distance,
        "length": float(chain.length.sum()),
        "segments": len(chain.length),
        "diameter": chain.diameter,
        "mass": chain.mass,
        "axial": chain.axial,
        "seabed": seabed,
        "seabed_damping": 0.1 * seabed,
        "gravity": chain.gravity,
    }
    words = [str(place.program("python")), str(Path(__file__).with_name("peer_moordyn.py"))]
    done = subprocess.run(
        words, input=json.dumps(given), capture_output=True, text=True, check=False, timeout=_LONGEST, cwd=ROOT
    )
    if done.returncode:
        raise RuntimeError((done.stderr.strip().splitlines() or ["no message"])[-1])
    answer = json.loads(done.stdout.strip().splitlines()[-1])
    return case.depth, answer["program"], *answer["tensions"]
