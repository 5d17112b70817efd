"""The reference: an explicit pair of order 8 with error control that begins again at every event of the contact.

Contact with a history is smooth only between events: an element touches or lets go, its suction reaches a corner, its
velocity changes sign or passes v_r or its largest value so far; a node begins to slip or sticks again. The evaluator
takes the history of the step's begin, so a step of the reference is exact as long as

* the stick point of a slipping node moves one way, and
* the velocity of a lifting element grows, or is below its largest so far.

Each step therefore ends at the first event in it, found by bisection of the step's interpolant down to 1e-13 s, with
the history taken there. Between two events forces are smooth functions of positions and velocities.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from scipy.integrate import DOP853

from mudline.model.contact.arrays import FloatArray, IndexArray
from mudline.model.contact.laws.friction import FrictionState
from mudline.model.contact.laws.suction import SuctionLaw, SuctionState
from mudline.model.contact.tables import ContactState
from tests.benchmarks.dynamics.lifting import Forces, Lifting

_PEEK = 1e-7
"""Seconds ahead over which the change of the normal force is taken: it decides only a sign."""
RESOLUTION = 1e-13
"""Seconds within which an event is located."""


@dataclass(frozen=True, slots=True)
class Tolerance:
    """How tight.

    Attributes:
        relative: of each component, per step.
        longest: largest step, s; what happens twice within a step is not seen.
    """

    relative: float
    longest: float

    @property
    def absolute(self) -> float:
        """Of displacements (m), rates (m/s) and works (J)."""
        return 1e-3 * self.relative


@dataclass(slots=True)
class Path:
    """What the line did at the wanted moments (s,).

    Attributes:
        displacements, rates: (s, 2 n).
        works: (s, 3) of the hoist, of the seabed, and of the line's damping, J.
        hoist: (s, 2) its force, N.
        gaps: (s, n) m.
        events: how many were located.
    """

    displacements: FloatArray
    rates: FloatArray
    works: FloatArray
    hoist: FloatArray
    gaps: FloatArray
    events: int = 0

    @classmethod
    def blank(cls, moments: int, nodes: int) -> Path:
        """So many moments of which nothing is known yet."""
        both, gaps = (np.full((moments, width), np.nan) for width in (2 * nodes, nodes))
        return cls(both, both.copy(), np.full((moments, 3), np.nan), np.full((moments, 2), np.nan), gaps)


@dataclass(slots=True)
class Reference:
    """One integration."""

    lifting: Lifting
    tolerance: Tolerance
    state: ContactState = field(init=False)
    events: int = 0

    def __post_init__(self) -> None:
        zeros = np.zeros(2 * self.lifting.beam.nodes)
        self.state = self.lifting.forces(0.0, zeros, zeros, self.lifting.beam.contact.initial_state()).state

    def run(self, times: FloatArray) -> Path:
        """Integrate from rest at 0 through the `times` (s,), which ascend from 0."""
        size = 2 * self.lifting.beam.nodes
        found = Path.blank(len(times), self.lifting.beam.nodes)
        solver = self._solver(0.0, np.zeros(2 * size + 3), times[-1])
        mode = self._mode(0.0, solver.y)
        self._keep(found, 0, 0.0, solver.y)
        row = 1
        while row < len(times):
            message = solver.step()
            if solver.status == "failed":
                raise ArithmeticError(f"the reference stopped at {solver.t:g} s: {message}")
            end, now = solver.t, solver.y
            if not np.array_equal(self._mode(end, now), mode):
                end, now = self._event(solver, mode)
                self.events += 1
            dense = solver.dense_output()
            while row < len(times) and times[row] <= end:
                self._keep(found, row, times[row], dense(times[row]))
                row += 1
            if end < solver.t:
                mode = self._mode(end, now)
                self._commit(end, now)
                solver = self._solver(end, now, times[-1])
            else:
                mode = self._mode(end, now)
                self._commit(end, now)
        found.events = self.events
        return found

    def _solver(self, time: float, values: FloatArray, end: float) -> DOP853:
        tolerance = self.tolerance
        return DOP853(
            self._rates,  # type: ignore[arg-type]  # the stubs want one that takes complex numbers too
            time,
            values,
            end + 1e-3,
            rtol=tolerance.relative,
            atol=tolerance.absolute,
            max_step=tolerance.longest,
        )

    def _at(self, time: float, values: FloatArray) -> Forces:
        size = 2 * self.lifting.beam.nodes
        return self.lifting.forces(time, values[:size], values[size : 2 * size], self.state)

    def _rates(self, time: float, values: FloatArray) -> FloatArray:
        """Velocities, accelerations, and the powers of hoist, seabed and damping."""
        size = 2 * self.lifting.beam.nodes
        rates, forces = values[size : 2 * size], self._at(time, values)
        powers = [forces.hoist @ self.lifting.hoist.speed(time), forces.contact @ rates, forces.damping @ rates]
        return np.concatenate([rates, forces.total / self.lifting.beam.mass, powers])

    def _commit(self, time: float, values: FloatArray) -> None:
        """Begin the next step with the history of this moment."""
        self.state = self._at(time, values).state

    def _event(self, solver: DOP853, mode: IndexArray) -> tuple[float, FloatArray]:
        """The first moment of the last step in another mode, and the values there."""
        dense, before, after = solver.dense_output(), float(solver.t_old or 0.0), float(solver.t)
        while after - before > RESOLUTION:
            middle = 0.5 * (before + after)
            if not before < middle < after:
                break
            if np.array_equal(self._mode(middle, dense(middle)), mode):
                before = middle
            else:
                after = middle
        return after, dense(after)

    def _mode(self, time: float, values: FloatArray) -> IndexArray:
        """Which branch of its law every element and node is on; what differs between two moments has an event."""
        beam, size = self.lifting.beam, 2 * self.lifting.beam.nodes
        forces = self._at(time, values)
        rates, acceleration = values[size : 2 * size], forces.total / beam.mass
        return np.concatenate(
            [
                forces.result.contact,
                self._suction_mode(forces, rates[: beam.nodes], acceleration[: beam.nodes]),
                self._friction_mode(time, values, acceleration, forces),
            ]
        )

    def _suction_mode(self, forces: Forces, rates: FloatArray, acceleration: FloatArray) -> IndexArray:
        given, after, before = self.lifting.beam.contact.input, forces.state.suction, self.state.suction
        if after is None or before is None or forces.result.state is None:
            return np.zeros(0, np.intp)
        law = SuctionLaw(*given.assigned["suction"].columns)
        ends = given.element_nodes
        v, change = rates[ends].mean(axis=1), acceleration[ends].mean(axis=1)
        pulls = forces.result.state == SuctionState.SUCTION
        share = -forces.result.depth / after.depth
        piece = (share > law.first_corner).astype(np.intp) + (share > law.second_corner)
        grows = (v >= before.v_max) & (change >= 0.0)
        own = np.where(pulls, 1 + piece + 4 * (v > law.regularisation) + 8 * grows, 0)
        return np.concatenate([forces.result.state.astype(np.intp), own])

    def _friction_mode(self, time: float, values: FloatArray, acceleration: FloatArray, forces: Forces) -> IndexArray:
        """Open, stick or slip along the line; who slips sticks again where its stick point would turn."""
        beam, size = self.lifting.beam, 2 * self.lifting.beam.nodes
        states, friction = forces.result.friction_state, forces.result.friction
        if states is None or friction is None:
            return np.zeros(0, np.intp)
        own = states[:, 0].astype(np.intp)
        slips = own == FrictionState.SLIP
        if slips.any():
            law = beam.contact.input.assigned["friction"]
            ahead = values.copy()
            ahead[:size] += _PEEK * values[size : 2 * size]
            ahead[size : 2 * size] += _PEEK * acceleration
            change = (self._at(time, ahead).result.normal_force - forces.result.normal_force) / _PEEK
            threshold = change * law.spread("axial_coefficient", beam.nodes) / law.spread("axial_stiffness", beam.nodes)
            side = -np.sign(friction[:, 0])
            moves = side * values[size + beam.nodes : 2 * size] - threshold
            own = np.where(slips & (moves < 0.0), int(FrictionState.STICK), own)
        return own

    def _keep(self, found: Path, row: int, time: float, values: FloatArray) -> None:
        size = 2 * self.lifting.beam.nodes
        forces = self._at(time, values)
        found.displacements[row], found.rates[row] = values[:size], values[size : 2 * size]
        found.works[row], found.hoist[row], found.gaps[row] = values[2 * size :], forces.hoist, forces.result.gap
