"""Scenes and paths of random kind, for properties that hold of all of them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, replace

import numpy as np

from mudline.contact import ContactInput, ContactModel, ContactResult
from mudline.contact.arrays import FloatArray, IndexArray
from mudline.contact.extras import (
    ElementSuction,
    Extras,
    NodalSprings,
    NodeFriction,
    NodeTrench,
    Smoothing,
    SuctionSprings,
)
from mudline.contact.friction.law import FrictionLaw
from mudline.contact.friction.trench import TrenchLaw
from mudline.contact.suction import SuctionLaw
from tests.contact.scenes import line


def journey(elements: int, steps: int, seed: int) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Positions and velocities (steps, n, 3) of a line that heaves and drifts, and the times (steps,) of its steps."""
    rng = np.random.default_rng(seed)
    moves = rng.normal(scale=(0.04, 0.02, 0.03), size=(steps, elements + 1, 3))
    moves += rng.normal(scale=(0.05, 0.02, 0.05), size=(steps, 1, 3))  # the line as a whole
    positions = line(elements, seed) + np.cumsum(moves, axis=0)
    times = np.cumsum(rng.uniform(0.05, 0.5, steps))
    velocities = np.diff(positions, axis=0, prepend=positions[:1]) / np.diff(times, prepend=0.0)[:, None, None]
    return positions, velocities, times


def rearranged(
    inputs: ContactInput, order: IndexArray, turned: np.ndarray[tuple[int], np.dtype[np.bool_]]
) -> ContactInput:
    """The same elements in another order, some written from their second node to their first."""
    ends = np.where(turned[:, None], inputs.element_nodes[:, ::-1], inputs.element_nodes)[order]
    extras = inputs.extras
    smooth, springs, sucking = extras.smoothing, extras.suction_springs, extras.suction
    place = np.argsort(order)
    return replace(
        inputs,
        element_ids=inputs.element_ids[order],
        element_nodes=ends,
        length=inputs.length[order],
        diameter=inputs.diameter[order],
        law=inputs.law[order],
        curve_index=inputs.curve_index[order],
        linear_stiffness=inputs.linear_stiffness[order],
        extras=replace(
            extras,
            smoothing=smooth and Smoothing(smooth.half_width[order], smooth.one_sided[order]),
            suction_springs=springs and SuctionSprings(springs.stiffness[order], springs.extent[order]),
            suction=sucking and ElementSuction(place[sucking.elements], sucking.law),
            unloading=None if extras.unloading is None else extras.unloading[order],
            lateral=None if extras.lateral is None else extras.lateral[order],
        ),
    )


def alone(inputs: ContactInput, element: int) -> ContactInput:
    """One element with its own extras, and none of nodes."""
    one = slice(element, element + 1)
    extras = inputs.extras
    smooth, springs, sucking = extras.smoothing, extras.suction_springs, extras.suction
    held = None if sucking is None else np.flatnonzero(sucking.elements == element)
    law = None if sucking is None or held is None or not held.size else SuctionLaw(*(row[held] for row in sucking.law))
    return replace(
        inputs,
        element_ids=inputs.element_ids[one],
        element_nodes=inputs.element_nodes[one],
        length=inputs.length[one],
        diameter=inputs.diameter[one],
        law=inputs.law[one],
        curve_index=inputs.curve_index[one],
        linear_stiffness=inputs.linear_stiffness[one],
        extras=Extras(
            smoothing=smooth and Smoothing(smooth.half_width[one], smooth.one_sided[one]),
            suction_springs=springs and SuctionSprings(springs.stiffness[one], springs.extent[one]),
            suction=law and ElementSuction(np.zeros(1, np.intp), law),
            unloading=None if extras.unloading is None else extras.unloading[one],
        ),
    )


def renumbered(inputs: ContactInput, order: IndexArray) -> ContactInput:
    """The same nodes in another order: node k of the new input is node order[k] of the old one."""
    extras = inputs.extras
    springs, rubbing, ditch = extras.nodal, extras.friction, extras.trench
    return replace(
        inputs,
        node_ids=inputs.node_ids[order],
        coordinates=inputs.coordinates[order],
        element_nodes=np.argsort(order)[inputs.element_nodes],
        extras=replace(
            extras,
            nodal=springs
            and NodalSprings(springs.stiffness[order], springs.half_width[order], springs.one_sided[order]),
            friction=rubbing and NodeFriction(_of(rubbing.law, order), rubbing.angle[order]),
            trench=ditch
            and NodeTrench(
                TrenchLaw(ditch.law.bottom[order], ditch.law.upper[order], ditch.law.peak[order]), ditch.straight[order]
            ),
        ),
    )


def _of(law: FrictionLaw, order: IndexArray) -> FrictionLaw:
    return FrictionLaw(*(getattr(law, field.name)[order] for field in fields(FrictionLaw)))


def stepped(contact: ContactModel, positions: FloatArray, velocities: FloatArray) -> Iterator[ContactResult]:
    """The steps one by one."""
    state = contact.initial_state()
    for place, rate in zip(positions, velocities, strict=True):
        result, state = contact.step(place, rate, state)
        yield result


def same_bits(one: ContactResult, other: ContactResult) -> bool:
    """Whether two results are the same to the last bit."""
    pairs = [(getattr(one, field.name), getattr(other, field.name)) for field in fields(ContactResult)]
    return all(
        left is right if left is None else np.array_equal(left, right, equal_nan=left.dtype.kind == "f")
        for left, right in pairs
    )
