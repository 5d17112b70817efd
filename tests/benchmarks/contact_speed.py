"""Nanoseconds a node and step of the contact evaluator: python tests/benchmarks/contact_speed.py

Each round times every scene and every peer once, so that a busy machine slows all of them alike. Printed are, of the
times of the rounds, the medians, how many times the time of np.searchsorted (over the four points of a curve) and of a
copy of the positions each scene takes, medians of the ratios within a round, and the least times: what the machine does
when it is left alone.

The scenes: "curves" has neither history nor anything at nodes and takes steps together, "all" has every stage on
(smoothing, nodal springs, unloading, both suctions, friction, lateral springs, trenches, curves) over a flat bed,
"sloping" and "planes" are the same over those beds. Which node has which law is drawn at random, so compiled loops
guess many branches wrong; in a deck they come in long stretches. "fast" behind a name: with compiled loops.
"""

from __future__ import annotations

import argparse
import statistics
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2]))

from mudline.contact.compiled.choice import Backend
from mudline.contact.extras import Extras
from tests.contact.scenes import CLAY, everything

from mudline.contact import ContactInput, ContactModel
from mudline.contact.arrays import FloatArray
from mudline.contact.seabed import PlanesSeabed, Seabed, SlopingSeabed

Timed = Callable[[], object]

_PEERS = ("searchsorted", "copy")
_ROUND = 200_000
"""Node-steps a round and method, at least."""


def beds(elements: int) -> dict[str, Seabed | None]:
    """The beds of the scenes with everything on."""
    middle = [0.0, 2.0 * elements, 0.0]
    return {
        "all": None,
        "sloping": SlopingSeabed(0.001, 30.0),
        "planes": PlanesSeabed([[0.0, 0.0, 0.0], middle], [0.0, 0.5]),
    }


def scenes(nodes: int) -> dict[str, ContactInput]:
    """The scenes by name."""
    found = {name: everything(nodes - 1, 1, floor) for name, floor in beds(nodes - 1).items()}
    return {"curves": replace(found["all"], extras=Extras()), **found}


def series(points: FloatArray, steps: int) -> FloatArray:
    """Positions (steps, n, 3) of nodes that move a little about where they lie."""
    rng = np.random.default_rng(2)
    moves = rng.normal(0.0, 0.01, (4, *points.shape))
    return np.stack([points + moves[step % 4] for step in range(steps)])


def streaming(inputs: ContactInput, positions: FloatArray, backend: Backend) -> Timed:
    """A run through the whole series."""
    model, times = ContactModel(inputs, backend=backend), 0.1 * np.arange(float(len(positions)))

    def run() -> None:
        for _ in model.stream(positions, times=times):
            pass

    return run


def methods(nodes: int, steps: int) -> dict[str, Timed]:
    """Scenes and peers by name."""
    inputs = scenes(nodes)
    positions = series(inputs["all"].coordinates, steps)
    ratios = positions[..., 0].copy()
    target = np.zeros_like(positions)
    return {
        **{name: streaming(scene, positions, "numpy") for name, scene in inputs.items()},
        **{f"{name} fast": streaming(inputs[name], positions, "fast") for name in beds(nodes - 1)},
        "searchsorted": lambda: np.searchsorted(CLAY.ratios, ratios),
        "copy": lambda: np.copyto(target, positions),
    }


def timed(found: dict[str, Timed], rounds: int, node_steps: int) -> dict[str, list[float]]:
    """Nanoseconds a node and step in each round, after one to warm up."""
    taken: dict[str, list[float]] = {name: [] for name in found}
    for _ in range(rounds + 1):
        for name, method in found.items():
            start = time.perf_counter()
            method()
            taken[name].append((time.perf_counter() - start) / node_steps * 1e9)
    return {name: times[1:] for name, times in taken.items()}


def quotient(taken: dict[str, list[float]], method: str, peer: str) -> float:
    """Median over the rounds of how many times the time of `peer` the method takes."""
    return statistics.median(mine / other for mine, other in zip(taken[method], taken[peer], strict=True))


def main() -> None:
    """Time lines of growing numbers of nodes."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--nodes", type=int, nargs="+", default=[1000, 10_000, 100_000, 1_000_000])
    parser.add_argument("--rounds", type=int, default=3, help="rounds to take the median of (default 3)")
    arguments = parser.parse_args()
    heads = ["median [ns]", *(f"/{peer}" for peer in _PEERS), "least [ns]"]
    print(f"{'nodes':>8}{'scene':>14}" + "".join(f"{head:>15}" for head in heads))
    for nodes in arguments.nodes:
        steps = max(2, _ROUND // nodes)
        taken = timed(methods(nodes, steps), arguments.rounds, nodes * steps)
        for name, times in taken.items():
            cells = [statistics.median(times), *(quotient(taken, name, peer) for peer in _PEERS), min(times)]
            print(f"{nodes:>8}{name:>14}" + "".join(f"{cell:>15.2f}" for cell in cells), flush=True)


if __name__ == "__main__":
    main()
