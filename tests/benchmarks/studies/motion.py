"""The equation m a = f(x, v) that the schemes integrate, with a force that may have a history, and runs of many steps.

k systems of one degree of freedom are stepped side by side, so that an ensemble costs little more than one run.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from time import thread_time
from typing import Any, ClassVar, NamedTuple, Protocol

import numpy as np

from mudline.model.contact.arrays import BoolArray, FloatArray, IndexArray
from tests.benchmarks.studies.limits import CRITICAL_OMEGA_DT

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


class Step(NamedTuple):
    """One step made.

    motion: after the step.
    evaluations: (k,) how often the force of each was needed, as many as in a run of its own.
    residual: (k,) what was left of the balance of forces; 0 for explicit schemes, and where it converged.
    """

    motion: Motion
    evaluations: IndexArray
    residual: FloatArray


@dataclass(frozen=True, slots=True)
class Scheme(ABC):
    """A time integration scheme.

    Attributes:
        name: identifier in tables, "central-difference".
        title: its usual name.
        explicit: whether it takes no Newton iterations.
    """

    name: str
    title: str
    explicit: ClassVar[bool] = True

    @property
    def limit(self) -> float:
        """Largest omega dt at which an undamped oscillator does not grow; inf for implicit schemes.

        It says nothing about contact that opens and closes.
        """
        return CRITICAL_OMEGA_DT.get(self.name, np.inf)

    @abstractmethod
    def step(self, system: System, motion: Motion, dt: float | FloatArray) -> Step:
        """Go on by dt, one number or one for each system (k,)."""


@dataclass(frozen=True, slots=True, eq=False)
class Trajectory:
    """The motion of k systems at n + 1 moments.

    Attributes:
        position, velocity: (n + 1, k); as they were where a run has failed.
        failed: (k,) runs that ended early.
        evaluations: (k,) of the forces, without the one of the start.
        seconds: processor time of all steps together.
        end: where the runs ended.
    """

    position: FloatArray
    velocity: FloatArray
    failed: BoolArray
    evaluations: IndexArray
    seconds: float
    end: Motion


def march(
    scheme: Scheme, system: System, start: Motion, dt: float | FloatArray, steps: int, bound: float = np.inf
) -> Trajectory:
    """Make `steps` steps of dt (one number, or one for each run).

    A run has failed where Newton's method did not converge or a position is not finite or beyond +-`bound`; it is kept
    at rest from then on.
    """
    shape = (steps + 1, *start.position.shape)
    position, velocity = np.empty(shape), np.empty(shape)
    position[0], velocity[0] = start.position, start.velocity
    motion, evaluations = start, np.zeros(shape[1], np.intp)
    sound: BoolArray = np.ones(shape[1], np.bool_)
    began = thread_time()
    with np.errstate(all="ignore"):
        for index in range(steps):
            step = scheme.step(system, motion, dt)
            evaluations += step.evaluations
            motion = step.motion
            sound &= (step.residual == 0.0) & (np.abs(motion.position) <= bound) & np.isfinite(motion.velocity)
            if not sound.all():
                motion = motion._replace(
                    position=np.where(sound, motion.position, position[index]),
                    velocity=np.where(sound, motion.velocity, 0.0),
                    acceleration=np.where(sound, motion.acceleration, 0.0),
                )
            position[index + 1], velocity[index + 1] = motion.position, motion.velocity
            if not sound.any():
                position[index + 2 :], velocity[index + 2 :] = motion.position, motion.velocity
                break
    return Trajectory(position, velocity, ~sound, evaluations, thread_time() - began, motion)
