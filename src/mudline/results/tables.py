"""Rows of elements and nodes with the columns of the contract, spelled for a text format."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic_core import to_json

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
VECTORS = frozenset({"normal", "reaction"})
"""Columns of three components."""

_BLOCK = 16384
"""Rows spelled at a time: the texts of a large model are never all in memory."""

Row = tuple[str, ...]
Column = NDArray[Any] | Sequence[str | None]


@dataclass(frozen=True, slots=True)
class Spelling:
    """How a format spells a name, and that there is no value."""

    name: Callable[[str], str]
    nothing: str

    def column(self, values: Column) -> list[str]:
        """The values of a column; numbers read back to the same double, NaN is no value."""
        if not isinstance(values, np.ndarray):
            known = {value: self.nothing if value is None else self.name(value) for value in set(values)}
            return [known[value] for value in values]
        if not values.size:
            return []
        spelled = to_json(values.tolist(), inf_nan_mode="null")[1:-1].decode().split(",")
        if self.nothing == "null" or values.dtype.kind != "f" or not np.isnan(values).any():
            return spelled
        return [self.nothing if text == "null" else text for text in spelled]


def element_rows(evaluation: Evaluation, step: int, spelling: Spelling) -> Iterator[Row]:
    """The evaluated elements at a step, spelled."""
    scene, result = evaluation.scene, evaluation.result.step(step)
    sets, laws = scene.law_sets, evaluation.law_names(step)
    for start in range(0, len(evaluation.elements), _BLOCK):
        chosen = evaluation.elements[start : start + _BLOCK]
        columns: tuple[Column, ...] = (
            scene.element_ids[chosen],
            [sets[index] for index in chosen.tolist()],
            scene.diameter[chosen],
            evaluation.length[chosen],
            result.depth[chosen],
            result.ratio[chosen],
            result.contact[chosen],
            result.force[chosen],
            result.slope[chosen],
            result.stiffness[chosen],
            laws[start : start + _BLOCK],
            [None] * len(chosen),
        )
        yield from zip(*map(spelling.column, columns), strict=True)


def node_rows(evaluation: Evaluation, step: int, spelling: Spelling) -> Iterator[Row]:
    """The nodes with a position at a step, spelled; friction forces are 0.0 and states none without friction."""
    scene, result = evaluation.scene, evaluation.result.step(step)
    for start in range(0, len(evaluation.nodes), _BLOCK):
        chosen = evaluation.nodes[start : start + _BLOCK]
        zero, none = np.zeros(len(chosen)), [None] * len(chosen)
        columns: tuple[Column, ...] = (
            scene.node_ids[chosen],
            result.gap[chosen],
            *result.normal[chosen].T,
            *result.reaction[chosen].T,
            result.normal_force[chosen],
            zero,
            zero,
            none,
            none,
        )
        yield from zip(*map(spelling.column, columns), strict=True)
