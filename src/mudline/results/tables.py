"""Rows of elements and nodes, with the columns of the contract."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mudline.results.evaluation import Evaluation

ELEMENT_COLUMNS = (
    "element",
    "set",
    "diameter",
    "length",
    "depth",
    "ratio",
    "contact",
    "force",
    "slope",
    "stiffness",
    "law",
    "state",
)
NODE_COLUMNS = (
    "node",
    "gap",
    "normal",
    "reaction",
    "normal_force",
    "axial_force",
    "lateral_force",
    "axial_state",
    "lateral_state",
)
_FLAT = {"normal": ("normal_x", "normal_y", "normal_z"), "reaction": ("reaction_x", "reaction_y", "reaction_z")}

Row = dict[str, Any]


def element_rows(evaluation: Evaluation, step: int) -> Iterator[Row]:
    """The evaluated elements at a step; None where there is no value."""
    scene, result = evaluation.scene, evaluation.result.step(step)
    keep = np.flatnonzero(result.evaluated)
    chosen = keep.tolist()
    laws = evaluation.law_names(step)
    columns: list[list[Any]] = [
        scene.element_ids[keep].tolist(),
        [scene.law_sets[index] for index in chosen],
        _nullable(scene.diameter[keep]),
        scene.length[keep].tolist(),
        result.depth[keep].tolist(),
        _nullable(result.ratio[keep]),
        result.contact[keep].tolist(),
        result.force[keep].tolist(),
        _nullable(result.slope[keep]),
        result.stiffness[keep].tolist(),
        [laws[index] for index in chosen],
        [None] * len(chosen),
    ]
    for row in zip(*columns, strict=True):
        yield dict(zip(ELEMENT_COLUMNS, row, strict=True))


def node_rows(evaluation: Evaluation, step: int) -> Iterator[Row]:
    """The nodes with a position at a step; friction forces are 0.0 and states None without friction."""
    scene, result = evaluation.scene, evaluation.result.step(step)
    keep = np.flatnonzero(result.present)
    zeros, nothing = [0.0] * len(keep), [None] * len(keep)
    columns: list[list[Any]] = [
        scene.node_ids[keep].tolist(),
        result.gap[keep].tolist(),
        result.normal[keep].tolist(),
        result.reaction[keep].tolist(),
        result.normal_force[keep].tolist(),
        zeros,
        zeros,
        nothing,
        nothing,
    ]
    for row in zip(*columns, strict=True):
        yield dict(zip(NODE_COLUMNS, row, strict=True))


def _nullable(values: NDArray[np.float64]) -> list[float | None]:
    return [None if math.isnan(value) else value for value in values.tolist()]


def flat_columns(columns: tuple[str, ...]) -> list[str]:
    """Column names of CSV, where a vector is three columns."""
    return [flat for name in columns for flat in _FLAT.get(name, (name,))]


def flat_values(row: Row) -> list[Any]:
    """The values of a row for CSV."""
    values: list[Any] = []
    for value in row.values():
        values += value if isinstance(value, list) else [value]
    return values
