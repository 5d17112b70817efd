"""The differences of two decks."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mudline.comparison.blocks import blocks
from mudline.comparison.followed import followed
from mudline.comparison.model import Difference, Tolerance
from mudline.comparison.named import curves, parameters, sets
from mudline.comparison.numbered import elements, nodes
from mudline.comparison.side import Side
from mudline.scene.model import Scene
from mudline.scene.seabed import SeabedShape


def compare(before: Scene, after: Scene, tolerance: float = 0.0) -> list[Difference]:
    """What differs between the meanings of two decks; an empty list when they mean the same.

    `tolerance` is how far two numbers may be apart, relative to the larger one. Raises DeckError for a deck of which
    something could not be read, or in which an equation has no value.
    """
    one, other = Side(before), Side(after)
    one.require()
    other.require()
    return list(_differences(one, other, Tolerance(tolerance)))


def _differences(one: Side, other: Side, tolerance: Tolerance) -> Iterator[Difference]:
    if one.scene.units != other.scene.units:
        yield Difference("changed", "units", "units", one.scene.units, other.scene.units)
    yield from parameters(one, other, tolerance)
    yield from nodes(one, other, tolerance)
    yield from elements(one, other)
    yield from sets(one, other)
    yield from curves(one, other, tolerance)
    yield from followed(one, other, tolerance)
    yield from _floor(one, other, tolerance)
    yield from blocks(one, other, tolerance)


def _floor(one: Side, other: Side, tolerance: Tolerance) -> Iterator[Difference]:
    """The points of the bed that files hold; what the deck itself says of it is among its blocks."""
    old, new = one.scene.seabed, other.scene.seabed
    same = old.points.shape == new.points.shape and bool(tolerance.arrays(_sorted(old), _sorted(new)).all())
    if not same and (old.file or new.file):
        lines = one.line(old.where), other.line(new.where)
        counts = f"{len(old.points)} points", f"{len(new.points)} points"
        yield Difference("changed", "seabed", "seabed/points", *counts, *lines)


def _sorted(floor: SeabedShape) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    return floor.points[np.lexsort(floor.points.T[::-1])] if len(floor.points) else floor.points
