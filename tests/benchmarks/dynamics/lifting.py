"""The beam on the seabed with a hoist at its last node: forces at a moment, their tangent, and who did which work."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.result import ContactResult
from mudline.model.contact.tables import ContactState
from tests.benchmarks.dynamics.beam import Beam

DAMPING = 1e-3
"""Of the stiffness, s: half of it times omega is the share of critical damping, 0.5 % at 10 rad/s."""


@dataclass(frozen=True, slots=True)
class Hoist:
    """Two springs between the last node and a point that moves.

    The point goes up by `height` and down again, and along the line by `pull` and back.

    Attributes:
        stiffness: of both, N/m.
        height, lift_period: m, s.
        pull, pull_period: m, s.
    """

    stiffness: float
    height: float
    lift_period: float
    pull: float
    pull_period: float

    def place(self, time: float) -> FloatArray:
        """How far it has moved up, and along the line."""
        periods = np.array([self.lift_period, self.pull_period])
        travel: FloatArray = 0.5 * np.array([self.height, self.pull]) * (1.0 - np.cos(2.0 * np.pi * time / periods))
        return travel

    def speed(self, time: float) -> FloatArray:
        """Its velocity."""
        rates = 2.0 * np.pi / np.array([self.lift_period, self.pull_period])
        speed: FloatArray = 0.5 * np.array([self.height, self.pull]) * rates * np.sin(rates * time)
        return speed


class Forces(NamedTuple):
    """At a moment. All but `total` are for those who look on.

    total: (2 n,) on the masses.
    contact: (2 n,) of the seabed on the line.
    hoist: (2,) of the hoist on the line, up and along.
    damping: (2 n,) of the line's own damping.
    result: what the evaluator gave.
    state: the state of the contact behind this moment.
    """

    total: FloatArray
    contact: FloatArray
    hoist: FloatArray
    damping: FloatArray
    result: ContactResult
    state: ContactState


@dataclass(frozen=True, slots=True, eq=False)
class Lifting:
    """A beam and its hoist."""

    beam: Beam
    hoist: Hoist
    damping: float = DAMPING

    @property
    def held(self) -> list[int]:
        """Where in the displacements the hoist holds the line: its last node, up and along."""
        return [self.beam.nodes - 1, 2 * self.beam.nodes - 1]

    def forces(self, time: float, displacements: FloatArray, rates: FloatArray, state: ContactState) -> Forces:
        """Forces at a moment of a step that began with `state`."""
        beam, held = self.beam, self.held
        result, after = beam.contact.step(beam.positions(displacements), beam.velocities(rates), state)
        contact = result.reaction[:, :2].T.ravel()
        damping = -self.damping * (beam.stiffness @ rates)
        total = beam.weight + contact + damping - beam.stiffness @ displacements
        hoist = self.hoist.stiffness * (self.hoist.place(time) - displacements[held])
        total[held] += hoist
        return Forces(total, contact, hoist, damping, result, after)

    def tangent(
        self, displacements: FloatArray, rates: FloatArray, state: ContactState
    ) -> tuple[FloatArray, FloatArray]:
        """The derivatives (2 n, 2 n) of the total forces by displacements and by rates."""
        beam, held = self.beam, self.held
        found = beam.contact.tangent(beam.positions(displacements), beam.velocities(rates), state)
        at = np.concatenate([3 * np.arange(beam.nodes), 3 * np.arange(beam.nodes) + 1])
        both = np.ix_(at, at)
        by_position = found.by_position.dense()[both] - beam.stiffness
        by_position[held, held] -= self.hoist.stiffness
        return by_position, found.by_velocity.dense()[both] - self.damping * beam.stiffness

    def energy(self, time: float, displacements: FloatArray, rates: FloatArray) -> float:
        """That of the line, and of the springs of its hoist, J."""
        stretch = self.hoist.place(time) - displacements[self.held]
        return self.beam.energy(displacements, rates) + 0.5 * self.hoist.stiffness * float(stretch @ stretch)


def touchdown(gap: FloatArray, arcs: FloatArray) -> float:
    """Arc length of the last point where the gaps (n,) change sign, by interpolation; the end where all lies."""
    below = gap < 0.0
    crossings = np.flatnonzero(below[:-1] & ~below[1:])
    if not len(crossings):
        return float(arcs[-1] if below.any() else arcs[0])
    at = int(crossings[-1])
    share = gap[at] / (gap[at] - gap[at + 1])
    return float(arcs[at] + share * (arcs[at + 1] - arcs[at]))
