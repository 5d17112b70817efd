"""Stepping to the end, with everything that happened on the way, and why a run failed if it did."""

from __future__ import annotations

from dataclasses import dataclass
from time import perf_counter

import numpy as np

from mudline.contact.arrays import BoolArray, FloatArray, IndexArray
from mudline.study.schemes.system import Motion, Scheme, System


@dataclass(frozen=True, slots=True, eq=False)
class Trajectory:
    """What k systems did at n + 1 moments.

    Attributes:
        time: (n + 1, k) seconds.
        position: (n + 1, k); as it was where a run has failed, like the velocity.
        velocity: (n + 1, k).
        iterations: (n, k) Newton iterations.
        failures: why a run ended early, by its index.
        evaluations: of the forces.
        seconds: run time of all steps together.
        end: where the runs ended.
    """

    time: FloatArray
    position: FloatArray
    velocity: FloatArray
    iterations: IndexArray
    failures: dict[int, str]
    evaluations: int
    seconds: float
    end: Motion


def march(
    scheme: Scheme, system: System, start: Motion, dt: float | FloatArray, steps: int, bound: float = np.inf
) -> Trajectory:
    """Make so many steps of dt (one number, or one for each run).

    A run has failed where Newton's method did not converge or a position is not finite or beyond +-`bound`: then it
    stands still.
    """
    shape = (steps + 1, *start.position.shape)
    position, velocity = np.empty(shape), np.empty(shape)
    iterations = np.zeros((steps, *start.position.shape), np.intp)
    position[0], velocity[0] = start.position, start.velocity
    motion, evaluations, failures = start, 0, dict[int, str]()
    sound: BoolArray = np.ones(start.position.shape, np.bool_)
    began = perf_counter()
    with np.errstate(all="ignore"):
        for index in range(steps):
            step = scheme.step(system, motion, dt)
            evaluations += step.evaluations
            motion, iterations[index] = step.motion, step.iterations
            good = (step.residual == 0.0) & (np.abs(motion.position) <= bound) & np.isfinite(motion.velocity)
            if not good.all():
                for run in np.flatnonzero(sound & ~good).tolist():
                    failures[run] = _why(index + 1, int(step.iterations[run]), float(step.residual[run]))
                sound = sound & good
                motion = _held(motion, position[index], sound)
            position[index + 1], velocity[index + 1] = motion.position, motion.velocity
            if not sound.any():
                position[index + 2 :], velocity[index + 2 :] = motion.position, motion.velocity
                break
    seconds = perf_counter() - began
    time: FloatArray = np.arange(steps + 1.0)[:, None] * (dt * np.ones(start.position.shape))
    return Trajectory(time, position, velocity, iterations, failures, evaluations, seconds, motion)


def _held(motion: Motion, before: FloatArray, sound: BoolArray) -> Motion:
    """The runs that failed stand where they were."""
    return Motion(
        np.where(sound, motion.position, before),
        np.where(sound, motion.velocity, 0.0),
        np.where(sound, motion.acceleration, 0.0),
        motion.force,
        motion.history,
    )


def _why(step: int, iterations: int, residual: float) -> str:
    if residual > 0.0:
        return f"step {step}: Newton's method left a residual of {residual:.3g} after {iterations} iterations"
    return f"step {step}: the motion grew without bound"
