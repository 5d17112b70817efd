"""Tensioned beam on the seabed of a deck: the touchdown zone in its plane, at rest and in motion.

Small slopes, constant tension T, heights w and rotations theta of the nodes. Hermite elements with consistent mass,
load -q, drag at nodes. The left end lies on the seabed. The right end is moved, rotates freely, and has the catenary's
moment EI q / T.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from mudline.model.contact.arrays import FloatArray
from mudline.model.scene.load_case import Scheme
from mudline.tools.touchdown_study.soil import BeamSoil, Reaction

_ITERATIONS, _CUTS, _STATIC_ITERATIONS = 25, 6, 200
_LEAST_SHARE = 0.001
"""Smallest share of a correction that is tried if the residual does not fall."""
_REFINED, _REFINEMENTS = 1e-7, 6
"""Residual share of a force at which a linear system counts as solved, and refinements before elimination."""
_ENOUGH, _A_STEP = 500, 40
"""Evaluations of the equations after which a run is given up: initially, and for each step."""
_TOLERANCE = 1e-6
"""Residual of a node over the weight of the shortest element."""


class NotConvergedError(Exception):
    """Failure to find a step, or the state at rest."""


@dataclass(frozen=True)
class Beam:
    """The touchdown zone.

    Attributes:
        lengths: lengths (m,) of the elements, from the lying end to the hanging end.
        bending: EI.
        tension: T.
        weight, mass: per length.
        drag: force per length at a velocity of 1.
        left, right: heights of the ends above the mudline at rest.
        end_moment: moment at the right end.
        amplitude, period: motion of the right end.
        weights: per length (m,) of the elements, where they differ; `weight` is then that at the touchdown.
    """

    lengths: FloatArray
    bending: float
    tension: float
    weight: float
    mass: float
    drag: float
    left: float
    right: float
    end_moment: float
    amplitude: float = 0.0
    period: float = 1.0
    weights: FloatArray | None = None

    @cached_property
    def places(self) -> FloatArray:
        """Places (n,) of the nodes along the line, from the left end."""
        return np.append(0.0, np.cumsum(self.lengths))

    @cached_property
    def shortest(self) -> float:
        """Length of the shortest element."""
        return float(self.lengths.min())

    def largest(self, residual: FloatArray) -> float:
        """Return the largest free force of a residual (2 n,); moments are divided by the shortest length."""
        return float(max(np.abs(residual[2:-2:2]).max(), np.abs(residual[3::2]).max() / self.shortest))

    @cached_property
    def stiffness(self) -> FloatArray:
        """Matrix of bending and tension."""
        size = self.lengths[:, None, None]
        bend = np.array([[12.0, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]]) * self.bending / size**3
        pull = np.array([[36.0, 3, -36, 3], [3, 4, -3, -1], [-36, -3, 36, -3], [3, -1, -3, 4]])
        return _assembled(self._turned(bend + pull * self.tension / (30.0 * size)))

    @cached_property
    def inertia(self) -> FloatArray:
        """Consistent mass matrix."""
        rows = [[156.0, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]]
        return _assembled(self._turned(np.array(rows) * self.mass * self.lengths[:, None, None] / 420.0))

    def _turned(self, matrices: FloatArray) -> FloatArray:
        """Return matrices for w and theta from those for w and l theta."""
        size = np.ones((len(self.lengths), 4))
        size[:, 1::2] = self.lengths[:, None]
        return matrices * size[:, :, None] * size[:, None, :]

    @cached_property
    def load(self) -> FloatArray:
        """Load (2 n,) of the weight, with the moment at the right end."""
        weight = self.weight if self.weights is None else self.weights
        force, moment = -0.5 * weight * self.lengths, -weight * self.lengths**2 / 12.0
        load = np.zeros((len(self.lengths) + 1, 2))
        load[:-1] += np.column_stack([force, moment])
        load[1:] += np.column_stack([force, -moment])
        load[-1, 1] += self.end_moment
        return load.ravel()

    @cached_property
    def drag_at_nodes(self) -> FloatArray:
        """Drag (n,) of half of the elements of each node, at a velocity of 1."""
        drag: FloatArray = 0.5 * self.drag * (np.append(self.lengths, 0.0) + np.append(0.0, self.lengths))
        return drag

    def end(self, time: float) -> tuple[float, float, float]:
        """Return height, velocity and acceleration of the right end; the motion grows over the first period."""
        share = min(time / self.period, 1.0)
        ramp = share**3 * (10.0 + share * (6.0 * share - 15.0))
        rising = 30.0 * share**2 * (1.0 - share) ** 2 / self.period if share < 1.0 else 0.0
        bent = 60.0 * share * (1.0 - share) * (1.0 - 2.0 * share) / self.period**2 if share < 1.0 else 0.0
        omega = 2.0 * np.pi / self.period
        sine, cosine = np.sin(omega * time), np.cos(omega * time)
        return (
            self.right + self.amplitude * ramp * sine,
            self.amplitude * (rising * sine + ramp * omega * cosine),
            self.amplitude * (bent * sine + 2.0 * rising * omega * cosine - ramp * omega**2 * sine),
        )

    def moments(self, turned: FloatArray) -> FloatArray:
        """Return bending moments (..., m) of the elements from the rotations (..., n) of the nodes."""
        return self.bending * np.diff(turned, axis=-1) / self.lengths

    def touchdown(self, heights: FloatArray) -> FloatArray:
        """Return touchdown points (...), from the left end: the first change of sign of w (..., n) from the right."""
        above = heights >= 0.0
        last = above.shape[-1] - 1 - np.argmax(~above[..., ::-1], axis=-1)  # the last node below the mudline
        last = np.minimum(last, above.shape[-1] - 2)
        low = np.take_along_axis(heights, last[..., None], -1)[..., 0]
        high = np.take_along_axis(heights, last[..., None] + 1, -1)[..., 0]
        touchdown = self.places[last] + self.lengths[last] * low / np.where(low < high, low - high, -1.0)
        return np.where(above.all(axis=-1), np.nan, touchdown)


def _assembled(matrices: FloatArray) -> FloatArray:
    """Return the matrix (2 n, 2 n) assembled from element matrices (m, 4, 4)."""
    size = 2 * len(matrices) + 2
    matrix = np.zeros((size, size))
    for at, each in enumerate(matrices):
        matrix[2 * at : 2 * at + 4, 2 * at : 2 * at + 4] += each
    return matrix


class _Condensed:
    """Linear system for the changes of w and theta, with theta eliminated once."""

    def __init__(self, matrix: FloatArray) -> None:
        """Take a matrix (2 n, 2 n); w is held at both ends, theta at the left end."""
        w, turned = slice(2, -2, 2), slice(3, None, 2)
        self._inverse = np.linalg.inv(matrix[turned, turned])
        self._down = matrix[w, turned] @ self._inverse
        self._up = np.ascontiguousarray(self._down.T)
        self._whole = matrix[w, w] - matrix[w, turned] @ self._up
        self._first: tuple[FloatArray, FloatArray, FloatArray] | None = None

    def solve(self, residual: FloatArray, diagonal: FloatArray, beside: FloatArray) -> FloatArray:
        """Return the change (2 n,) that cancels a residual (2 n,), with a diagonal (n,) and its neighbours added."""
        force, moment = residual[2:-2:2], residual[3::2]
        change = np.zeros(len(residual))
        w = self._refined(self._down @ moment - force, diagonal[1:-1], beside[1:-1])
        change[2:-2:2] = w
        change[3::2] = -(self._inverse @ moment) - self._up @ w
        return change

    def _refined(self, force: FloatArray, diagonal: FloatArray, beside: FloatArray) -> FloatArray:
        """Return w (n - 2,) under a force, by the inverse of the first system and refinement, else by elimination."""
        if self._first is None:
            inverse = np.asarray(np.linalg.inv(self._added(diagonal, beside)), np.float64)
            self._first = diagonal.copy(), beside.copy(), inverse
        first_diagonal, first_beside, inverse = self._first
        more, more_beside = diagonal - first_diagonal, beside - first_beside
        solution, left = np.zeros(len(force)), force.copy()
        least = _REFINED * np.abs(force).max()
        for _ in range(_REFINEMENTS):
            part = inverse @ left
            solution += part
            np.multiply(-more, part, out=left)
            left[:-1] -= more_beside * part[1:]
            left[1:] -= more_beside * part[:-1]
            if np.abs(left).max() <= least:
                return solution
        return np.asarray(np.linalg.solve(self._added(diagonal, beside), force), np.float64)

    def _added(self, diagonal: FloatArray, beside: FloatArray) -> FloatArray:
        added: FloatArray = self._whole + np.diag(diagonal) + np.diag(beside, 1) + np.diag(beside, -1)
        return added


class _Equations(NamedTuple):
    """Equations of a trial state.

    Attributes:
        residual: residual (2 n,).
        diagonal: terms (n,) of soil and drag on the diagonal.
        beside: terms (n - 1,) next to the diagonal.
        reaction: seabed reaction.
    """

    residual: FloatArray
    diagonal: FloatArray
    beside: FloatArray
    reaction: Reaction


class Solved(NamedTuple):
    """Solution of a beam.

    Attributes:
        state: w and theta (2 n,) of its nodes.
        reaction: seabed reaction.
        iterations: systems solved.
        searches: halvings of corrections.
    """

    state: FloatArray
    reaction: Reaction
    iterations: int
    searches: int


def _solved(
    beam: Beam,
    system: _Condensed,
    state: FloatArray,
    equations: Callable[[FloatArray], _Equations],
    most: int,
) -> Solved:
    """Solve by Newton's method, halving a correction while the residual does not fall. Raises NotConvergedError."""
    tolerance = _TOLERANCE * beam.weight * beam.shortest
    now = equations(state)
    size, searches, stalls = beam.largest(now.residual), 0, 0
    for iteration in range(most + 1):
        if size <= tolerance:
            return Solved(state, now.reaction, iteration, searches)
        if iteration == most or not np.isfinite(size):
            break
        try:
            change = system.solve(now.residual, now.diagonal, now.beside)
        except np.linalg.LinAlgError as error:
            raise NotConvergedError("a tangent is singular") from error
        share, whole = 1.0, None
        while True:
            trial = equations(state + share * change)
            reached = beam.largest(trial.residual)
            whole = whole or (trial, reached)
            if reached < size:
                break
            # If no share lowers the residual, take the whole correction every second time: it may find at once the
            # elements that touch down and lift off, for which small corrections take long.
            if share < _LEAST_SHARE:
                stalls += 1
                if stalls % 2 == 0:
                    share, (trial, reached) = 1.0, whole
                break
            share *= 0.5
            searches += 1
        state, now, size = state + share * change, trial, reached
    raise NotConvergedError("no equilibrium was found")


def at_rest(beam: Beam, soil: BeamSoil) -> Solved:
    """Return the beam at rest, by Newton's method from a parabola that hangs beyond its touchdown.

    Raises NotConvergedError.
    """
    slope = beam.weight / beam.tension
    reach = np.sqrt(2.0 * max(beam.right, 0.0) / slope)
    hanging = np.maximum(beam.places - beam.places[-1] + reach, 0.0)
    w = np.where(hanging > 0.0, 0.5 * slope * hanging**2, beam.left)
    state = np.column_stack([w, slope * hanging]).ravel()
    state[0], state[1], state[-2] = beam.left, 0.0, beam.right
    still = np.zeros(len(w))

    def equations(trial: FloatArray) -> _Equations:
        reaction = soil.react(trial[::2], still, 0.0)
        residual = beam.stiffness @ trial - beam.load
        residual[::2] -= reaction.nodal
        return _Equations(residual, -reaction.diagonal, -reaction.beside, reaction)

    solved = _solved(beam, _Condensed(beam.stiffness), state, equations, _STATIC_ITERATIONS)
    soil.keep()
    return solved


class BeamRun(NamedTuple):
    """A run of equal steps, with its last period in arrays.

    Attributes:
        times: times (k,) of the last period.
        heights: w (k, n).
        turned: theta (k, n).
        forces: reaction per length (k, m).
        mean_iterations, most_iterations: systems solved in a step.
        searches: halvings of corrections.
        cuts: halvings of steps.
        landings: number of times that an element touches down.
    """

    times: FloatArray
    heights: FloatArray
    turned: FloatArray
    forces: FloatArray
    mean_iterations: float
    most_iterations: int
    searches: int
    cuts: int
    landings: int


class _Marching:
    """State of a run, and the advance by one step."""

    def __init__(self, beam: Beam, soil: BeamSoil, scheme: Scheme, begin: Solved) -> None:
        self.beam, self.soil, self.scheme = beam, soil, scheme
        self.state, self.velocity = begin.state, np.zeros_like(begin.state)
        self.acceleration = np.zeros_like(begin.state)
        self.reaction, self.time = begin.reaction, 0.0
        self._systems: dict[float, _Condensed] = {}
        self._resisted = self._resistance(self.state, self.velocity, self.reaction)
        self.iterations: list[int] = []
        self.searches = self.cuts = self.evaluations = 0
        self.most = _ENOUGH

    def _system(self, step: float) -> _Condensed:
        """Return the linear part of the equations of a step."""
        if step not in self._systems:
            scheme, beam = self.scheme, self.beam
            matrix = (1.0 - scheme.alpha_m) / (scheme.beta * step * step) * beam.inertia
            self._systems[step] = _Condensed(matrix + (1.0 - scheme.alpha_f) * beam.stiffness)
        return self._systems[step]

    def _resistance(self, state: FloatArray, velocity: FloatArray, reaction: Reaction) -> FloatArray:
        """Return R (2 n,): stiffness and drag less load and reaction."""
        resistance = self.beam.stiffness @ state - self.beam.load
        v = velocity[::2]
        resistance[::2] += self.beam.drag_at_nodes * np.abs(v) * v - reaction.nodal
        return resistance

    def advance(self, step: float, time: float, cuts: int = 0) -> None:
        """Advance by a step that ends at `time`, in halves if it does not converge. Raises NotConvergedError."""
        try:
            self._try(step, time)
        except NotConvergedError:
            if cuts == _CUTS or self.evaluations > self.most:
                raise
            self.cuts += 1
            self.advance(0.5 * step, time - 0.5 * step, cuts + 1)
            self.advance(0.5 * step, time, cuts + 1)

    def _try(self, step: float, time: float) -> None:
        beam, (_, alpha_m, alpha_f, *_), beta, gamma = self.beam, self.scheme, self.scheme.beta, self.scheme.gamma
        by_state, by_velocity = 1.0 / (beta * step * step), gamma / (beta * step)
        of_force = 1.0 - alpha_f
        before, speed, pushed = self.state, self.velocity, self.acceleration
        state = before + step * speed + 0.5 * step * step * pushed
        velocity, acceleration = speed + step * pushed, pushed.copy()
        state[-2], velocity[-2], acceleration[-2] = beam.end(time)
        predicted, fast, pushing = state.copy(), velocity, acceleration
        held = alpha_f * self._resisted
        drag = beam.drag_at_nodes

        def rates(trial: FloatArray) -> tuple[FloatArray, FloatArray]:
            moved = trial - predicted
            return fast + by_velocity * moved, pushing + by_state * moved

        def equations(trial: FloatArray) -> _Equations:
            v, a = rates(trial)
            self.evaluations += 1
            if self.evaluations > self.most:
                raise NotConvergedError("does not converge")
            reaction = self.soil.react(trial[::2], v[::2], step)
            self._behind = self._resistance(trial, v, reaction)
            residual = beam.inertia @ ((1.0 - alpha_m) * a + alpha_m * pushed) + of_force * self._behind + held
            diagonal = 2.0 * drag * np.abs(v[::2]) * by_velocity - reaction.diagonal
            beside = -reaction.beside
            if reaction.damping is not None:
                diagonal += reaction.damping[0] * by_velocity
                beside = beside + reaction.damping[1] * by_velocity
            return _Equations(residual, of_force * diagonal, of_force * beside, reaction)

        solved = _solved(beam, self._system(step), state, equations, _ITERATIONS)
        self.state, self.reaction, self._resisted, self.time = solved.state, solved.reaction, self._behind, time
        self.velocity, self.acceleration = rates(solved.state)
        self.iterations.append(solved.iterations)
        self.searches += solved.searches
        self.soil.keep()


def march(beam: Beam, soil: BeamSoil, scheme: Scheme, begin: Solved, steps: int, periods: int = 3) -> BeamRun:
    """Return a run of `steps` equal steps over `periods`, from rest. Raises NotConvergedError."""
    moving, step = _Marching(beam, soil, scheme, begin), periods * beam.period / steps
    first = steps - round(steps / periods)
    kept: list[tuple[FloatArray, Reaction]] = []
    touching, landings = begin.reaction.per_length > 0.0, 0
    for number in range(1, steps + 1):
        moving.most += _A_STEP
        moving.advance(step, number * step)
        touches = moving.reaction.per_length > 0.0
        landings += int(np.count_nonzero(touches & ~touching))
        touching = touches
        if number > first:
            kept.append((moving.state, moving.reaction))
    states = np.array([state for state, _ in kept])
    return BeamRun(
        step * np.arange(first + 1.0, steps + 1.0),
        states[:, ::2],
        states[:, 1::2],
        np.array([reaction.per_length for _, reaction in kept]),
        sum(moving.iterations) / len(moving.iterations),
        max(moving.iterations),
        moving.searches,
        moving.cuts,
        landings,
    )
