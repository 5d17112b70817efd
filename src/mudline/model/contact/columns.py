"""Columns of elements and nodes, described once for all formats."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from mudline.basics.quantities import ELEMENTS, NODES, Names, Quantity
from mudline.basics.units import UNITS
from mudline.model.contact.arrays import BoolArray, FloatArray, IndexArray
from mudline.model.contact.input import ContactInput
from mudline.model.contact.result import ContactResult, ResultPart

Values = NDArray[Any]

CUT = "curve-cut"


@dataclass(frozen=True, slots=True)
class ResultColumn:
    """A column of a table with the same rows at all steps.

    Attributes:
        name: name of the result quantity.
        values: (rows,), or with steps (steps, rows); a vector has one more axis of 3.
        names: texts that the values index, the last of them None for index -1. Empty for a column of numbers.
        vector: whether a value has three components.
        over_steps: whether a step may change the column, even if no step does in this scene.
        blank: whole number that means "no value"; None if every number is a value.
        unit: name of the unit of the values; "" for none.
    """

    name: str
    values: Values
    names: Names = ()
    vector: bool = False
    over_steps: bool = True
    blank: int | None = None
    unit: str = ""

    @property
    def steady(self) -> bool:
        """True if the values have no axis for steps."""
        return self.values.ndim == 1 + self.vector

    def flat(self) -> list[ResultColumn]:
        """Return the column itself, or the three columns of a vector."""
        if not self.vector:
            return [self]
        axes = enumerate(("_x", "_y", "_z"))
        return [
            ResultColumn(self.name + axis, self.values[..., i], over_steps=self.over_steps, unit=self.unit)
            for i, axis in axes
        ]

    def cut(self, first: int, last: int) -> Values:
        """Return the values of some steps as (steps, rows) or (steps, rows, 3), of a steady column too."""
        if self.steady:
            return np.broadcast_to(self.values, (last - first, *self.values.shape))
        return self.values[first:last]


def timed(
    columns: Sequence[ResultColumn], clock: Values | None, rows: int, units: str, name: str = "time"
) -> list[ResultColumn]:
    """Return the flat columns of a table, after a column of the times (or numbers) of some steps if there are any."""
    flat = [part for column in columns for part in column.flat()]
    if clock is None:
        return flat
    times = np.broadcast_to(np.reshape(clock, (-1, 1)), (np.size(clock), rows))
    return [ResultColumn(name, times, unit=UNITS[units].unit("T") if name == "time" else ""), *flat]


NO_ELEMENT = -1
""""No element" in a column of element numbers."""


class ResultTable(ABC):
    """A table of some elements, nodes or lines, which makes the columns for some steps."""

    quantities: ClassVar[Mapping[str, Quantity]]
    _fixed: dict[str, Values]
    """Values that no step changes, by column name."""
    _blanks: Mapping[str, int] = MappingProxyType({})
    """Whole numbers that mean "no value", by column name."""

    def __init__(self, given: ContactInput, chosen: IndexArray) -> None:
        self._chosen = chosen
        self._names: dict[str, Names] = {}
        self.units = given.units

    @property
    def rows(self) -> int:
        """Number of rows of a step."""
        return len(self._chosen)

    @abstractmethod
    def columns(self, part: ResultPart) -> list[ResultColumn]:
        """Return the columns of the result quantities."""

    def facts(self) -> list[ResultColumn]:
        """Return the columns that no step changes, including the law of elements whose curve is cut at some steps."""
        return [
            ResultColumn(name, values, self._names.get(name, ()), over_steps=False, unit=quantity.unit_name(self.units))
            for name, quantity in self.quantities.items()
            if (values := self._fixed.get(name)) is not None
        ]

    def _columns(self, changing: dict[str, Values], result: ContactResult) -> list[ResultColumn]:
        """Return a column of each quantity: a fixed one, one of `changing`, or the attribute of the result."""
        values = self._fixed | changing
        return [
            ResultColumn(
                name,
                values[name] if name in values else kept(getattr(result, name), self._chosen),
                self._names.get(name, quantity.names),
                quantity.vector,
                quantity.over_steps,
                self._blanks.get(name),
                quantity.unit_name(self.units),
            )
            for name, quantity in self.quantities.items()
        ]


class ElementResults(ResultTable):
    """The evaluated elements."""

    quantities = ELEMENTS

    def __init__(self, given: ContactInput, chosen: IndexArray) -> None:
        super().__init__(given, chosen)
        set_codes, sets = coded(given.law_sets)
        laws, names = coded(given.law_names)
        self._may_cut = given.tension == "cut"
        laws_named = names[:-1] if CUT in names else (*names[:-1], CUT)
        self._cut_code = np.int32(laws_named.index(CUT))
        self._names = {"set": sets, "law": (*laws_named, None)}
        self._ends = given.element_nodes[chosen]
        self._fixed = {
            "element": given.element_ids[chosen],
            "set": set_codes[chosen],
            "law": laws[chosen],
            "arc_length": given.lines.element_arc[chosen],
            "diameter": given.diameter[chosen],
            "length": given.length[chosen],
            "line": given.lines.of_element[chosen] + 1,
            "node1": given.node_ids[self._ends[:, 0]],
            "node2": given.node_ids[self._ends[:, 1]],
        }

    def columns(self, part: ResultPart) -> list[ResultColumn]:
        """Return the columns of the result quantities."""
        result = part.result
        ends = [_places(result, column) for column in self._ends.T]
        values: dict[str, Values] = {
            **{axis: 0.5 * (ends[0][..., i] + ends[1][..., i]) for i, axis in enumerate("xyz")},
            "state": codes_of(result.state, self._chosen),
        }
        if self._may_cut:
            values["law"] = np.where(kept(result.cut, self._chosen), self._cut_code, self._fixed["law"])
        return self._columns(values, result)


class NodeResults(ResultTable):
    """The nodes that have a position. Without friction the friction forces are 0 and the states -1."""

    quantities = NODES

    def __init__(self, given: ContactInput, chosen: IndexArray) -> None:
        super().__init__(given, chosen)
        self._fixed = {
            "node": given.node_ids[chosen],
            "arc_length": given.lines.node_arc[chosen],
            "line": given.lines.of_node[chosen] + 1,
        }

    def columns(self, part: ResultPart) -> list[ResultColumn]:
        """Return the columns of the result quantities."""
        result, chosen = part.result, self._chosen
        axial, lateral = _by_direction(result.friction)
        axial_state, lateral_state = _by_direction(result.friction_state)
        places = _places(result, chosen)
        values: dict[str, Values] = {
            **{axis: places[..., i] for i, axis in enumerate("xyz")},
            "normal": self._normal(result.normal),
            "axial_force": self._force(axial),
            "lateral_force": self._force(lateral),
            "axial_state": codes_of(axial_state, chosen),
            "lateral_state": codes_of(lateral_state, chosen),
        }
        return self._columns(values, result)

    def _normal(self, normal: Values) -> Values:
        """Return normals (steps, k, 3), or (k, 3) if all points of the seabed share a normal."""
        return kept(normal, self._chosen) if any(normal.strides[:2]) else np.array(normal[0, self._chosen])

    def _force(self, force: Values | None) -> Values:
        return np.zeros(self.rows) if force is None else kept(force, self._chosen)


def by_number(given: ContactInput, present: BoolArray) -> IndexArray:
    """Return the indices of the nodes that have a position, in ascending order of their numbers."""
    nodes = np.flatnonzero(present)
    return nodes[given.node_ids[nodes].argsort(kind="stable")]


def coded(texts: Sequence[str | None]) -> tuple[NDArray[np.int32], Names]:
    """Return texts as indices of distinct names; None has index -1 and is the last name."""
    number: dict[str | None, int] = {}
    for text in texts:
        if text is not None:
            number.setdefault(text, len(number))
    names = (*number, None)
    number[None] = -1
    return np.array([number[text] for text in texts], dtype=np.int32).reshape(len(texts)), names


def _places(result: ContactResult, nodes: IndexArray) -> FloatArray:
    """Return the positions (steps, k, 3) of some nodes."""
    if result.positions is None:
        return np.full((len(result.depth), len(nodes), 3), np.nan)
    return np.asarray(result.positions[:, nodes], np.float64)


def codes_of(states: Values | None, chosen: NDArray[np.intp]) -> Values:
    """Return the states of some elements or nodes; -1 if no law has states."""
    return np.full(len(chosen), -1, np.int8) if states is None else kept(states, chosen)


def kept(array: Values, chosen: NDArray[np.intp]) -> Values:
    """Return the columns (steps, k, ...) of some elements or nodes; no copy if all are chosen."""
    return array if array.shape[1] == len(chosen) else array[:, chosen]


def _by_direction(values: Values | None) -> tuple[Values | None, Values | None]:
    return (None, None) if values is None else (values[..., 0], values[..., 1])
