"""What limits an explicit step: of the line, of each law on it, and of the suction as it acts in a run.

The limit of a law is that of a line whose nodes all move together, so that each node has the whole stiffness or damping
of its length. Where one element alone is damped, its two nodes share the damping, and the rate is half of that.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.contact.stiffest import CRITICAL_OMEGA_DT, critical_step
from mudline.study.motion import Forces, History
from mudline.study.report import Cell
from mudline.study.schemes import SCHEMES, KickDrift
from tests.benchmarks.dynamics.beam import Beam, read_beam
from tests.benchmarks.dynamics.lifting import DAMPING, Lifting
from tests.benchmarks.dynamics.schemes import DECK, EVERY, TIMES, lifting
from tests.benchmarks.dynamics.stepping import Timed, beginning

EXPLICIT = tuple(CRITICAL_OMEGA_DT)
"""The schemes that have a limit."""
LIMITS = ("what", "value", "unit", "omega [rad/s]", "rate [1/s]", *(f"{name} [s]" for name in EXPLICIT))
SUCTION = ("scheme", "title", "step [s]", "steps", "most elements damped", "damped at the time", "time [s]", "element",
           "slope [N s/m2]", "rate [1/s]", "limit [s]", "largest growth", "growth", "growth of the line")  # fmt: skip
WATCHED = (("velocity-verlet", 8), ("central-difference", 8))
"""Runs in which the damping is followed: the scheme, and its steps between two moments."""


def line_limit(scheme: str, frequencies: FloatArray, damping: float = DAMPING) -> float:
    """The largest step of a scheme on a line with these frequencies (k,), damped by a share of its stiffness (s)."""
    return min(critical_step(scheme, omega, damping * omega**2) for omega in frequencies.tolist())


def frequencies(beam: Beam, part: slice) -> FloatArray:
    """The circular frequencies (k,) of some displacements of a line that nothing holds, from the lowest, rad/s."""
    root = np.sqrt(beam.mass)
    squares = (beam.stiffness / root[:, None] / root)[part, part]
    found: FloatArray = np.sqrt(np.maximum(np.linalg.eigvalsh(squares), 0.0))
    return found


def limits() -> Iterator[tuple[Cell, ...]]:
    """The rows of `LIMITS`: of the line with its own damping, and of the largest stiffness and damping of each law.

    What acts on a node acts on those at the ends too, which have half the mass of the others.
    """
    beam = read_beam(DECK)
    for what, part in (("EA of the line", slice(beam.nodes, None)), ("EI of the line", slice(beam.nodes))):
        omegas = frequencies(beam, part)
        fastest = float(omegas[-1])
        steps = (line_limit(scheme, omegas) for scheme in EXPLICIT)
        yield what, None, "", fastest, DAMPING * fastest**2, *steps
    length = float(beam.contact.input.length[0])
    mass = float(beam.mass[1]) / length
    for law in beam.contact.stiffest().laws:
        over = float(beam.mass.min()) if law.per == "node" else mass
        stiffness, damping = float(np.nanmax(law.stiffness)), float(np.nanmax(law.damping))
        omega, rate = float(np.sqrt(stiffness / over)), damping / over
        unit = "N/m" if law.per == "node" else "N/m2"
        yield f"{law.law}, stiffness", stiffness, unit, omega, None, *(critical_step(name, omega) for name in EXPLICIT)
        if damping:
            steps = (critical_step(name, 0.0, rate) for name in EXPLICIT)
            yield f"{law.law}, damping", damping, unit.replace("N", "N s"), None, rate, *steps


# ------------------------------------------------------------------------------------------------------ within a run


@dataclass(slots=True)
class Watched:
    """The line as a `System`; keeps what it was asked last."""

    line: Timed
    position: FloatArray = field(default_factory=lambda: np.zeros(0))
    velocity: FloatArray = field(default_factory=lambda: np.zeros(0))
    history: History = None

    @property
    def mass(self) -> FloatArray:
        """That of the line."""
        return self.line.mass

    def forces(self, position: FloatArray, velocity: FloatArray, history: History) -> Forces:
        """Those of the line."""
        self.position, self.velocity, self.history = position, velocity, history
        return self.line.forces(position, velocity, history)


@dataclass(frozen=True, slots=True, eq=False)
class Tangent:
    """The line as it is at one moment of a run.

    Attributes:
        slopes: (m,) what suction of each element does against the velocity, N s/m2.
        rate: the largest rate 1/s at which suction alone would slow down a motion of the line.
        stiffness, damping: (2 n, 2 n) derivatives of all forces by displacements and rates, over the masses.
    """

    slopes: FloatArray
    rate: float
    stiffness: FloatArray
    damping: FloatArray

    @property
    def damped(self) -> int:
        """How many elements suction damps."""
        return int((self.slopes > 0.0).sum())

    @classmethod
    def at(cls, lifting: Lifting, seen: Watched) -> Tangent:
        """At the positions and velocities that the forces of the last step saw."""
        beam = lifting.beam
        by_position, by_velocity = lifting.tangent(seen.position[:-1], seen.velocity[:-1], seen.history)
        places, rates = beam.positions(seen.position[:-1]), beam.velocities(seen.velocity[:-1])
        contact = -beam.contact.tangent(places, rates, seen.history).by_velocity.dense()[::3, ::3]
        root = np.sqrt(beam.mass[: beam.nodes])
        rate = float(np.linalg.eigvalsh(contact / root[:, None] / root)[-1])
        slopes = 4.0 * np.diag(contact, 1) / beam.contact.input.length[0]
        return cls(slopes, rate, by_position / beam.mass[:, None], by_velocity / beam.mass[:, None])

    def growth(self, dt: float, ahead: float) -> tuple[float, float]:
        """The largest factor of a motion in a step of `KickDrift`, and in this time by the equation itself."""
        size = len(self.stiffness)
        one, zero = np.eye(size), np.zeros((size, size))
        equation = np.block([[zero, one], [self.stiffness, self.damping]])
        factors = np.linalg.eigvals(amplification(self.stiffness, self.damping, dt, ahead))
        return float(np.abs(factors).max()), float(np.exp(dt * np.linalg.eigvals(equation).real.max()))


def amplification(stiffness: FloatArray, damping: FloatArray, dt: float, ahead: float) -> FloatArray:
    """The matrix (3 k, 3 k) of a step of `KickDrift` on a = stiffness x + damping v: of positions, velocities and a."""
    size = len(stiffness)
    one, zero = np.eye(size), np.zeros((size, size))
    kicked = np.hstack([zero, one, 0.5 * dt * one])
    position = np.hstack([one, zero, zero]) + dt * kicked
    acceleration = stiffness @ position + damping @ (kicked + ahead * dt * np.hstack([zero, zero, one]))
    return np.vstack([position, kicked + 0.5 * dt * acceleration, acceleration])


def follow(name: str, steps: int, end: float = float(TIMES[-1])) -> Iterator[tuple[Lifting, Watched]]:
    """The line after each step of a run of `KickDrift` up to `end` (s), with what the forces of the step saw."""
    system = lifting()
    seen, dt = Watched(Timed(system)), EVERY / steps
    motion = beginning(seen, system)
    for _ in range(round(end / dt)):
        motion = SCHEMES[name].step(seen, motion, dt).motion
        yield system, seen


def suction(name: str, steps: int) -> tuple[Cell, ...]:
    """A row of `SUCTION`: the damping that suction has in a run of a scheme."""
    scheme, dt = SCHEMES[name], EVERY / steps
    if not isinstance(scheme, KickDrift):
        raise TypeError(f"{name} is not a KickDrift scheme")
    rows: list[tuple[float, Tangent]] = []
    growths: list[tuple[float, float]] = []
    for system, seen in follow(name, steps):
        rows.append((float(seen.position[-1]), Tangent.at(system, seen)))
        growths.append(rows[-1][1].growth(dt, scheme.ahead))
    time, worst = max(rows, key=lambda row: row[1].rate)
    element = int(np.argmax(worst.slopes))
    growth = max(growths, key=lambda pair: pair[0] - max(pair[1], 1.0))
    limit = critical_step(name, 0.0, worst.rate)
    damped = (max(tangent.damped for _, tangent in rows), worst.damped)
    steepest = (element + 1, float(worst.slopes[element]), worst.rate, limit)
    return name, scheme.title, dt, len(rows), *damped, time, *steepest, max(growths)[0], *growth
