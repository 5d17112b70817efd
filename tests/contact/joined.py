"""Chains with suction, friction, unloading and trenches on them, and walks of theirs through `ContactModel.step`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from mudline.contact import ContactInput, ContactModel, ContactResult
from mudline.contact.arrays import FloatArray
from mudline.contact.extras import ElementSuction, Extras, NodalSprings, NodeFriction, NodeTrench, Smoothing
from mudline.contact.friction.law import FrictionLaw
from mudline.contact.friction.trench import TrenchLaw
from mudline.contact.suction import SuctionLaw
from tests.contact.chains import at_depths

NO_ANGLE = np.nan


def smoothing(elements: int, half_width: float, *, one_sided: bool = False) -> Smoothing:
    """One quadratic zone for all elements."""
    return Smoothing(np.full(elements, half_width), np.full(elements, one_sided))


def nodal(stiffness: ArrayLike, half_width: float = 0.0, *, one_sided: bool = False) -> NodalSprings:
    """Springs of nodes, NaN for none."""
    springs = np.array(stiffness, np.float64)
    return NodalSprings(springs, np.full(springs.shape, half_width), np.full(springs.shape, one_sided))


def suction(law: SuctionLaw, elements: Sequence[int] | None = None) -> ElementSuction:
    """The law on these elements, or on as many from the first as it has rows."""
    rows = range(len(law.cyclic)) if elements is None else elements
    return ElementSuction(np.array(rows, np.intp), law)


def friction(
    nodes: int,
    coefficients: tuple[float, float] = (0.5, 0.8),
    stiffness: float | tuple[float, float] = 1e5,
    *,
    mobilisation: float = np.nan,
    ellipse: bool = False,
    angle: float = NO_ANGLE,
) -> NodeFriction:
    """One law for all nodes; `mobilisation` instead of a stiffness of NaN."""
    law = FrictionLaw(
        np.tile(np.array(coefficients), (nodes, 1)),
        np.broadcast_to(np.asarray(stiffness, np.float64), (nodes, 2)).copy(),
        np.full((nodes, 2), mobilisation),
        np.full(nodes, ellipse),
        np.ones(nodes, np.bool_),
    )
    return NodeFriction(law, np.full(nodes, angle))


def trench(nodes: int, bottom: float, upper: float, peak: float) -> NodeTrench:
    """A trench along +Y at Z = 0 for all nodes, `peak` the force on each."""
    widths = TrenchLaw(np.full(nodes, bottom), np.full(nodes, upper), np.full(nodes, peak))
    return NodeTrench(widths, np.tile([0.0, 0.0, 1.0, 0.0], (nodes, 1)))


def model(inputs: ContactInput, extras: Extras) -> ContactModel:
    """The model of an input with these extras instead of its own."""
    return ContactModel(replace(inputs, extras=extras))


def walk(contact: ContactModel, positions: ArrayLike, velocities: ArrayLike | None = None) -> list[ContactResult]:
    """Results of the steps of positions (steps, n, 3), the rates of which are 0 where they are not given."""
    places = np.asarray(positions, np.float64)
    rates = np.zeros_like(places) if velocities is None else np.asarray(velocities, np.float64)
    state, results = contact.initial_state(), []
    for place, rate in zip(places, rates, strict=True):
        result, state = contact.step(place, rate, state)
        results.append(result)
    return results


def heave(depths: ArrayLike, pull_out: ArrayLike, nodes: int = 2) -> tuple[FloatArray, FloatArray]:
    """Positions and velocities (steps, n, 3) of a chain that stays level: depths and pull-out velocities (steps,)."""
    depth = np.repeat(np.asarray(depths, np.float64)[:, None], nodes, axis=1)
    positions = at_depths(depth)
    positions[..., 1] = 2.0 * np.arange(nodes)
    velocities = np.zeros_like(positions)
    velocities[..., 0] = np.broadcast_to(np.asarray(pull_out, np.float64)[:, None], depth.shape)
    return positions, velocities


def drawn(places: ArrayLike, depth: ArrayLike = 0.02, nodes: int = 2) -> FloatArray:
    """Positions (steps, n, 3) of a chain along Y at a depth, drawn along (steps, 2) to offsets in Y and Z."""
    offsets = np.asarray(places, np.float64)
    positions, _ = heave(np.broadcast_to(np.asarray(depth, np.float64), len(offsets)), np.zeros(len(offsets)), nodes)
    positions[..., 1:] += offsets[:, None, :]
    return positions
