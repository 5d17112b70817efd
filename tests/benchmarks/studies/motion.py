"""The equation m a = f(x, v) that the schemes integrate, with a force that may have a history.

k systems of one degree of freedom are stepped side by side, so that an ensemble costs little more than one run.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, ClassVar, NamedTuple, Protocol

import numpy as np

from mudline.model.contact.arrays import FloatArray

History = Any
"""The state of a system between steps; only the system itself reads it."""


class Forces(NamedTuple):
    """Forces f of k systems, arrays (k,), their consistent tangents, and the history after this moment.

    force: in the direction of the position.
    by_position: d f / d x, negative for a spring.
    by_velocity: d f / d v, negative for a damper.
    history: what the next step begins with if the step ends here.
    """

    force: FloatArray
    by_position: FloatArray
    by_velocity: FloatArray
    history: History


class System(Protocol):
    """k systems of one degree of freedom, side by side."""

    @property
    def mass(self) -> FloatArray:
        """Masses (k,), > 0."""
        ...

    def forces(self, position: FloatArray, velocity: FloatArray, history: History) -> Forces:
        """Forces at positions and velocities (k,) in a step that began with `history`."""
        ...


class Motion(NamedTuple):
    """Positions and velocities of k systems, arrays (k,), and their history.

    acceleration: as the scheme carries it along; only for some schemes it is force over mass.
    force: at this moment.
    """

    position: FloatArray
    velocity: FloatArray
    acceleration: FloatArray
    force: FloatArray
    history: History

    @classmethod
    def start(cls, system: System, position: FloatArray, velocity: FloatArray, history: History = None) -> Motion:
        """The start of a run; the acceleration follows from the forces."""
        forces = system.forces(position, velocity, history)
        return cls(position, velocity, forces.force / system.mass, forces.force, forces.history)


@dataclass(frozen=True, slots=True)
class Scheme(ABC):
    """A time integration scheme.

    Attributes:
        name: identifier in tables, "central-difference".
        title: its usual name.
        explicit: whether it takes no Newton iterations.
        limit: largest omega dt at which an undamped oscillator does not grow, 0 where it grows at every step; inf for
            implicit schemes, which says nothing about contact that opens and closes.
    """

    name: str
    title: str
    limit: float
    explicit: ClassVar[bool] = True

    @abstractmethod
    def step(self, system: System, motion: Motion, dt: float | FloatArray) -> Motion:
        """Go on by dt, one number or one for each system (k,); NaN where Newton's method does not converge."""


def march(scheme: Scheme, system: System, motion: Motion, dt: float | FloatArray, steps: int) -> Motion:
    """The motion behind so many steps; NaN where one of them failed."""
    with np.errstate(all="ignore"):
        for _ in range(steps):
            motion = scheme.step(system, motion, dt)
    return motion
