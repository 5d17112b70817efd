"""A mass dragged along the seabed: it comes with some speed, slides against Coulomb friction, and returns.

Below the limit mu N friction is a spring Kt. With omega = sqrt(Kt / m) and the threshold displacement Th = mu N / Kt:
it sticks up to Th, where the speed is v1 = sqrt(v^2 - omega^2 Th^2); slips v1^2 m / (2 mu N) farther; and oscillates
about Th before its last place, with the speed omega Th.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.contact.laws.friction import FrictionHistory, FrictionLaw, slide
from mudline.study.motion import Forces, History, Motion, Trajectory
from mudline.study.precision.integration import RUNS, Case, Start, uneven

_SPEED = 3.0
"""Of omega Th: most of the displacement is slip."""


@dataclass(frozen=True, slots=True)
class Drag:
    """A mass per unit length, its friction limit mu N, and the stiffness Kt of the friction spring."""

    name: str
    mass: float
    limit: float
    stiffness: float


class _Memory(NamedTuple):
    """What friction remembers, and the work done against slipping so far."""

    friction: FrictionHistory
    dissipated: FloatArray


@dataclass(frozen=True, slots=True)
class _Sliding:
    mass: FloatArray
    law: FrictionLaw
    limit: FloatArray

    def forces(self, position: FloatArray, velocity: FloatArray, history: History) -> Forces:
        points = np.zeros((len(position), 3))
        points[:, 1] = position
        along, across = np.zeros_like(points), np.zeros_like(points)
        along[:, 1], across[:, 2] = 1.0, 1.0
        found = slide(self.law, history.friction, points, (along, across), self.limit)
        memory = _Memory(found.history, history.dissipated + found.dissipated)
        return Forces(found.force[:, 0], found.by_position[:, 0, 0], np.zeros(velocity.shape), memory)


def drag_case(drag: Drag) -> Case:
    """The case of a drag."""
    omega, threshold = math.sqrt(drag.stiffness / drag.mass), drag.limit / drag.stiffness
    speed = _SPEED * omega * threshold
    slipping = math.sqrt(speed**2 - (omega * threshold) ** 2)
    travel = threshold + slipping**2 * drag.mass / (2.0 * drag.limit)
    sticks, slips = math.asin(1.0 / _SPEED) / omega, slipping * drag.mass / drag.limit
    ones = np.ones((RUNS, 2))
    law = FrictionLaw(ones, np.full((RUNS, 2), drag.stiffness), ones, np.zeros(RUNS, np.bool_), np.ones(RUNS, np.bool_))
    system = _Sliding(np.full(RUNS, drag.mass), law, np.full(RUNS, drag.limit))

    def start(dt: float) -> Start:
        memory = _Memory(FrictionHistory.initial(law.active), np.zeros(RUNS))
        motion = Motion.start(system, np.zeros(RUNS), np.full(RUNS, speed), memory)
        return Start(motion, uneven(dt))

    def errors(run: Trajectory) -> FloatArray:
        memory: _Memory = run.end.history
        stretch = run.end.position - memory.friction.stick_points[:, 1]
        back = np.sqrt(run.end.velocity**2 + (omega * stretch) ** 2)
        energy = 0.5 * drag.mass * back**2 + memory.dissipated
        found = np.array(
            [
                run.position.max(axis=0) / travel,
                back / (omega * threshold),
                energy / (0.5 * drag.mass * speed**2),
            ]
        )
        return np.abs(found - 1.0)

    return Case(
        name="drag",
        title=f"dragged on {drag.name}, friction",
        quantities=("maximum displacement", "return velocity", "energy"),
        reference="closed form",
        system=system,
        omega=omega,
        duration=sticks + slips + 0.5 * math.pi / omega,
        bound=1e3 * travel,
        start=start,
        errors=errors,
        missing="",
    )
