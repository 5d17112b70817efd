"""`*SEABED TRENCH`: the trenches that elements lie in."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.contact.input import LawAssignment
from mudline.scene.contact_parts.picking import picked
from mudline.scene.given import number
from mudline.scene.numbering import Floats

if TYPE_CHECKING:
    from mudline.keywords.library.seabed_trench import TrenchSet
    from mudline.scene.model import Scene

KEYWORD = "SEABED TRENCH"
_LINE = (("start_y", "y0"), ("start_z", "z0"), ("end_y", "y1"), ("end_z", "z1"))


def trenches(scene: Scene) -> list[LawAssignment]:
    """The elements in trenches with a peak resistance, a tabulated one, or sloped walls."""
    extension = scene.extensions[KEYWORD]
    entries = _entries(scene)
    if not (extension.of_element >= 0).any():
        return []
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


def _entries(scene: Scene) -> list[TrenchSet]:
    return cast("list[TrenchSet]", scene.extensions[KEYWORD].entries)
