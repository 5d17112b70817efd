"""Time integration schemes: all coefficients in one table, and one class for each family.

Explicit:

* `KickDrift`: central difference, as explicit programs step it (velocities live at half steps): x(n+1) - 2 x(n) +
  x(n-1) = dt^2 a(n). A force that depends on the velocity sees that of the half step before, which costs one order of
  accuracy. Velocity Verlet has the same positions, but forces see a velocity predicted to the whole step; without
  velocity in the forces the two are one. Stable for omega dt < 2.
* `RungeKutta`: the classical scheme of fourth order, stable on an undamped oscillator for omega dt < 2 sqrt(2); the
  second order (midpoint), which grows there at any step, slowly at small ones; forward Euler, first order and unstable
  there at any step, here as a warning.

Implicit, `OneStep`:

* Newmark with beta = 1/4, gamma = 1/2: the average acceleration rule, second order, undamped;
* `hht`, of Hilber, Hughes and Taylor: second order, damps what is not resolved;
* `generalised_alpha`, of Chung and Hulbert: second order, with chosen damping of what is not resolved;
* backward Euler: first order, damps strongly, never gains energy in contact: v1 = v0 + dt a1, x1 = x0 + dt v1.

Implicit schemes solve k equations of one unknown side by side by Newton's method in a bracket.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from mudline.model.contact.arrays import FloatArray
from tests.benchmarks.studies.motion import Forces, Motion, Scheme, System
from tests.benchmarks.studies.newton import solve

Pair = tuple[float, float]
"""Shares of the old and of the new value."""


@dataclass(frozen=True, slots=True)
class KickDrift(Scheme):
    """Explicit schemes of second order that kick (velocity) and drift (position) in turn: one force a step.

    v* = v0 + dt/2 a0                             kick
    x1 = x0 + dt v*                               drift
    a1 = f(x1, v* + ahead dt a0) / m
    v1 = v* + dt/2 a1                             kick

    Attributes:
        ahead: share of the step by which the velocity that the force sees is ahead of the first kick.
    """

    ahead: float

    def step(self, system: System, motion: Motion, dt: float | FloatArray) -> Motion:
        """See `Scheme`."""
        kicked = motion.velocity + 0.5 * dt * motion.acceleration
        position = motion.position + dt * kicked
        forces = system.forces(position, kicked + self.ahead * dt * motion.acceleration, motion.history)
        acceleration = forces.force / system.mass
        velocity = kicked + 0.5 * dt * acceleration
        return Motion(position, velocity, acceleration, forces.force, forces.history)


@dataclass(frozen=True, slots=True)
class RungeKutta(Scheme):
    """Explicit schemes from their Butcher tables.

    Inside a step the force sees the history that the step began with; what a step leaves behind is that of its end.

    Attributes:
        stages: rows of the table below the first: the weights with which a stage takes the rates of those before it.
        weights: of the rates of all stages in the step.
    """

    stages: tuple[tuple[float, ...], ...]
    weights: tuple[float, ...]

    def step(self, system: System, motion: Motion, dt: float | FloatArray) -> Motion:
        """See `Scheme`. The acceleration of the step before is the rate of the first stage."""
        speeds, accelerations = [motion.velocity], [motion.acceleration]
        for row in self.stages:
            position = motion.position + dt * _mixed(row, speeds)
            speed = motion.velocity + dt * _mixed(row, accelerations)
            forces = system.forces(position, speed, motion.history)
            speeds.append(speed)
            accelerations.append(forces.force / system.mass)
        position = motion.position + dt * _mixed(self.weights, speeds)
        velocity = motion.velocity + dt * _mixed(self.weights, accelerations)
        end = system.forces(position, velocity, motion.history)
        return Motion(position, velocity, end.force / system.mass, end.force, end.history)


def _mixed(weights: tuple[float, ...], rates: list[FloatArray]) -> FloatArray:
    mixed = np.zeros(rates[0].shape)
    for weight, rate in zip(weights, rates, strict=True):
        if weight:
            mixed += weight * rate
    return mixed


@dataclass(frozen=True, slots=True)
class OneStep(Scheme):
    """Implicit linear one-step schemes, solved by Newton's method for the acceleration at the end of the step.

        x1 = x0 + dt v0 + dt^2 (p0 a0 + p1 a1)
        v1 = v0 + dt (q0 a0 + q1 a1)
        m (i0 a0 + i1 a1) = g1 f(x1, v1) + g0 f(x0, v0)

    The force is averaged, not evaluated at an averaged position: for contact that opens or closes within the step the
    two differ. The unknown is the acceleration: so the residual has no difference of positions over dt^2, which would
    be round-off at small steps.

    Attributes:
        position: p0, p1.
        velocity: q0, q1.
        inertia: i0, i1.
        load: g0, g1.
    """

    position: Pair
    velocity: Pair
    inertia: Pair = (0.0, 1.0)
    load: Pair = (0.0, 1.0)
    explicit: ClassVar[bool] = False

    def step(self, system: System, motion: Motion, dt: float | FloatArray) -> Motion:
        """See `Scheme`. Newton's method starts from the acceleration of the step before."""
        balance = _Balance(self, system, motion, dt)
        solution = solve(balance, motion.acceleration)
        forces = balance.forces
        force = np.where(solution.jumps, balance.balancing(solution.root), forces.force)
        return Motion(*balance.at(solution.root), solution.root, force, forces.history)


class _Balance:
    """The equation of motion at the end of a step as a function of the acceleration; keeps the last forces."""

    forces: Forces

    def __init__(self, scheme: OneStep, system: System, motion: Motion, dt: float | FloatArray) -> None:
        self._scheme, self._system, self._history = scheme, system, motion.history
        old, mass = motion.acceleration, system.mass
        self._position = motion.position + dt * motion.velocity + scheme.position[0] * dt * dt * old
        self._velocity = motion.velocity + scheme.velocity[0] * dt * old
        self._by_position, self._by_velocity = scheme.position[1] * dt * dt, scheme.velocity[1] * dt
        self._inertia = scheme.inertia[1] * mass
        self._known = scheme.inertia[0] * mass * old - scheme.load[0] * motion.force

    def at(self, new: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Position and velocity that go with an acceleration at the end."""
        return self._position + self._by_position * new, self._velocity + self._by_velocity * new

    def balancing(self, new: FloatArray) -> FloatArray:
        """The force at the end that an acceleration there needs: what a law that jumps there can give in between."""
        force: FloatArray = (self._inertia * new + self._known) / self._scheme.load[1]
        return force

    def __call__(self, new: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """See `Residual`."""
        self.forces = found = self._system.forces(*self.at(new), self._history)
        share = self._scheme.load[1]
        inertia, load = self._inertia * new, share * found.force
        tangent = found.by_position * self._by_position + found.by_velocity * self._by_velocity
        size = np.maximum(np.abs(inertia), np.maximum(np.abs(load), np.abs(self._known)))
        return inertia + self._known - load, self._inertia - share * tangent, size


def _newmark(name: str, title: str, beta: float, gamma: float) -> OneStep:
    """Newmark's scheme with these two parameters."""
    return OneStep(name, title, math.inf, position=(0.5 - beta, beta), velocity=(1.0 - gamma, gamma))


def hht(alpha: float) -> OneStep:
    """Hilber, Hughes and Taylor with -1/3 <= alpha <= 0; 0 is Newmark's.

    gamma = 1/2 - alpha, beta = (1 - alpha)^2 / 4; the force is (1 + alpha) f1 - alpha f0.
    """
    beta, gamma = (1.0 - alpha) ** 2 / 4.0, 0.5 - alpha
    return replace(_newmark(f"hht{alpha:g}", f"HHT ({alpha:g})", beta, gamma), load=(-alpha, 1.0 + alpha))


def generalised_alpha(rho: float) -> OneStep:
    """Chung and Hulbert with the spectral radius rho at infinite omega dt, 0 to 1; 1 does not damp.

    alpha_f = rho / (rho + 1), alpha_m = (2 rho - 1) / (rho + 1), gamma = 1/2 - alpha_m + alpha_f,
    beta = (1 - alpha_m + alpha_f)^2 / 4. The alphas are the shares of the old force and of the old acceleration.
    """
    of_force, of_mass = rho / (rho + 1.0), (2.0 * rho - 1.0) / (rho + 1.0)
    beta, gamma = (1.0 - of_mass + of_force) ** 2 / 4.0, 0.5 - of_mass + of_force
    scheme = _newmark(f"generalised-alpha-{rho:g}", f"generalised-alpha ({rho:g})", beta, gamma)
    return replace(scheme, inertia=(of_mass, 1.0 - of_mass), load=(of_force, 1.0 - of_force))


_SIXTH, _THIRD = 1.0 / 6.0, 1.0 / 3.0
_ALL: tuple[Scheme, ...] = (
    KickDrift("central-difference", "central difference", 2.0, ahead=0.0),
    KickDrift("velocity-verlet", "velocity Verlet", 2.0, ahead=0.5),
    RungeKutta("rk4", "RK4", math.sqrt(8.0), ((0.5,), (0.0, 0.5), (0.0, 0.0, 1.0)), (_SIXTH, _THIRD, _THIRD, _SIXTH)),
    _newmark("newmark", "Newmark", beta=0.25, gamma=0.5),
    hht(-0.3),
    generalised_alpha(1.0),
    generalised_alpha(0.5),
    generalised_alpha(0.0),
    OneStep("backward-euler", "backward Euler", math.inf, position=(0.0, 1.0), velocity=(0.0, 1.0)),
    RungeKutta("rk2", "RK2 (midpoint)", 0.0, ((0.5,),), (0.0, 1.0)),
    RungeKutta("forward-euler", "forward Euler", 0.0, (), (1.0,)),
)

SCHEMES: dict[str, Scheme] = {scheme.name: scheme for scheme in _ALL}
"""In the order in which tables show them; the last two are unstable on every undamped oscillator."""
