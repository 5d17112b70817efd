"""Doubts about positions of nodes before they are evaluated: their vertical axis, order, nodes and digits."""

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
from mudline.model.scene.mesh import distances
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Floats, Indices, Mask
from mudline.model.scene.seabed import FLAT, NEAR, LineExtent

DEEPEST = 5.0
"""Depth in diameters below 0 at which Z may still be the height of a pipe that lies on the seabed."""
LEVEL = 0.005
"""Ratio of rise to length of a level element."""
_GROSS = 1.5, 0.1
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


@np.errstate(over="ignore", invalid="ignore")
def height_along_z(scene: Scene, elements: Indices, places: Floats) -> str:
    """Return in words the signs that Z is the height of nodes at `places` (n, 3); "" without any.

    Either the line has one X and Z spans the water depth. Or elements run along X, and lie just below Z = 0, or at
    minus the water depth, as a pipe on the seabed does. A vertical riser at Z = 0 shows neither sign, unless it is
    longer than the water depth.
    """
    ends = scene.element_nodes[elements]
    used = places[ends.ravel()]
    if not used.size or not np.isfinite(used).all():
        return ""
    depth = scene.surroundings.depth
    x, y, z = zip(used.min(axis=0).tolist(), used.max(axis=0).tolist(), strict=True)
    if sign := LineExtent(x, y, z, depth).height_along_z():
        return sign
    (low_x, high_x), (low_z, high_z) = x, z
    first, second = places[ends[:, 0]], places[ends[:, 1]]
    run = np.abs(second - first)
    along_x = (run[:, 0] > 0.0) & (run[:, 2] <= LEVEL * run[:, 0]) & (run[:, 1] <= run[:, 0])
    middle = 0.5 * first[:, 2] + 0.5 * second[:, 2]
    sunk = along_x & (abs(middle + depth) <= FLAT * depth)
    if sunk.sum() > 1 and high_z > low_z + NEAR * depth:
        return f"{int(sunk.sum())} elements run along X at minus the water depth in Z"
    limit = DEEPEST * np.nan_to_num(scene.diameter[elements])
    lies = along_x & (middle <= 0.0) & (middle >= -limit)
    below = lies & (middle < 0.0)
    if below.sum() > 1 or (lies.any() and high_x - low_x > (1.0 + NEAR) * depth):
        level = f"at Z = {low_z:.5g}" if low_z == high_z else f"with Z from {low_z:.5g} to {high_z:.5g}"
        return f"{int(lies.sum())} elements run along X {level}"
    return ""


def _off_lengths(scene: Scene, places: Floats, factor: float) -> tuple[Indices, Indices, Floats]:
    """Return the elements whose distance of ends at `places` (n, 3) differs from their length by `factor`; and all.

    Springs, and elements whose length or positions are not known, are left out of both. The distances (m,) of all ends
    are the third result.
    """
    ends = places[scene.element_nodes]
    apart = distances(ends[:, 0], ends[:, 1])
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = apart / scene.length
        known = np.flatnonzero((scene.length > 0.0) & np.isfinite(apart) & np.isfinite(scene.length))
        off = known[~((ratio[known] <= factor) & (ratio[known] >= 1.0 / factor))]
    return off, known, apart


def require_order(positions: Positions, scene: Scene, file: str) -> Positions:
    """Return positions of a file; those without node numbers must fit the elements of the deck.

    Raises DeckError if so many elements are longer or shorter that the nodes must be in another order.
    """
    if positions.numbered:
        return positions
    places = np.asarray(positions.values[0], dtype=np.float64)
    off, known, apart = _off_lengths(scene, places, _GROSS[0])
    if len(off) < 1 or len(off) < _GROSS[1] * len(known):
        return positions
    first = int(off[0])
    first_node, second_node = scene.node_ids[scene.element_nodes[first]].tolist()
    message = (
        f"the positions are not in ascending order of the node numbers: nodes {first_node} and {second_node} of "
        f"element {scene.element_ids[first]} are {shown(float(apart[first]))} apart, and its length is "
        f"{shown(float(scene.length[first]))} ({len(off)} of {counted(len(known), 'element')} differ by over "
        f"{_GROSS[0]:g} times); sort them, or give their numbers in a CSV, or in the array node of an NPZ"
    )
    from mudline.model.scene.csv_file import data_error  # noqa: PLC0415 - checking a deck does without it

    raise data_error(file, message)


def position_doubts(contact_input: ContactInput, scene: Scene, present: Mask, places: Floats) -> list[Doubt]:
    """Return doubts about positions (n, 3) of a file: elements without positions, other lengths, few digits."""
    doubts = []
    lost = np.flatnonzero(~present[scene.element_nodes].all(axis=1))
    if lost.size:
        missing = counted(int((~present).sum()), "node")
        message = f"no positions for {missing}: {scene.describe(lost, 'is', 'are')} left out"
        doubts.append(Doubt(RUN007, message, None, lost, ""))
    off, known, apart = _off_lengths(scene, places, _SLIGHT)
    if off.size:
        first = int(off[0])
        message = (
            f"the ends of {len(off)} of {counted(len(known), 'element')} are over a tenth nearer or further apart than "
            f"the element is long (first: {scene.element_ids[first]}, {shown(float(apart[first]))} instead of "
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
