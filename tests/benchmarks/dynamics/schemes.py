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
TOLERANCES = tuple(Tolerance(10.0**-power, 4e-3 / 2 ** (power - 6)) for power in (6, 7, 8, 9))
STEPS = {True: (4, 8, 16, 32), False: (1, 2, 4, 8, 16)}
"""Steps in `EVERY`, of explicit and of implicit schemes."""

PATH = ("time [s]", "touchdown [m]", "hoist up [N]", "hoist along [N]", "hoist work [J]", "seabed work [J]",
        "damping work [J]")  # fmt: skip
REFERENCE = ("relative tolerance", "longest step [s]", "events", "evaluations", "energy balance [J]",
             "to the tightest: displacement [m]", "force [N]", "seabed work [J]", "touchdown [m]")  # fmt: skip
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


def integrate(progress: Callable[[str], None]) -> tuple[list[tuple[Cell, ...]], list[tuple[Cell, ...]]]:
    """The rows of `REFERENCE` and of `PATH`, the latter of the tightest integration."""
    system = lifting()
    paths: list[Path] = []
    for tolerance in TOLERANCES:
        progress(f"reference, {tolerance.relative:g}")
        paths.append(Reference(system, tolerance).run(TIMES))
    seen = [look(system, path) for path in paths]
    rows: list[tuple[Cell, ...]] = []
    for tolerance, path, one in zip(TOLERANCES, paths, seen, strict=True):
        balance = float(np.abs(one.works.sum(axis=1) - one.energy).max())
        off: tuple[Cell, ...] = (
            _most(path.displacements, paths[-1].displacements),
            _most(one.force, seen[-1].force),
            _most(one.works[:, 1], seen[-1].works[:, 1]),
            _most(one.touchdown, seen[-1].touchdown),
        )
        last: tuple[Cell, ...] = (None, None, None, None)
        rows.append((
            tolerance.relative, tolerance.longest, path.events, path.evaluations, balance,
            *(last if path is paths[-1] else off),
        ))  # fmt: skip
    best = seen[-1]
    table = np.column_stack([TIMES, best.touchdown, best.force, best.works])
    return rows, [tuple(float(cell) for cell in row) for row in table]


def _most(one: FloatArray, other: FloatArray) -> float:
    return float(np.abs(one - other).max())


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


def wanted() -> list[tuple[str, int]]:
    """All runs: the scheme, and its steps between two moments."""
    return [(name, steps) for name, scheme in SCHEMES.items() for steps in STEPS[scheme.explicit]]
