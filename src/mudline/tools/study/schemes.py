"""The three time integration schemes that are studied, on many masses of one degree of freedom side by side.

* Velocity Verlet, explicit, second order: central difference whose forces see a velocity predicted to the whole step.
  Stable on an undamped oscillator for omega dt < 2.
* RK4, explicit, the classical Runge-Kutta scheme of fourth order, stable there for omega dt < 2 sqrt(2).
* HHT (-0.3), implicit, of Hilber, Hughes and Taylor (1977): second order, damps what is not resolved, stable on linear
  systems at any step. Contact that opens and closes is not linear.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, Protocol

import numpy as np

from mudline.model.contact.arrays import BoolArray, FloatArray, IndexArray

PHASES: FloatArray = np.linspace(1.0, 511.0, 16) / 512.0
"""Shares of a step at which masses side by side touch the seabed; the worst counts, which is mostly near an end."""

MOST_STEPS = 5000
"""Of a motion: smaller steps are not tried. A law with a very narrow stiff part would ask for millions."""
_TOLERANCE = 1e-12
"""Of the largest term of the balance of forces: what is left of it when Newton's method has converged."""
_ITERATIONS = 120
_COLLAPSED = 4.0 * float(np.finfo(np.float64).eps)
"""Width of a bracket over its larger end at which it holds no other number: the force jumps there."""

History = Any
"""What the laws of a system remember between steps; only the system reads it."""


class Forces(NamedTuple):
    """Forces on k masses, arrays (k,), and their derivatives.

    force: in the direction of the position. by_position, by_velocity: its derivatives, negative for springs and
    dampers. history: what the next step begins with if this one ends here.
    """

    force: FloatArray
    by_position: FloatArray
    by_velocity: FloatArray
    history: History


class System(Protocol):
    """Equal masses side by side, each under forces that depend on its own motion."""

    @property
    def mass(self) -> float:
        """Of each of them, > 0."""
        ...

    def forces(self, position: FloatArray, velocity: FloatArray, history: History) -> Forces:
        """Return the forces at positions and velocities (k,) in a step that began with `history`."""
        ...


class Motion(NamedTuple):
    """Positions, velocities and accelerations of k masses, the forces on them, and what the laws remember."""

    position: FloatArray
    velocity: FloatArray
    acceleration: FloatArray
    force: FloatArray
    history: History


def started(system: System, position: FloatArray, velocity: FloatArray, history: History = None) -> Motion:
    """Return the start of a motion; its acceleration follows from the forces."""
    forces = system.forces(position, velocity, history)
    return Motion(position, velocity, forces.force / system.mass, forces.force, forces.history)


class Step(NamedTuple):
    """The motion after a step, and how often the force of each mass (k,) was needed."""

    motion: Motion
    evaluations: IndexArray


Stepper = Callable[[System, Motion, FloatArray], Step]
"""Make one step; each mass has its own dt (k,)."""


def velocity_verlet(system: System, motion: Motion, dt: FloatArray) -> Step:
    """Make a step of velocity Verlet: kick, drift, kick."""
    kicked = motion.velocity + 0.5 * dt * motion.acceleration
    position = motion.position + dt * kicked
    forces = system.forces(position, kicked + 0.5 * dt * motion.acceleration, motion.history)
    acceleration = forces.force / system.mass
    after = Motion(position, kicked + 0.5 * dt * acceleration, acceleration, forces.force, forces.history)
    return Step(after, np.ones(position.shape, np.intp))


def rk4(system: System, motion: Motion, dt: FloatArray) -> Step:
    """Make a step of RK4. All stages see what the laws remembered before the step."""
    speeds, accelerations = [motion.velocity], [motion.acceleration]
    for share in (0.5, 0.5, 1.0):
        position = motion.position + share * dt * speeds[-1]
        speed = motion.velocity + share * dt * accelerations[-1]
        accelerations.append(system.forces(position, speed, motion.history).force / system.mass)
        speeds.append(speed)
    position = motion.position + dt * _weighted(speeds)
    velocity = motion.velocity + dt * _weighted(accelerations)
    end = system.forces(position, velocity, motion.history)
    after = Motion(position, velocity, end.force / system.mass, end.force, end.history)
    return Step(after, np.full(position.shape, 4, np.intp))


def _weighted(rates: list[FloatArray]) -> FloatArray:
    first, second, third, fourth = rates
    return (first + 2.0 * (second + third) + fourth) / 6.0


_ALPHA = -0.3
_BETA, _GAMMA = (1.0 - _ALPHA) ** 2 / 4.0, 0.5 - _ALPHA


def hht(system: System, motion: Motion, dt: FloatArray) -> Step:
    """Make a step of HHT (-0.3), solved for the acceleration at its end.

    x1 = x0 + dt v0 + dt^2 ((1/2 - beta) a0 + beta a1)
    v1 = v0 + dt ((1 - gamma) a0 + gamma a1)
    m a1 = (1 + alpha) f(x1, v1) - alpha f(x0, v0)
    """
    position = motion.position + dt * motion.velocity + (0.5 - _BETA) * dt * dt * motion.acceleration
    velocity = motion.velocity + (1.0 - _GAMMA) * dt * motion.acceleration
    by_position, by_velocity = _BETA * dt * dt, _GAMMA * dt
    known, last = _ALPHA * motion.force, [Forces(motion.force, motion.force, motion.force, None)]

    def balance(new: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        last[0] = found = system.forces(position + by_position * new, velocity + by_velocity * new, motion.history)
        inertia, load = system.mass * new, (1.0 + _ALPHA) * found.force
        tangent = found.by_position * by_position + found.by_velocity * by_velocity
        size = np.maximum(np.abs(inertia), np.maximum(np.abs(load), np.abs(known)))
        return inertia + known - load, system.mass - (1.0 + _ALPHA) * tangent, size

    root, evaluations, jumps = solved(balance, motion.acceleration)
    # where the force jumps, it is what keeps the balance: a law that jumps can give all that lies between
    force = np.where(jumps, (system.mass * root + known) / (1.0 + _ALPHA), last[0].force)
    after = Motion(position + by_position * root, velocity + by_velocity * root, root, force, last[0].history)
    return Step(after, evaluations)


SCHEMES: dict[str, Stepper] = {"velocity Verlet": velocity_verlet, "HHT (-0.3)": hht, "RK4": rk4}
"""By the names in text and JSON."""
HHT = "HHT (-0.3)"
CRITICAL = {"velocity Verlet": "velocity-verlet", "RK4": "rk4"}
"""The explicit ones, with the names under which `mudline.model.contact.stiffest.critical_step` has their limit."""


Residual = Callable[[FloatArray], tuple[FloatArray, FloatArray, FloatArray]]
"""Residuals at unknowns (k,), their derivatives, and the largest term of each."""


def solved(residual: Residual, start: FloatArray) -> tuple[FloatArray, IndexArray, BoolArray]:
    """Solve k equations of one unknown by Newton's method in a bracket, with one correction at least.

    The bracket holds the two nearest points between which a residual changes its sign from negative to positive; its
    middle is taken where a correction leads out of it, so that no iterates alternate. Return the roots, how often each
    residual was needed, and where it jumps across 0 at the root.
    """
    root = start.copy()
    low, high = np.full(root.shape, -np.inf), np.full(root.shape, np.inf)
    evaluations = np.ones(root.shape, np.intp)
    value, slope, size = residual(root)
    for iteration in range(_ITERATIONS):
        low, high = np.where(value < 0.0, root, low), np.where(value > 0.0, root, high)
        width = _COLLAPSED * np.maximum(np.abs(low), np.abs(high))
        collapsed = np.isfinite(width) & (high - low <= width)
        converged = (np.abs(value) <= _TOLERANCE * size) & (iteration > 0)
        open_ = np.isfinite(value) & ~converged & ~collapsed
        if not open_.any():
            break
        change, middle = -value / slope, 0.5 * low + 0.5 * high
        inside = (root + change > low) & (root + change < high)
        toward = np.copysign(np.where(np.isfinite(change), change, 1.0 + np.abs(root)), -value)
        change = np.where(inside, change, np.where(np.isfinite(middle), middle - root, toward))
        root = np.where(open_, root + change, root)
        evaluations += open_
        value, slope, size = residual(root)
    return root, evaluations, collapsed & ~converged


def march(
    step: Stepper, system: System, motion: Motion, dt: FloatArray, observe: Callable[[int, Motion], bool]
) -> FloatArray:
    """Step k masses, each with its own dt (k,), until `observe(number of the step, motion)` has seen enough.

    Return the mean number of force evaluations that a step of each took (k,).
    """
    evaluations, number = np.zeros(dt.shape), 0
    with np.errstate(all="ignore"):
        while True:
            motion, needed = step(system, motion, dt)
            evaluations += needed
            number += 1
            if observe(number, motion):
                return evaluations / number
