"""Stages that are switched on whether the deck has them or not, with usual numbers for its pipe."""

from __future__ import annotations

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.contact.extras import (
    ElementSuction,
    NodalSprings,
    NodeFriction,
    NodeTrench,
    Smoothing,
    SuctionSprings,
)
from mudline.contact.friction.law import FrictionLaw
from mudline.contact.friction.trench import TrenchLaw
from mudline.contact.suction import SuctionLaw, from_cohesion

COHESION = 5000.0


def smoothing(elements: int, diameter: float) -> Smoothing:
    """Centred zones of a hundredth of the diameter."""
    return Smoothing(np.full(elements, 0.01 * diameter), np.zeros(elements, np.bool_))


def nodal(nodes: int, diameter: float, stiffness: float) -> NodalSprings:
    """A spring at every node."""
    return NodalSprings(np.full(nodes, stiffness), np.full(nodes, 0.01 * diameter), np.zeros(nodes, np.bool_))


def unloading(elements: int, stiffness: float) -> FloatArray:
    """Lines twice as steep as the law."""
    return np.full(elements, 2.0 * stiffness)


def suction(elements: int, diameter: float) -> ElementSuction:
    """The law with a history."""
    row = np.ones(elements)
    factors = from_cohesion(COHESION * row, diameter * row)
    return ElementSuction(np.arange(elements), SuctionLaw(*factors, 0.2 * row, 0.8 * row, row, 1e-3 * row))


def suction_springs(elements: int, diameter: float, stiffness: float) -> SuctionSprings:
    """The law without one."""
    return SuctionSprings(np.full(elements, 0.1 * stiffness), np.full(elements, 0.2 * diameter))


def friction(nodes: int, diameter: float) -> NodeFriction:
    """Springs by mobilisation length; an ellipse at every second node."""
    both = np.ones((nodes, 2))
    law = FrictionLaw(
        coefficients=both * (0.35, 0.6),
        stiffness=np.nan * both,
        mobilisation=both * (0.01 * diameter, 0.1 * diameter),
        ellipse=np.arange(nodes) % 2 == 0,
        active=np.ones(nodes, np.bool_),
    )
    return NodeFriction(law, np.full(nodes, np.nan))


def lateral(elements: int, stiffness: float) -> FloatArray:
    """A tenth of the stiffness of the law."""
    return np.full(elements, 0.1 * stiffness)


def trench(nodes: int, diameter: float, stiffness: float) -> NodeTrench:
    """Along the line as it was laid."""
    row = np.ones(nodes)
    law = TrenchLaw(2.0 * diameter * row, 4.0 * diameter * row, 0.1 * stiffness * diameter * row)
    return NodeTrench(law, np.full((nodes, 4), np.nan))
