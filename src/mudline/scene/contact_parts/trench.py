"""`*SEABED TRENCH`: the trenches that elements lie in."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mudline.contact.input import LawAssignment
from mudline.diagnostics import Where
from mudline.scene.contact_parts.picking import picked, refuse, refuse_entry
from mudline.scene.given import number
from mudline.scene.numbering import Floats, Mask

if TYPE_CHECKING:
    from mudline.scene.model import Scene

KEYWORD = "SEABED TRENCH"
_LINE = (("start_y", "y0"), ("start_z", "z0"), ("end_y", "y1"), ("end_z", "z1"))


def trenches(scene: Scene, friction: LawAssignment | None) -> list[LawAssignment]:
    """The elements in trenches with a peak resistance, a tabulated one, or sloped walls.

    Raises RefusedError: an impossible geometry, a missing resistance, or elements without a lateral friction spring.
    """
    extension = scene.extensions[KEYWORD]
    for entry, where in zip(extension.entries, extension.places, strict=True):
        _check_entry(entry, where)
    if not (extension.of_element >= 0).any():
        return []
    bare = (extension.of_element >= 0) & ~_sprung(scene, friction)
    refuse(extension, bare, scene.element_ids, "a trench needs a lateral friction spring: give *SEABED FRICTION")
    walls = np.array([_is_wall(entry) for entry in extension.entries])
    tabled = np.array([_table(entry) is not None for entry in extension.entries]) & ~walls
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
        geometry = [getattr(entry, "geometry", None) for entry in extension.entries]
        lines = [getattr(entry, "centreline", None) for entry in extension.entries]
        values = {
            "peak": (number(entry, "peak") for entry in extension.entries),
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
    tables = (_table(entry) for entry in scene.extensions[KEYWORD].entries if not _is_wall(entry))
    return [table for table in tables if table is not None]


def _is_wall(entry: object) -> bool:
    return getattr(entry, "model", None) == "WALL"


def _table(entry: object) -> Floats | None:
    """Offsets and resistances (k, 2) of a block, None where it has no table."""
    table = getattr(entry, "table", None)
    return None if table is None else table.values


def _check_entry(entry: object, where: Where) -> None:
    geometry, line = getattr(entry, "geometry", None), getattr(entry, "centreline", None)
    bottom, upper = number(geometry, "bottom_width"), number(geometry, "upper_width")
    if not 0.0 < bottom < upper:
        refuse_entry(where, "geometry", "the widths of the trench must be above 0, the upper one larger")
    if all(number(line, f"{axis}0") == number(line, f"{axis}1") for axis in "yz"):
        refuse_entry(where, "centreline", "the two points of the centreline are one")
    if _is_wall(entry):
        return
    table = _table(entry)
    if table is not None:
        if len(table) < 2 or not (np.diff(table[:, 0]) > 0.0).all() or not np.isfinite(table).all():
            refuse_entry(where, "peak", "PEAK=TABLE needs two rows or more, with offsets that ascend")
    elif np.isnan(number(entry, "peak")):
        refuse_entry(where, "set", "MODEL=PEAK needs a resistance: give PEAK=")


def _sprung(scene: Scene, friction: LawAssignment | None) -> Mask:
    """Elements (m,) whose two nodes have a lateral friction spring."""
    sprung = np.zeros(len(scene.node_ids), dtype=np.bool_)
    if friction is not None:
        stiffness = np.asarray(friction.parameters["lateral_stiffness"])
        coefficient = np.asarray(friction.parameters["lateral_coefficient"])
        sprung[friction.rows] = ~np.isnan(stiffness) | (coefficient > 0.0)
    found: Mask = np.logical_and(*sprung[scene.element_nodes].T)
    return found
