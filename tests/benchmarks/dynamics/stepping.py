"""The schemes of the studies on the whole line, step by step, with what they cost.

Explicit schemes step many degrees of freedom as they step many masses. An implicit step is one system of equations, and
is solved here: with the coefficients of the scheme, by Newton's method with the evaluator's consistent tangent and
corrections that are halved until the residual falls. What a scheme knows of time it gets from one more degree of
freedom, which no force acts on and which moves by 1 in a second.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mudline.model.contact.arrays import FloatArray
from tests.benchmarks.dynamics.lifting import Lifting
from tests.benchmarks.dynamics.reference import Path
from tests.benchmarks.studies.motion import Forces, History, Motion, Scheme, System
from tests.benchmarks.studies.schemes import OneStep

_NEWTON = 1e-9
"""Of the largest force in the balance: a residual below that has converged."""
_MOST = 40
_HALVINGS = 12
_BOUND = 100.0
"""Metres: what has moved farther has diverged."""


class DivergedError(ArithmeticError):
    """The run cannot go on; the message says when and why."""


@dataclass(slots=True)
class Timed:
    """The line as a `System` whose last degree of freedom is the time."""

    lifting: Lifting
    evaluations: int = 0
    tangents: int = 0

    @property
    def mass(self) -> FloatArray:
        """Those of the line, and 1 for the time."""
        return np.append(self.lifting.beam.mass, 1.0)

    def forces(self, position: FloatArray, velocity: FloatArray, history: History) -> Forces:
        """See `System`; without derivatives, which explicit schemes do not look at."""
        if not (np.isfinite(velocity).all() and np.abs(position).max() < _BOUND):
            raise DivergedError("the motion grew without bound")
        self.evaluations += 1
        found = self.lifting.forces(position[-1], position[:-1], velocity[:-1], history)
        return Forces(np.append(found.total, 0.0), position, velocity, found.state)

    def tangent(self, position: FloatArray, velocity: FloatArray, history: History) -> tuple[FloatArray, FloatArray]:
        """Derivatives of the forces by positions and velocities, square."""
        self.tangents += 1
        parts = self.lifting.tangent(position[:-1], velocity[:-1], history)
        by_position, by_velocity = (np.pad(part, ((0, 1), (0, 1))) for part in parts)
        place = np.array(self.lifting.held)
        by_position[place, -1] = self.lifting.hoist.stiffness * self.lifting.hoist.speed(position[-1])
        return by_position, by_velocity


def implicit_step(scheme: OneStep, system: Timed, motion: Motion, dt: float) -> tuple[Motion, int]:
    """The motion after a step, and its Newton iterations.

    Raises DivergedError where they do not converge.
    """
    (p0, p1), (q0, q1), (i0, i1), (g0, g1) = scheme.position, scheme.velocity, scheme.inertia, scheme.load
    mass, old = system.mass, motion.acceleration
    position = motion.position + dt * motion.velocity + p0 * dt * dt * old
    velocity = motion.velocity + q0 * dt * old
    known = i0 * mass * old - g0 * motion.force

    def at(new: FloatArray) -> tuple[FloatArray, FloatArray]:
        return position + p1 * dt * dt * new, velocity + q1 * dt * new

    def residual(new: FloatArray) -> tuple[FloatArray, Forces]:
        found = system.forces(*at(new), motion.history)
        return i1 * mass * new + known - g1 * found.force, found

    new = old
    left, found = residual(new)
    enough = _NEWTON * max(1.0, float(np.abs(motion.force).max()))
    for iteration in range(_MOST):
        if iteration and float(np.abs(left).max()) <= enough:
            return Motion(*at(new), new, found.force, found.history), iteration
        by_position, by_velocity = system.tangent(*at(new), motion.history)
        change = np.linalg.solve(i1 * np.diag(mass) - g1 * (p1 * dt * dt * by_position + q1 * dt * by_velocity), left)
        share, size = 1.0, float(np.linalg.norm(left))
        for _ in range(_HALVINGS):
            tried, seen = residual(new - share * change)
            if float(np.linalg.norm(tried)) < size or float(np.abs(tried).max()) <= enough:
                break
            share *= 0.5
        new, left, found = new - share * change, tried, seen
    raise DivergedError(f"Newton's method left {float(np.abs(left).max()):.2g} N after {_MOST} iterations")


@dataclass(slots=True)
class Run:
    """A run of a scheme.

    Attributes:
        path: at the wanted moments, up to where it ended.
        evaluations, tangents: of the forces and of their derivatives.
        iterations: the most of a step.
        failure: when and why it ended early; empty if it did not.
    """

    path: Path
    evaluations: int
    tangents: int
    iterations: int
    failure: str


def beginning(system: System, lifting: Lifting) -> Motion:
    """The line at rest at the time 0."""
    rest = np.zeros(2 * lifting.beam.nodes + 1)
    return Motion.start(system, rest, np.append(rest[:-1], 1.0), lifting.beam.contact.initial_state())


def run(scheme: Scheme, lifting: Lifting, times: FloatArray, steps: int) -> Run:
    """Step through the equally spaced `times` (s,), from rest, with so many steps between two of them."""
    system = Timed(lifting)
    dt = float(times[1] - times[0]) / steps
    path = Path.blank(len(times), lifting.beam.nodes)
    motion = beginning(system, lifting)
    works, most, failure = np.zeros(3), 0, ""
    before = _record(path, 0, lifting, motion, works)
    for row in range(1, len(times)):
        try:
            for _ in range(steps):
                if isinstance(scheme, OneStep):
                    motion, iterations = implicit_step(scheme, system, motion, dt)
                    most = max(most, iterations)
                else:
                    motion = scheme.step(system, motion, dt)
                now = _powers(lifting, motion)
                works = works + _work(before, now)
                before = now
        except DivergedError as error:
            failure = f"{motion.position[-1]:.2f} s: {error}"
            break
        _record(path, row, lifting, motion, works)
    return Run(path, system.evaluations, system.tangents, most, failure)


Powers = tuple[FloatArray, FloatArray, FloatArray]
"""Places of the hoist and of all nodes; forces of the hoist and of the seabed on them; and of the damping."""


def _powers(lifting: Lifting, motion: Motion) -> Powers:
    """What the work of a step is taken from. The seabed's force is what the total leaves: no evaluation is spent."""
    place, values, rates = lifting.hoist.place(motion.position[-1]), motion.position[:-1], motion.velocity[:-1]
    beam, held = lifting.beam, lifting.held
    hoist = lifting.hoist.stiffness * (place - values[held])
    damping = -lifting.damping * (beam.stiffness @ rates)
    contact = motion.force[:-1] - beam.weight - damping + beam.stiffness @ values
    contact[held] -= hoist
    return np.concatenate([place, values]), np.concatenate([hoist, contact]), damping


def _work(before: Powers, now: Powers) -> FloatArray:
    """Of hoist, seabed and damping over a step, by the mean of the forces at its ends."""
    travel = now[0] - before[0]
    mean, damping = 0.5 * (before[1] + now[1]), 0.5 * (before[2] + now[2])
    return np.array([mean[:2] @ travel[:2], mean[2:] @ travel[2:], damping @ travel[2:]])


def _record(path: Path, row: int, lifting: Lifting, motion: Motion, works: FloatArray) -> Powers:
    powers = _powers(lifting, motion)
    path.displacements[row], path.rates[row] = motion.position[:-1], motion.velocity[:-1]
    path.works[row], path.hoist[row] = works, powers[1][:2]
    path.gaps[row] = lifting.beam.positions(motion.position[:-1])[:, 0]
    return powers
