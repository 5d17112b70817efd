"""Scenes with everything on: a line on a bed, with each law on some of its elements or nodes."""

from __future__ import annotations

import numpy as np

from mudline.contact import ContactInput, LawKind
from mudline.contact.arrays import FloatArray
from mudline.contact.extras import (
    ElementSuction,
    Extras,
    NodalSprings,
    NodeFriction,
    NodeTrench,
    Smoothing,
    SuctionSprings,
)
from mudline.contact.floors import Floor
from mudline.contact.friction.law import FrictionLaw
from mudline.contact.friction.trench import TrenchLaw
from mudline.contact.suction import SuctionLaw, from_cohesion
from mudline.curves import ForceCurve

CLAY = ForceCurve([(0.0, 0.0), (0.1, 2000.0), (0.3, 4500.0), (0.5, 6000.0)], "clay")


def line(elements: int, seed: int) -> FloatArray:
    """Nodes of a slightly bent line along Y, a little below X = 0."""
    rng = np.random.default_rng(seed)
    points = np.zeros((elements + 1, 3))
    points[:, 0] = rng.uniform(-0.08, -0.02, elements + 1)
    points[:, 1] = np.cumsum(rng.uniform(1.5, 2.5, elements + 1))
    points[:, 2] = np.cumsum(rng.uniform(-0.2, 0.2, elements + 1))
    return points


def friction(nodes: int, rng: np.random.Generator, *, ellipse: bool = True) -> NodeFriction:
    """Springs of both kinds, some at an angle."""
    constant = np.where(rng.random((nodes, 1)) < 0.5, rng.uniform(2e4, 1e5, (nodes, 2)), np.nan)
    law = FrictionLaw(
        rng.uniform(0.2, 0.9, (nodes, 2)),
        constant,
        rng.uniform(0.005, 0.05, (nodes, 2)),
        (rng.random(nodes) < 0.4) & ellipse,
        rng.random(nodes) < 0.9,
    )
    return NodeFriction(law, np.where(rng.random(nodes) < 0.3, rng.uniform(-180, 180, nodes), np.nan))


def suction(elements: int, diameter: FloatArray, rng: np.random.Generator) -> ElementSuction:
    """The law of Bridge on some of the elements."""
    chosen = np.flatnonzero(rng.random(elements) < 0.7)
    count = len(chosen)
    factors = from_cohesion(np.full(count, 4000.0), diameter[chosen])
    rest = (np.full(count, 0.2), np.full(count, 0.8), np.ones(count), np.full(count, 1e-3))
    return ElementSuction(chosen, SuctionLaw(*factors, *rest).checked())


def everything(elements: int, seed: int, floor: Floor | None = None) -> ContactInput:
    """A scene in which each law holds somewhere."""
    rng = np.random.default_rng(seed)
    nodes = elements + 1
    on_curve = rng.random(elements) < 0.5
    diameter = rng.choice([0.3, 0.5], elements)
    points = line(elements, seed)
    unloading = np.where(rng.random(elements) < 0.4, 4.0e5, np.nan)
    width = np.where(np.isnan(unloading), rng.uniform(0.0, 0.02, elements), 0.0)
    has_nodal = rng.random(nodes) < 0.3
    trench = np.where(rng.random(nodes) < 0.7, 1.0, np.nan)
    straight = np.where(rng.random((nodes, 1)) < 0.3, np.array([[0.0, 0.1, 50.0, 0.3]]), np.nan)
    extras = Extras(
        smoothing=Smoothing(width, rng.random(elements) < 0.5),
        nodal=NodalSprings(np.where(has_nodal, 3.0e4, np.nan), rng.uniform(0.0, 0.01, nodes), rng.random(nodes) < 0.5),
        unloading=unloading,
        suction_springs=SuctionSprings(np.where(rng.random(elements) < 0.2, 800.0, np.nan), np.full(elements, 0.2)),
        suction=suction(elements, diameter, rng),
        friction=friction(nodes, rng),
        lateral=np.where(rng.random(elements) < 0.3, 900.0, np.nan),
        trench=NodeTrench(TrenchLaw(0.02 * trench, 0.4 * trench, 700.0 * trench), straight),
    )
    return ContactInput(
        node_ids=np.arange(1, nodes + 1),
        coordinates=points,
        element_ids=np.arange(1, elements + 1),
        element_nodes=np.column_stack([np.arange(elements), np.arange(1, nodes)]),
        length=np.sqrt((np.diff(points, axis=0) ** 2).sum(axis=1)),
        diameter=diameter,
        law=np.where(on_curve, LawKind.CURVE, LawKind.LINEAR).astype(np.int8),
        curve_index=np.where(on_curve, 0, -1),
        curves=(CLAY,),
        linear_stiffness=np.where(on_curve, np.nan, 2.0e4),
        floor=floor,
        extras=extras,
    )
