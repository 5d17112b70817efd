"""Laying and lifting: the reference, and how far each scheme is from it, at which cost."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from mudline.model.contact.arrays import FloatArray
from tests.benchmarks.dynamics.beam import read_beam
from tests.benchmarks.dynamics.lifting import Hoist, Lifting, touchdown
from tests.benchmarks.dynamics.reference import Path, Reference, Tolerance
from tests.benchmarks.dynamics.stepping import Run, run
from tests.benchmarks.studies.schemes import SCHEMES
from tests.benchmarks.tables import Cell, Row, column

DECK = "lay-and-lift.keyxm"
HOIST = Hoist(stiffness=50e3, height=1.2, lift_period=3.0, pull=0.03, pull_period=6.0)
END, EVERY = 6.0, 0.04
"""Seconds: of the run, and between the moments at which runs are compared."""
TIMES = np.linspace(0.0, END, round(END / EVERY) + 1)
TOLERANCES = (Tolerance(1e-8, 1e-3), Tolerance(1e-9, 5e-4))
STEPS = {True: (4, 8, 16, 32), False: (1, 2, 4, 8, 16)}
"""Steps in `EVERY`, of explicit and of implicit schemes."""

PATH = ("time [s]", "touchdown [m]", "hoist up [N]", "hoist along [N]", "hoist work [J]", "seabed work [J]",
        "damping work [J]")  # fmt: skip
RUNS = ("scheme", "title", "explicit", "step [s]", "evaluations", "tangents", "most iterations", "touchdown rms [m]",
        "touchdown max [m]", "peak force", "force rms", "seabed work", "energy balance", "failure")  # fmt: skip


def lifting() -> Lifting:
    """The line of the deck, and its hoist."""
    return Lifting(read_beam(DECK), HOIST)


class Seen(NamedTuple):
    """What runs are compared by, at s moments: touchdown and energy (s,), force of the hoist (s, 2), works (s, 3)."""

    touchdown: FloatArray
    force: FloatArray
    works: FloatArray
    energy: FloatArray


def look(system: Lifting, path: Path, times: FloatArray = TIMES) -> Seen:
    """What is compared of a path."""
    arcs = system.beam.start[:, 1]
    touches = np.array([touchdown(gap, arcs) for gap in path.gaps])
    parts = zip(times.tolist(), path.displacements, path.rates, strict=True)
    energy = np.array([system.energy(time, place, rate) for time, place, rate in parts])
    return Seen(touches, path.hoist, path.works, energy - energy[0])


def integrate(progress: Callable[[str], None]) -> list[tuple[Cell, ...]]:
    """The rows of `PATH` of the tighter of two integrations; their difference is told."""
    system = lifting()
    paths = [Reference(system, tolerance).run(TIMES) for tolerance in TOLERANCES]
    close, best = (look(system, path) for path in paths)
    off = {
        "m": paths[0].displacements - paths[1].displacements,
        "N": close.force - best.force,
        "m of touchdown": close.touchdown - best.touchdown,
    }
    told = ", ".join(f"{float(np.abs(each).max()):.1g} {unit}" for unit, each in off.items())
    progress(f"reference: {paths[1].events} events; tolerances differ by {told}")
    return [tuple(row.tolist()) for row in np.column_stack([TIMES, best.touchdown, best.force, best.works])]


class Truth(NamedTuple):
    """The reference as it is in the table: touchdown (s,), force of the hoist (s, 2), work of the seabed (s,).

    work: the largest that the hoist had done so far, J: errors of energy are shares of it.
    """

    touchdown: FloatArray
    force: FloatArray
    seabed: FloatArray
    work: float

    @classmethod
    def of(cls, rows: list[Row]) -> Truth:
        """From the rows of `PATH`."""
        by = {heading: np.array(column(rows, heading)) for heading in PATH}
        force = np.column_stack([by["hoist up [N]"], by["hoist along [N]"]])
        work = float(np.abs(by["hoist work [J]"]).max())
        return cls(by["touchdown [m]"], force, by["seabed work [J]"], work)


def measure(name: str, steps: int) -> tuple[Run, Seen | None]:
    """A scheme with so many steps between two of the moments; what is seen of it if it did not end early."""
    system = lifting()
    with np.errstate(all="ignore"):
        found = run(SCHEMES[name], system, TIMES, steps)
    return found, None if found.failure else look(system, found.path)


def row(name: str, steps: int, found: Run, seen: Seen | None, truth: Truth) -> tuple[Cell, ...]:
    """A row of `RUNS`."""
    scheme = SCHEMES[name]
    errors: tuple[Cell, ...] = (None,) * 6 if seen is None else _errors(seen, truth)
    cost = (found.evaluations, found.tangents, found.iterations or None)
    return (name, scheme.title, scheme.explicit, EVERY / steps, *cost, *errors, found.failure)


def _errors(seen: Seen, truth: Truth) -> tuple[float, ...]:
    off = seen.touchdown - truth.touchdown
    peak, force = float(truth.force[:, 0].max()), seen.force[:, 0] - truth.force[:, 0]
    balance = seen.works.sum(axis=1) - seen.energy
    return (
        _rms(off),
        float(np.abs(off).max()),
        float(seen.force[:, 0].max()) / peak - 1.0,
        _rms(force) / peak,
        float(np.abs(seen.works[:, 1] - truth.seabed).max()) / truth.work,
        float(np.abs(balance).max()) / truth.work,
    )


def _rms(values: FloatArray) -> float:
    return float(np.sqrt((values * values).mean()))
