"""The columns of elements and nodes: one description for all formats."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from mudline.basics.quantities import ELEMENTS, NODES, Names, Quantity
from mudline.model.contact.arrays import BoolArray, FloatArray, IndexArray
from mudline.model.contact.input import ContactInput
from mudline.model.contact.result import ContactResult, Part

Values = NDArray[Any]

CUT = "curve-cut"


@dataclass(frozen=True, slots=True)
class Column:
    """A column for rows that are the same ones at all steps.

    Attributes:
        name: as in the contract.
        values: (rows,), or with steps (steps, rows); a vector has one more axis of 3.
        names: the texts of a column of texts, whose values are indices; -1 is the last one, None. Empty for numbers.
        vector: whether a value has three components.
        over_steps: whether the column is one that a step may change, even if nothing does in this scene.
        blank: the whole number that stands for no value; None where every one is a value.
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
        """Whether the values have no axis for steps."""
        return self.values.ndim == 1 + self.vector

    def flat(self) -> list[Column]:
        """The column itself, or the three of a vector."""
        if not self.vector:
            return [self]
        axes = enumerate(("_x", "_y", "_z"))
        return [
            Column(self.name + axis, self.values[..., i], over_steps=self.over_steps, unit=self.unit)
            for i, axis in axes
        ]

    def cut(self, first: int, last: int) -> Values:
        """The values of some steps, also of a steady column, as (steps, rows) or (steps, rows, 3)."""
        if self.steady:
            return np.broadcast_to(self.values, (last - first, *self.values.shape))
        return self.values[first:last]


NO_ELEMENT = -1
"""Stands in a column of numbers of elements for none."""
Others = Callable[[Part], Sequence[tuple[str, FloatArray]]]
"""Gives further columns of elements for some steps: names, and values (steps, m)."""


class Table(ABC):
    """Makes the columns of the elements or nodes with these indices for some steps."""

    quantities: ClassVar[Mapping[str, Quantity]]
    _fixed: dict[str, Values]
    """Values that no step changes, by the name of their column."""
    _blanks: Mapping[str, int] = MappingProxyType({})
    """The whole numbers that stand for no value, by the name of their column."""

    def __init__(self, given: ContactInput, chosen: IndexArray) -> None:
        self._chosen = chosen
        self._names: dict[str, Names] = {}
        self.units = given.units

    @property
    def rows(self) -> int:
        """Number of rows of a step."""
        return len(self._chosen)

    @abstractmethod
    def columns(self, part: Part) -> list[Column]:
        """Return the columns of the contract, then others."""

    def facts(self) -> list[Column]:
        """Return the columns that no step changes, and the law, also of elements whose curve is cut at some steps."""
        return [
            Column(name, values, self._names.get(name, ()), over_steps=False, unit=quantity.unit_name(self.units))
            for name, quantity in self.quantities.items()
            if (values := self._fixed.get(name)) is not None
        ]

    def _columns(self, given: dict[str, Values], result: ContactResult) -> list[Column]:
        """A column of each quantity: fixed, given, or what the result has of its name."""
        values = self._fixed | given
        return [
            Column(
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


class ElementTable(Table):
    """The evaluated elements.

    `others` are columns besides those of the contract, by name: values (m,) of all elements for each step asked for.
    """

    quantities = ELEMENTS

    def __init__(self, given: ContactInput, chosen: IndexArray, others: Others | None = None) -> None:
        super().__init__(given, chosen)
        self._others = others
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

    def columns(self, part: Part) -> list[Column]:
        """Return the columns of the contract, then the others."""
        result = part.result
        ends = [_places(result, column) for column in self._ends.T]
        values: dict[str, Values] = {
            **{axis: 0.5 * (ends[0][..., i] + ends[1][..., i]) for i, axis in enumerate("xyz")},
            "state": codes_of(result.state, self._chosen),
        }
        if self._may_cut:
            values["law"] = np.where(kept(result.cut, self._chosen), self._cut_code, self._fixed["law"])
        found = self._columns(values, result)
        others = () if self._others is None else self._others(part)
        return found + [Column(name, kept(values, self._chosen)) for name, values in others]


class NodeTable(Table):
    """The nodes that have a position. Without friction its forces are 0 and its states none."""

    quantities = NODES

    def __init__(self, given: ContactInput, chosen: IndexArray) -> None:
        super().__init__(given, chosen)
        self._fixed = {
            "node": given.node_ids[chosen],
            "arc_length": given.lines.node_arc[chosen],
            "line": given.lines.of_node[chosen] + 1,
        }

    def columns(self, part: Part) -> list[Column]:
        """Return the columns of the contract."""
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
        """One row of nodes where all points of the seabed share a normal."""
        return kept(normal, self._chosen) if any(normal.strides[:2]) else np.array(normal[0, self._chosen])

    def _force(self, force: Values | None) -> Values:
        return np.zeros(self.rows) if force is None else kept(force, self._chosen)


def by_number(given: ContactInput, present: BoolArray) -> IndexArray:
    """Return the indices of the nodes that have a position, in ascending order of their numbers."""
    found = np.flatnonzero(present)
    return found[given.node_ids[found].argsort(kind="stable")]


def coded(texts: Sequence[str | None]) -> tuple[NDArray[np.int32], Names]:
    """Texts as indices of the different ones; -1 is None, which stands at the end of the names."""
    number: dict[str | None, int] = {}
    for text in texts:
        if text is not None:
            number.setdefault(text, len(number))
    names = (*number, None)
    number[None] = -1
    return np.array([number[text] for text in texts], dtype=np.int32).reshape(len(texts)), names


def _places(result: ContactResult, nodes: IndexArray) -> FloatArray:
    """The positions (steps, k, 3) of some nodes."""
    if result.positions is None:
        return np.full((len(result.depth), len(nodes), 3), np.nan)
    return np.asarray(result.positions[:, nodes], np.float64)


def codes_of(states: Values | None, chosen: NDArray[np.intp]) -> Values:
    """The states of those elements or nodes; none where no law has states."""
    return np.full(len(chosen), -1, np.int8) if states is None else kept(states, chosen)


def kept(array: Values, chosen: NDArray[np.intp]) -> Values:
    """The columns (steps, k, ...) of those elements or nodes that have a position; no copy when all have one."""
    return array if array.shape[1] == len(chosen) else array[:, chosen]


def _by_direction(values: Values | None) -> tuple[Values | None, Values | None]:
    return (None, None) if values is None else (values[..., 0], values[..., 1])
