"""`*SEABED TRENCH`: the trenches that elements lie in."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.contact.input import LawAssignment
from mudline.contact.laws.trench import wall_coefficient
from mudline.diagnostics import Where
from mudline.scene.contact_parts.picking import marked, picked, refuse, refuse_entry
from mudline.scene.given import number
from mudline.scene.numbering import Floats, Mask

if TYPE_CHECKING:
    from mudline.keywords.library.seabed_trench import TrenchSet
    from mudline.scene.model import Scene

KEYWORD = "SEABED TRENCH"
LOCKED = "mu2 tan(theta) must be below 1, else the wall of the trench locks itself"
_LEAST_ROWS = 2
_LINE = (("start_y", "y0"), ("start_z", "z0"), ("end_y", "y1"), ("end_z", "z1"))


def trenches(scene: Scene, friction: LawAssignment | None) -> list[LawAssignment]:
    """The elements in trenches with a peak resistance, a tabulated one, or sloped walls.

    Raises RefusedError: an impossible geometry, a missing or impossible resistance, elements without a lateral friction
    spring, or a wall that locks itself.
    """
    extension = scene.extensions[KEYWORD]
    entries = _entries(scene)
    for entry, where in zip(entries, extension.places, strict=True):
        _check_entry(entry, where)
    if not (extension.of_element >= 0).any():
        return []
    bare = (extension.of_element >= 0) & ~_sprung(scene, friction)
    refuse(extension, bare, scene.element_ids, "a trench needs a lateral friction spring: give *SEABED FRICTION")
    refuse(extension, self_locking(scene, friction), scene.element_ids, LOCKED, "geometry")
    walls = np.array([entry.model == "WALL" for entry in entries])
    tabled = np.array([entry.peak == "TABLE" for entry in entries]) & ~walls
    tables = np.cumsum(tabled) - 1
    of_element = extension.of_element
    found = []
    for law, blocks, name in (
        ("trench peak", ~walls & ~tabled, "peak"),
        ("trench table", tabled, "table"),
        ("trench wall", walls, "depth"),
    ):
        rows = np.flatnonzero((of_element >= 0) & blocks[of_element])
        block = of_element[rows]
        geometry = [entry.geometry for entry in entries]
        lines = [entry.centreline for entry in entries]
        values = {
            "peak": (number(entry, "peak") for entry in entries),
            "table": map(float, tables.tolist()),
            "depth": (number(each, "depth") for each in geometry),
        }
        parameters = {
            "bottom": picked((number(each, "bottom_width") for each in geometry), block),
            "upper": picked((number(each, "upper_width") for each in geometry), block),
            name: picked(values[name], block),
            **{ours: picked((number(line, theirs) for line in lines), block) for ours, theirs in _LINE},
        }
        found.append(LawAssignment(law, rows, parameters))
    return found


def resistance_tables(scene: Scene) -> list[Floats]:
    """The tables (k, 2) of the blocks that have one, in their order."""
    tabled = (entry for entry in _entries(scene) if entry.model != "WALL" and entry.peak == "TABLE")
    return [entry.table.values for entry in tabled if entry.table is not None]


def resistance_faults(entry: TrenchSet) -> Iterator[tuple[tuple[str | int, ...], str]]:
    """Path and message of what keeps a block from saying its resistance; a sloped wall has that of its geometry."""
    if entry.model == "WALL":
        return
    if entry.peak is None:
        yield ("set",), "MODEL=PEAK needs a resistance: give PEAK="
    if entry.peak != "TABLE":
        return
    offsets = np.zeros(0) if entry.table is None else entry.table.column(0)
    if len(offsets) < _LEAST_ROWS:
        yield ("peak",), "PEAK=TABLE needs two rows or more: offset from the centreline, resistance per unit length"
    if (offsets[:1] < 0.0).any():
        yield ("table", 0, 0), "the offset from the centreline is negative: it is a distance, the same on both sides"
    for row in np.flatnonzero(np.diff(offsets) <= 0.0)[:1].tolist():
        yield ("table", row + 1, 0), "the offset is not larger than that of the row before: offsets must ascend"


def self_locking(scene: Scene, friction: LawAssignment | None) -> Mask:
    """Elements (m,) in a trench with sloped walls where the lateral coefficient of a node has mu2 tan(theta) >= 1."""
    extension, entries = scene.extensions[KEYWORD], _entries(scene)
    coefficient = np.zeros(len(scene.node_ids))
    if friction is not None:
        coefficient[friction.rows] = np.asarray(friction.parameters["lateral_coefficient"])
    sizes = [
        picked((number(entry.geometry, name) for entry in entries), extension.of_element)
        for name in ("depth", "bottom_width", "upper_width")
    ]
    found: Mask = np.zeros(len(scene.element_ids), dtype=np.bool_)
    for end in scene.element_nodes.T:
        added = wall_coefficient(sizes[0], sizes[1], sizes[2], coefficient[end])
        found |= ~(np.isfinite(added) & (added >= 0.0))
    usable = (sizes[0] > 0.0) & (sizes[1] > 0.0) & (sizes[2] > sizes[1])
    return found & usable & marked((entry.model == "WALL" for entry in entries), extension.of_element)


def _entries(scene: Scene) -> list[TrenchSet]:
    return cast("list[TrenchSet]", scene.extensions[KEYWORD].entries)


def _check_entry(entry: TrenchSet, where: Where) -> None:
    geometry, line = entry.geometry, entry.centreline
    bottom, upper = number(geometry, "bottom_width"), number(geometry, "upper_width")
    if not 0.0 < bottom < upper:
        refuse_entry(where, "geometry", "the widths of the trench must be above 0, the upper one larger")
    if all(number(line, f"{axis}0") == number(line, f"{axis}1") for axis in "yz"):
        refuse_entry(where, "centreline", "the two points of the centreline are one")
    for path, message in resistance_faults(entry):
        *outer, last = path
        refuse_entry(where._replace(path=(*where.path, *outer)), last, message)


def _sprung(scene: Scene, friction: LawAssignment | None) -> Mask:
    """Elements (m,) whose two nodes have a lateral friction spring."""
    sprung = np.zeros(len(scene.node_ids), dtype=np.bool_)
    if friction is not None:
        stiffness = np.asarray(friction.parameters["lateral_stiffness"])
        coefficient = np.asarray(friction.parameters["lateral_coefficient"])
        sprung[friction.rows] = ~np.isnan(stiffness) | (coefficient > 0.0)
    found: Mask = np.logical_and(*sprung[scene.element_nodes].T)
    return found
