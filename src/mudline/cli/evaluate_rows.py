"""The rows of an evaluation that people are shown: what touches the bed, or is held by it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mudline.results.columns import ElementTable
from mudline.results.evaluation import Evaluation, Part
from mudline.results.quantities import SLIDING, STATES, headed, shown, unit_names
from mudline.scene.numbering import Floats, Indices

Cells = tuple[str, ...]
LEFT = ("law", "state", "axial", "lateral")
"""Columns of text."""


def touching_elements(evaluation: Evaluation, part: Part) -> tuple[Cells, Iterator[Cells]]:
    """Elements in contact, or with a force above the bed, at the first step of a part."""
    names = unit_names(evaluation.scene.units)
    columns: Cells = (
        "element",
        "law",
        headed("depth", names.length),
        "ratio",
        headed("force", names.line_force),
        headed("stiffness", names.stiffness),
        headed("length", names.length),
    )
    result, chosen = part.result.step(0), evaluation.elements
    held = np.flatnonzero(result.contact[chosen] | (np.nan_to_num(result.force[chosen]) != 0.0))
    index = chosen[held]
    law = next(column for column in ElementTable(evaluation).columns(part) if column.name == "law")
    cells = [
        [str(number) for number in evaluation.scene.element_ids[index].tolist()],
        [law.names[code] or "" for code in law.cut(0, 1)[0, held].tolist()],
        *(_numbers(column, index) for column in (result.depth, result.ratio, result.force, result.stiffness)),
        _numbers(evaluation.length, index),
    ]
    if result.state is not None:
        columns = (*columns, "state")
        cells.append([STATES[code] or "" for code in result.state[index].tolist()])
    return columns, zip(*cells, strict=True)


def touching_nodes(evaluation: Evaluation, part: Part) -> tuple[Cells, Iterator[Cells]]:
    """Nodes on which the bed acts, also by restraining them, at the first step of a part."""
    names = unit_names(evaluation.scene.units)
    axes = (headed(f"reaction {axis}", names.force) for axis in "XYZ")
    columns: Cells = ("node", headed("gap", names.length), *axes)
    result = part.result.step(0)
    acts = (result.reaction != 0.0).any(axis=1)
    if result.restrained is not None:
        acts |= result.restrained
    index = evaluation.nodes[acts[evaluation.nodes]]
    cells = [
        [str(number) for number in evaluation.scene.node_ids[index].tolist()],
        *(_numbers(column, index) for column in (result.gap, *result.reaction.T)),
    ]
    if result.friction is not None:
        columns = (*columns, headed("axial\nforce", names.force), headed("lateral\nforce", names.force))
        cells += [_numbers(column, index) for column in result.friction.T]
    if result.friction_state is not None:
        columns = (*columns, "axial", "lateral")
        cells += [[SLIDING[code] or "" for code in column[index].tolist()] for column in result.friction_state.T]
    return columns, zip(*cells, strict=True)


def _numbers(column: Floats, index: Indices) -> list[str]:
    return [shown(value) for value in column[index].tolist()]
