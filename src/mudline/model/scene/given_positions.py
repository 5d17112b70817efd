"""Doubts about positions of a file before they are evaluated: their order, their nodes, their digits."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from mudline.basics.quantities import shown
from mudline.basics.short_repr import counted
from mudline.language.codes.contact import RUN006, RUN007, RUN008
from mudline.language.diagnostics import Code, Where
from mudline.model.contact.arrays import Positions
from mudline.model.contact.input import ContactInput
from mudline.model.scene.csv_file import data_error
from mudline.model.scene.mesh import distances
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Floats, Indices, Mask

GROSS = 1.5, 0.1
"""Limits of a wrong order of nodes: factor between length and distance, and share of elements beyond it."""
_SLIGHT = 1.1
"""Factor between length and distance beyond which a deck's element does not fit: no pipe stretches by a tenth."""
_ROUNDED = 0.05, 0.01
"""Ratios of half a unit of the last digit to the mobilisation length: that of a warning, and that of enough digits."""
_MOST = 9
_ENOUGH, _DIGITS = 10, 0.6
"""Limits of rounded coordinates: number of different values, and share that needs the last digit."""


class Doubt(NamedTuple):
    """Doubt about contact: code, message, place, elements (indices), and the message for the caption of a plot."""

    code: Code
    message: str
    where: Where | None
    elements: Indices
    brief: str


def off_lengths(scene: Scene, places: Floats, factor: float) -> tuple[Indices, Indices]:
    """Return the elements whose distance of ends at `places` (n, 3) differs from their length by `factor`; and all.

    Springs, and elements whose length or positions are not known, are left out of both.
    """
    ends = places[scene.element_nodes]
    apart = distances(ends[:, 0], ends[:, 1])
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = apart / scene.length
        known = np.flatnonzero((scene.length > 0.0) & np.isfinite(apart) & np.isfinite(scene.length))
        off = known[~((ratio[known] <= factor) & (ratio[known] >= 1.0 / factor))]
    return off, known


def require_order(positions: Positions, scene: Scene, file: str) -> Positions:
    """Return positions of a file; those without node numbers must fit the elements of the deck.

    Raises DeckError if so many elements are longer or shorter that the nodes must be in another order.
    """
    if positions.numbered:
        return positions
    places = np.asarray(positions.values[0], dtype=np.float64)
    off, known = off_lengths(scene, places, GROSS[0])
    if len(off) < 1 or len(off) < GROSS[1] * len(known):
        return positions
    first = int(off[0])
    first_node, second_node = scene.node_ids[scene.element_nodes[first]].tolist()
    ends = places[scene.element_nodes[first]]
    apart = float(distances(ends[:1], ends[1:])[0])
    message = (
        f"the positions are not in ascending order of the node numbers: nodes {first_node} and {second_node} of "
        f"element {scene.element_ids[first]} are {shown(apart)} apart, and its length is "
        f"{shown(float(scene.length[first]))} ({len(off)} of {counted(len(known), 'element')} differ by over "
        f"{GROSS[0]:g} times); sort them, or give their numbers in a CSV, or in the array node of an NPZ"
    )
    raise data_error(file, message)


def position_doubts(contact_input: ContactInput, scene: Scene, present: Mask, places: Floats) -> list[Doubt]:
    """Return doubts about positions (n, 3) of a file: elements without positions, other lengths, few digits."""
    doubts = []
    lost = np.flatnonzero(~present[scene.element_nodes].all(axis=1))
    if lost.size:
        missing = counted(int((~present).sum()), "node")
        message = f"no positions for {missing}: {scene.describe(lost, 'is', 'are')} left out"
        doubts.append(Doubt(RUN007, message, None, lost, ""))
    off, known = off_lengths(scene, places, _SLIGHT)
    if off.size:
        first = int(off[0])
        ends = places[scene.element_nodes[first]]
        apart = shown(float(distances(ends[:1], ends[1:])[0]))
        message = (
            f"the ends of {len(off)} of {counted(len(known), 'element')} are over a tenth nearer or further apart than "
            f"the element is long (first: {scene.element_ids[first]}, {apart} instead of "
            f"{shown(float(scene.length[first]))}): check that the positions are of this deck, and their units"
        )
        doubts.append(Doubt(RUN006, message, None, off, "distances differ from lengths"))
    return [*doubts, *_few_digits(contact_input, scene, present, places)]


def _few_digits(contact_input: ContactInput, scene: Scene, present: Mask, places: Floats) -> list[Doubt]:
    """Return a doubt about coordinates whose rounding moves nodes by much of their mobilisation length."""
    friction = contact_input.assigned.get("friction")
    if friction is None:
        return []
    here = present[friction.rows]
    lengths = np.fmin(friction["axial_mobilisation"], friction["lateral_mobilisation"])[here]
    nodes, least = friction.rows[here], float(np.fmin.reduce(lengths, initial=np.inf))
    digits = _digits(places[nodes]) if math.isfinite(least) and least > 0.0 else None
    if digits is None or 0.5 * 10.0**-digits <= _ROUNDED[0] * least:
        return []
    share = 0.5 * 10.0**-digits / least
    needed = math.ceil(-math.log10(2.0 * _ROUNDED[1] * least))
    part = "all" if share >= 1.0 else f"{shown(100.0 * share, 2)} %"
    message = (
        f"the coordinates have {counted(digits, 'decimal')}, and rounding them makes up to {part} of the friction, "
        f"which {shown(least)} mobilise: give {needed} decimals"
    )
    held = np.zeros(len(scene.node_ids), dtype=np.bool_)
    held[nodes] = True
    elements = np.flatnonzero(held[scene.element_nodes].any(axis=1))
    return [Doubt(RUN008, message, None, elements, "coordinates rounded")]


def _digits(places: Floats) -> int | None:
    """Return the number of decimals of coordinates (n, 3); None if they are not rounded, or few or even numbers."""
    values = np.unique(np.abs(places[np.isfinite(places)]))
    if len(values) < _ENOUGH:
        return None
    near = np.spacing(values[-1])
    for digits in range(_MOST):
        if (np.abs(values - np.round(values, digits)) <= near).all():
            uneven = np.abs(values - np.round(values, digits - 1)) > near
            return digits if np.count_nonzero(uneven) >= _DIGITS * len(values) else None
    return None
