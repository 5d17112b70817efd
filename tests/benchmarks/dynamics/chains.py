"""A mooring chain at three depths: equilibrium with the evaluator's forces, the elastic catenary, and MoorDyn.

The chain is made of straight elastic elements with their weight at the nodes, as MoorDyn's is. Its equilibrium is found
by Newton's method with the evaluator's consistent tangent, without friction.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import asinh, hypot, sqrt
from typing import NamedTuple

import numpy as np
from scipy.optimize import fsolve

import mudline
from mudline.model.contact import ContactModel
from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.tables import ContactState
from mudline.model.scene.model import resolve
from tests.benchmarks.dynamics.beam import DECKS, in_line_order

STANDARD_GRAVITY = 9.80665
"""m/s2; MoorDyn takes it if none is given."""
VOLUME, LINK = 1.80, 3.35
"""Diameters of a studless chain over that of its bar: of a rod of the same volume, and around its links."""
_CLOSE = 1e-3
"""Newtons at the worst node: equilibrium."""


class Case(NamedTuple):
    """Where the fairlead of a deck hangs above the seabed, and from the anchor; the published tensions, kN.

    The decks are those of a public test of MoorDyn, tests/quasi_static_chain.cpp, which has the tensions "predicted by
    quasi-static codes" and allows a difference of 10 %.
    """

    depth: int
    distance: float
    fairlead: float
    anchor: float

    @property
    def deck(self) -> str:
        """Its file."""
        return f"chain-{self.depth:03d}.keyxm"


CASES = (Case(50, 400.0, 991.6, 826.2), Case(200, 700.0, 2065.4, 1402.2), Case(600, 1500.0, 5232.6, 3244.2))


@dataclass(frozen=True, slots=True, eq=False)
class Chain:
    """n nodes from the anchor to the fairlead.

    Attributes:
        contact: the seabed of the deck.
        length: (n - 1,) unstretched lengths, m.
        axial: EA, N.
        weight: submerged, N/m.
        mass, diameter: kg/m, m.
        gravity: m/s2.
    """

    contact: ContactModel
    length: FloatArray
    axial: float
    weight: float
    mass: float
    diameter: float
    gravity: float

    @property
    def spring(self) -> float:
        """Of the seabed below a metre of the line, N/m2."""
        return float(self.contact.input.assigned["nodal"].parameters["stiffness"][1]) / float(self.length[0])

    @property
    def sinks(self) -> float:
        """How deep the line lies under its weight, m."""
        return self.weight / self.spring


def read_chain(case: Case) -> Chain:
    """The chain of a deck, with one section, `OPTION=MOORING`."""
    scene = resolve(mudline.read(DECKS / case.deck))
    section = scene.section_table.sections[0].entry.mooring
    if section is None:
        raise ValueError(f"{case.deck} has no mooring section")
    given = scene.contact().input
    kept = tuple(law for law in given.laws if law.law != "friction")
    contact = in_line_order(ContactModel(replace(given, laws=kept)))
    return Chain(
        contact,
        contact.input.length,
        float(section.ea),
        float(scene.submerged_weight[0]),
        float(scene.mass_per_length[0]),
        float(contact.input.diameter[0]),
        scene.surroundings.gravity,
    )


class Tensions(NamedTuple):
    """At the fairlead and at the anchor, kN."""

    fairlead: float
    anchor: float


def catenary(chain: Chain, height: float, distance: float) -> Tensions:
    """The elastic catenary with a part on a rigid seabed without friction.

    Horizontal force H and vertical force V at the fairlead, with L the length, w the weight, and l = L - V / w what
    lies on the seabed (Jonkman 2007, equations 2-37 and 2-38).
    """
    whole, w, axial = float(chain.length.sum()), chain.weight, chain.axial

    def misses(force: FloatArray) -> list[float]:
        h, v = (float(value) for value in force)
        across = whole - v / w + h / w * asinh(v / h) + h * whole / axial - distance
        return [across, h / w * (sqrt(1.0 + (v / h) ** 2) - 1.0) + v * v / (2.0 * axial * w) - height]

    h, v = (float(value) for value in fsolve(misses, [7e3 * height, 2.2 * w * height], xtol=1e-12))
    return Tensions(hypot(h, v) / 1e3, h / 1e3)


def lowered(chain: Chain, height: float, distance: float) -> Tensions:
    """The catenary of a chain that lies on its links, under standard gravity."""
    lighter = replace(chain, weight=chain.weight * STANDARD_GRAVITY / chain.gravity)
    return catenary(lighter, height - lies_higher(chain), distance)


def lies_higher(chain: Chain) -> float:
    """How high above the seabed the lowest point of the catenary is where the links rest on it and sink in, m."""
    link = LINK / VOLUME * chain.diameter
    return 0.5 * link - 0.5 * chain.sinks * chain.diameter / link


def on_springs(chain: Chain, height: float, distance: float) -> Tensions:
    """The catenary as a chain of elements on an elastic seabed has it.

    Under the horizontal force H a cable sinks into springs k per unit length by s (1 - exp(x / b)) in front of where it
    leaves the mudline, s = w / k, b = root(H / k). There its slope is s / b and its curvature w / H: it goes on as a
    catenary whose lowest point is s / 2 below the mudline. And the tension of the last element is that of its middle.
    """
    high = catenary(chain, height + 0.5 * chain.sinks, distance)
    vertical = sqrt(high.fairlead**2 - high.anchor**2) / high.fairlead
    return Tensions(high.fairlead - 0.5e-3 * chain.weight * float(chain.length[-1]) * vertical, high.anchor)


@dataclass(slots=True)
class Equilibrium:
    """A chain at rest: positions (n, 3), X up, and the state of the contact behind them."""

    chain: Chain
    places: FloatArray
    state: ContactState

    @classmethod
    def hanging(cls, chain: Chain, height: float, distance: float) -> Equilibrium:
        """With the fairlead at its place, at rest; what lies on the seabed begins as a straight line."""
        whole, nodes = float(chain.length.sum()), len(chain.length) + 1
        arcs = np.concatenate([[0.0], np.cumsum(chain.length)])
        # on the seabed up to where the rest reaches the fairlead as a straight line
        lies = (whole * whole - height * height - distance * distance) / (2.0 * (whole - distance))
        share = np.clip((arcs - lies) / (whole - lies), 0.0, 1.0)
        places = np.zeros((nodes, 3))
        places[:, 0] = height * share
        places[:, 1] = np.where(arcs < lies, arcs, lies + (distance - lies) * share)
        found = cls(chain, places, chain.contact.initial_state())
        found.settle()
        return found

    def settle(self) -> None:
        """Find the equilibrium that goes with the places of anchor and fairlead, and take its history."""
        free = slice(3, -3)
        keep = np.tile([True, True, False], len(self.places))[free]
        for _ in range(500):
            left, state = self._forces(self.places)
            worst = float(np.abs(left.ravel()[free][keep]).max())
            if worst < _CLOSE:
                self.state = state
                return
            tangent = self._tangent()[free, free][np.ix_(keep, keep)]
            change = np.zeros(self.places.size)
            inner = np.zeros(len(keep))
            inner[keep] = np.linalg.solve(tangent, -left.ravel()[free][keep])
            change[free] = inner
            change *= min(1.0, 2.0 * float(self.chain.length[0]) / float(np.abs(change).max()))
            self._move(change.reshape(-1, 3), worst)
        raise ArithmeticError(f"no equilibrium: {worst:.3g} N are left")

    def _move(self, change: FloatArray, worst: float) -> None:
        """Take the correction, halved until it does not make things much worse."""
        for _ in range(8):
            left, _ = self._forces(self.places + change)
            if float(np.abs(left[1:-1, :2]).max()) < 2.0 * worst:
                break
            change = 0.5 * change
        self.places = self.places + change

    def _forces(self, places: FloatArray) -> tuple[FloatArray, ContactState]:
        chain = self.chain
        result, state = chain.contact.step(places, None, self.state)
        found = np.array(result.reaction)
        found[:-1, 0] -= 0.5 * chain.weight * chain.length
        found[1:, 0] -= 0.5 * chain.weight * chain.length
        along = np.diff(places, axis=0)
        stretched = np.linalg.norm(along, axis=1)
        pull = (chain.axial * (stretched / chain.length - 1.0) / stretched)[:, None] * along
        found[:-1] += pull
        found[1:] -= pull
        return found, state

    def _tangent(self) -> FloatArray:
        chain = self.chain
        tangent = chain.contact.tangent(self.places, None, self.state).by_position.dense()
        along = np.diff(self.places, axis=0)
        stretched = np.linalg.norm(along, axis=1)
        for at, (vector, long, length) in enumerate(zip(along, stretched, chain.length, strict=True)):
            unit = np.outer(vector, vector) / long**2
            # a slack element would push its nodes sideways: it keeps a share of its stiffness
            tension = max(chain.axial * (long / length - 1.0), 1e-4 * chain.axial)
            block = chain.axial / length * unit + tension / long * (np.eye(3) - unit)
            rows = slice(3 * at, 3 * at + 6)
            tangent[rows, rows] -= np.block([[block, -block], [-block, block]])
        return tangent

    def tensions(self) -> Tensions:
        """Of the last and of the first element."""
        stretched = np.linalg.norm(np.diff(self.places, axis=0), axis=1)
        tension = self.chain.axial * (stretched / self.chain.length - 1.0) / 1e3
        return Tensions(float(tension[-1]), float(tension[0]))
