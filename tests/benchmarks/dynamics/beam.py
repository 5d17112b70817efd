"""A line of a deck as masses, axial springs and bending springs, in one vertical plane: all that is linear in it.

The masses are lumped at the nodes. Between neighbours acts EA / L along the line, and at each inner node the bending
moment EI (x(i-1) - 2 x(i) + x(i+1)) / L^2. Displacements are small against the length, so that both are linear and the
contact is all that is not: what a run shows is the work of the contact and of the scheme, not of a beam theory. A share
of the stiffness damps (Rayleigh). Drag and added mass are left out.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

import mudline
from mudline.model.contact import ContactModel
from mudline.model.contact.arrays import FloatArray
from mudline.model.scene.deck_values import number
from mudline.model.scene.model import resolve
from tests.benchmarks.runner import ROOT

DECKS = ROOT / "docs" / "studies" / "benchmark"


@dataclass(frozen=True, slots=True, eq=False)
class Beam:
    """n nodes along Y, X up. Displacements u (2 n,) are the heights of all nodes, then their places along the line.

    Attributes:
        contact: the seabed of the deck.
        start: (n, 3) the deck's coordinates.
        mass: (2 n,) kg.
        stiffness: (2 n, 2 n) N/m.
        weight: (2 n,) submerged weight, N, negative in the heights.
    """

    contact: ContactModel
    start: FloatArray
    mass: FloatArray
    stiffness: FloatArray
    weight: FloatArray

    @property
    def nodes(self) -> int:
        """How many there are."""
        return len(self.start)

    def positions(self, displacements: FloatArray) -> FloatArray:
        """Coordinates (n, 3)."""
        found = self.start.copy()
        found[:, 0] += displacements[: self.nodes]
        found[:, 1] += displacements[self.nodes :]
        return found

    def velocities(self, rates: FloatArray) -> FloatArray:
        """Rates of the coordinates (n, 3)."""
        found = np.zeros(self.start.shape)
        found[:, 0], found[:, 1] = rates[: self.nodes], rates[self.nodes :]
        return found

    def energy(self, displacements: FloatArray, rates: FloatArray) -> float:
        """Kinetic, elastic and potential, J: 0 for the line as the deck has it, at rest."""
        kinetic = 0.5 * (self.mass * rates * rates).sum()
        elastic = 0.5 * displacements @ self.stiffness @ displacements
        return float(kinetic + elastic - self.weight @ displacements)


def in_line_order(contact: ContactModel) -> ContactModel:
    """The same contact with its nodes in the order of its one line: `GEN=` writes the ends of a range first."""
    given = contact.input
    order = given.lines.nodes[0]
    row = np.argsort(order)
    laws = tuple(
        replace(law, rows=row[law.rows]) if given.assigned[law.law].law.acts_on == "nodes" else law
        for law in given.laws
    )
    return ContactModel(
        replace(
            given,
            node_ids=given.node_ids[order],
            coordinates=given.coordinates[order],
            element_nodes=row[given.element_nodes],
            laws=laws,
        )
    )


def read_beam(name: str) -> Beam:
    """The line of a deck in docs/studies/benchmark: one set, `OPTION=FLEXIBLE`, elements of one length along Y."""
    scene = resolve(mudline.read(DECKS / name))
    section = scene.section_table.sections[0].entry.flexible
    if section is None:
        raise ValueError(f"{name} has no flexible section")
    bending, axial = number(section, "eiyy"), number(section, "ea")
    contact = in_line_order(scene.contact())
    start = np.array(contact.input.coordinates, np.float64)
    nodes, length = len(start), float(contact.input.length[0])
    share = lumped(nodes, length)
    mass, weight = scene.mass_per_length[0] * share, -scene.submerged_weight[0] * share
    stiffness = np.zeros((2 * nodes, 2 * nodes))
    stiffness[:nodes, :nodes] = bending / length**3 * differences(nodes, 2)
    stiffness[nodes:, nodes:] = axial / length * differences(nodes, 1)
    return Beam(contact, start, np.tile(mass, 2), stiffness, np.concatenate([weight, np.zeros(nodes)]))


def lumped(nodes: int, length: float) -> FloatArray:
    """The length (n,) that each node has of elements of this length."""
    share = np.full(nodes, length)
    share[[0, -1]] *= 0.5
    return share


def differences(nodes: int, order: int) -> FloatArray:
    """The matrix (n, n) of the sum of squares of the differences of this order."""
    found = np.diff(np.eye(nodes), order, axis=0)
    squares: FloatArray = found.T @ found
    return squares
