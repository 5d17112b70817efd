"""What the schemes integrate: m a = f(x, v), with a force that may remember."""

from __future__ import annotations

from typing import Any, NamedTuple, Protocol

from mudline.contact.arrays import FloatArray, IndexArray

History = Any
"""What a system remembers between steps; only the system itself looks at it."""


class Forces(NamedTuple):
    """Forces f of k systems, arrays (k,), their consistent tangents, and the history behind this moment.

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
    """Where k systems are: arrays (k,), and what they remember.

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
        """At rest or not: the acceleration is that of the forces at this moment."""
        forces = system.forces(position, velocity, history)
        return cls(position, velocity, forces.force / system.mass, forces.force, forces.history)


class Step(NamedTuple):
    """One step made.

    motion: behind the step.
    evaluations: how often the forces were evaluated.
    iterations: (k,) Newton iterations; 0 for explicit schemes.
    residual: (k,) what was left of the balance of forces; 0 for explicit schemes, and where it converged.
    """

    motion: Motion
    evaluations: int
    iterations: IndexArray
    residual: FloatArray


class Scheme(Protocol):
    """A way to step."""

    @property
    def name(self) -> str:
        """A word for tables, "central-difference"."""
        ...

    @property
    def title(self) -> str:
        """What people call it."""
        ...

    @property
    def limit(self) -> float:
        """Largest omega dt at which an undamped oscillator does not grow; inf for implicit schemes.

        That says nothing of contact that opens and closes.
        """
        ...

    @property
    def explicit(self) -> bool:
        """Whether it takes no Newton iterations."""
        ...

    def step(self, system: System, motion: Motion, dt: float | FloatArray) -> Step:
        """Go on by dt, one number or one for each system (k,)."""
        ...
