"""Input of the evaluator: nodes, elements and their laws as plain arrays; errors that name an element or a node."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import IntEnum
from typing import TYPE_CHECKING, Literal, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mudline.basics.arguments import expect, expect_word, read_only
from mudline.basics.short_repr import counted, short_repr
from mudline.model.contact.arrays import BoolArray, FloatArray, IdArray, IndexArray
from mudline.model.contact.laws import BUILT_IN, Law, NormalLaw, PathLaw, law_named

if TYPE_CHECKING:  # a scene without curves does not load them, nor does a flat seabed load other shapes
    from mudline.model.contact.lines import Lines
    from mudline.model.contact.seabed import Seabed
    from mudline.model.curves import ForceCurve

Tension = Literal["keep", "cut"]


class PositionError(ValueError):
    """A position or a velocity is not finite, or a value computed from it overflows.

    Attributes:
        node: the node's id.
        step: the time step, from 0.
    """

    def __init__(self, message: str, node: int, step: int) -> None:
        super().__init__(message)
        self.node = node
        self.step = step

    def __reduce__(self) -> tuple[type[PositionError], tuple[str, int, int]]:
        return type(self), (str(self), self.node, self.step)


class ElementError(ValueError):
    """An element has no usable law, or a value of the element overflows.

    Attributes:
        element: the element's id.
        step: the time step, from 0; None if the input is wrong.
    """

    def __init__(self, message: str, element: int, step: int | None = None) -> None:
        super().__init__(message)
        self.element = element
        self.step = step

    def __reduce__(self) -> tuple[type[ElementError], tuple[str, int, int | None]]:
        return type(self), (str(self), self.element, self.step)


class LawKind(IntEnum):
    """The normal law of an element, as named in results."""

    NONE = 0
    """No restraint."""
    CURVE = 1
    """Force per unit length over embedment ratio."""
    LINEAR = 2
    """Force per unit length proportional to penetration, optionally with a quadratic zone."""
    RIGID = 3
    """A constraint, not a spring."""
    NODAL = 4
    """Springs of its nodes; no force per unit length of its own."""
    SOIL = 6
    """A hysteretic soil, whose force follows a path."""
    OTHER = 5
    """A registered law."""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class LawAssignment:
    """A law and the elements or nodes that follow it.

    Attributes:
        law: name of the law, see `mudline.model.contact.laws`.
        rows: (k,) indices of elements, or of nodes for a law of nodes.
        parameters: value of each parameter, a number or an array (k,); a missing parameter has its default.
    """

    law: str
    rows: IndexArray
    parameters: Mapping[str, ArrayLike] = field(default_factory=dict)

    __repr__ = short_repr


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class AssignedLaw:
    """All rows of an input that follow a law, ascending, with every parameter as an array (k,) of floats."""

    law: Law
    rows: IndexArray
    parameters: dict[str, FloatArray]

    __repr__ = short_repr

    def __getitem__(self, name: str) -> FloatArray:
        return self.parameters[name]

    @property
    def columns(self) -> tuple[FloatArray, ...]:
        """The parameters in the order in which the law declares them."""
        return tuple(self.parameters[parameter.name] for parameter in self.law.parameters)

    @property
    def planned(self) -> str:
        """Return the text of the plan about this law."""
        plan = self.law.plan or f"with {self.law.summary}"
        return (
            f"{counted(len(self.rows), self.law.acts_on[:-1])} {plan}"
            if isinstance(plan, str)
            else plan(self.parameters)
        )

    def at(self, places: IndexArray) -> tuple[IndexArray, dict[str, FloatArray]]:
        """Return new rows and parameters of the rows that have a place >= 0 among the `places` of all."""
        kept = places[self.rows] >= 0
        return places[self.rows[kept]], {name: values[kept] for name, values in self.parameters.items()}

    def spread(self, name: str, count: int, otherwise: float = np.nan) -> FloatArray:
        """Return a parameter for all of `count` elements or nodes, `otherwise` where the law does not apply."""
        values = np.full(count, otherwise)
        values[self.rows] = self.parameters[name]
        return values


class InputNames(Protocol):
    """Names of the laws of elements, and the unit system, for tables of results."""

    @property
    def units(self) -> str:
        """The unit system: "metric", "imperial" or "user"."""

    @property
    def source(self) -> str:
        """Name of the deck."""

    @property
    def law_names(self) -> Sequence[str]:
        """(m,) `curve:NAME`, or the name of another `LawKind` in lower case."""

    @property
    def law_sets(self) -> Sequence[str | None]:
        """(m,) the set that assigned each element's law."""


_WEIGHTS = ("weight", "empty_weight")


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class ContactInput:
    """Nodes (n), elements (m) and their laws. The arrays are not copied; do not change them.

    Attributes:
        node_ids: (n,) numbers of the nodes, for messages.
        coordinates: (n, 3) positions evaluated when `evaluate` is called without positions, X up.
        element_ids: (m,) numbers of the elements, for messages.
        element_nodes: (m, 2) indices of each element's nodes in `node_ids`.
        length: (m,) unstretched lengths, >= 0.
        diameter: (m,) external diameters, > 0, or NaN if unknown.
        laws: laws of elements and nodes with their parameters; an element has at most one normal law.
        curves: curves that the parameter of the law "curve" indexes.
        tables: tables that the parameter of the law "trench table" indexes: (rows, 2) distance from the centreline,
            ascending, and lateral resistance per unit length; optionally a third column, see `laws.trench`.
        tension: "keep" a curve's negative force, or "cut" force and stiffness to 0 there.
        seabed: shape of the seabed; None for a flat seabed at X = 0.
        weight: (m,) submerged weights per unit length, NaN where unknown; None if all are. Forces do not need them.
        empty_weight: (m,) weights without contents, with masses at nodes; None if these equal `weight`.
        left_out: reasons, by stage of the plan, why a law of the scene is not evaluated.
        names: names of laws and sets, and the unit system; None if unknown.

    Raises:
        ValueError: an array has the wrong shape or type, an index is out of range, or a law does not exist.
        ElementError: a parameter of an element's law is missing or out of range.
    """

    node_ids: IdArray
    coordinates: FloatArray
    element_ids: IdArray
    element_nodes: IndexArray
    length: FloatArray
    diameter: FloatArray
    laws: tuple[LawAssignment, ...] = ()
    curves: tuple[ForceCurve, ...] = ()
    tables: tuple[FloatArray, ...] = ()
    tension: Tension = "keep"
    seabed: Seabed | None = None
    weight: FloatArray | None = None
    empty_weight: FloatArray | None = None
    left_out: Mapping[str, str] = field(default_factory=dict)
    names: InputNames | None = None
    _lines: list[Lines] = field(init=False, repr=False, default_factory=list)
    assigned: dict[str, AssignedLaw] = field(init=False, repr=False)
    """The laws of the elements and nodes, by name."""

    __repr__ = short_repr

    def __post_init__(self) -> None:
        arrays = ("node_ids", "coordinates", "element_ids", "element_nodes", "length", "diameter")
        for name in (*arrays, *_WEIGHTS):
            if (array := getattr(self, name)) is not None or name not in _WEIGHTS:
                expect(array, name, np.ndarray, "an array")
                object.__setattr__(self, name, read_only(array))
        for name, kind in (("laws", LawAssignment), ("curves", object), ("tables", np.ndarray)):
            expect(getattr(self, name), name, (tuple, list), "a tuple")
            for each in getattr(self, name):
                expect(each, f"each of {name}", kind, f"a {kind.__name__}")
        nodes, elements = self.node_ids.size, self.element_ids.size
        _expect(self.node_ids, "node_ids", "iu", (nodes,))
        _expect(self.coordinates, "coordinates", "f", (nodes, 3))
        _expect(self.element_ids, "element_ids", "iu", (elements,))
        _expect(self.element_nodes, "element_nodes", "iu", (elements, 2))
        for name in ("length", "diameter"):
            _expect(getattr(self, name), name, "f", (elements,))
        for name in _WEIGHTS:
            if (weights := getattr(self, name)) is not None:
                _expect(weights, name, "f", (elements,))
        expect_word(self.tension, "tension", ("keep", "cut"), "'keep' or 'cut'")
        self._check_elements(nodes)
        names = dict.fromkeys(assignment.law for assignment in self.laws)
        assigned = {name: self._assigned(name) for name in names}
        object.__setattr__(self, "assigned", {name: law for name, law in assigned.items() if len(law.rows)})
        self._check_normal()

    @property
    def lines(self) -> Lines:
        """The lines that the elements form, computed at the first use."""
        if not self._lines:
            from mudline.model.contact.lines import lines_of  # noqa: PLC0415 - forces alone do without it

            self._lines.append(lines_of(self.element_nodes, self.length, len(self.node_ids)))
        return self._lines[0]

    @property
    def units(self) -> str:
        """The unit system: "metric", "imperial" or "user"."""
        return "user" if self.names is None else self.names.units

    @property
    def law_names(self) -> Sequence[str]:
        """The name of each element's law (m,), see `InputNames`."""
        if self.names is not None:
            return self.names.law_names
        curves = [f"curve:{curve.name}" for curve in self.curves]
        kinds, at = self.law.tolist(), self.curve_index.tolist()
        return [
            curves[curve] if kind == LawKind.CURVE else LawKind(kind).name.lower()
            for kind, curve in zip(kinds, at, strict=True)
        ]

    @property
    def law_sets(self) -> Sequence[str | None]:
        """The set (m,) that assigned each element's law; None where unknown."""
        return [None] * len(self.element_ids) if self.names is None else self.names.law_sets

    def has(self, *names: str) -> bool:
        """Return True if an element or node follows one of these laws."""
        return any(name in self.assigned for name in names)

    @property
    def needs_velocities(self) -> list[str]:
        """Names of the laws that need velocities along the normals."""
        return [name for name, assigned in self.assigned.items() if assigned.law.velocities]

    @property
    def normal_laws(self) -> list[AssignedLaw]:
        """The normal laws of elements, without the rigid seabed."""
        return [assigned for assigned in self.assigned.values() if _is_normal(assigned, "elements")]

    @property
    def _restrained(self) -> list[AssignedLaw]:
        """Normal laws of elements, a rigid seabed included."""
        return [*self.normal_laws, *(assigned for name, assigned in self.assigned.items() if name == "rigid")]

    @property
    def nodal_laws(self) -> list[AssignedLaw]:
        """The normal laws of nodes."""
        return [assigned for assigned in self.assigned.values() if _is_normal(assigned, "nodes")]

    @property
    def law(self) -> NDArray[np.int8]:
        """`LawKind` of each element (m,)."""
        kinds = np.zeros(len(self.element_ids), np.int8)
        kinds[self._nodal_elements()] = LawKind.NODAL
        for assigned in self._restrained:
            kinds[assigned.rows] = _kind(assigned.law.name)
        return kinds

    @property
    def curve_index(self) -> IndexArray:
        """Curve of each element (m,), -1 for an element without a curve."""
        curves = np.full(len(self.element_ids), -1, np.intp)
        if (assigned := self.assigned.get("curve")) is not None:
            curves[assigned.rows] = assigned["curve"].astype(np.intp)
        return curves

    def onset(self) -> FloatArray:
        """Return the penetration (m,) at which each element comes into contact: 0, or the onset of its quadratic zone.

        An element with springs at its nodes has the smaller onset of its two nodes.
        """
        onsets = np.zeros(len(self.element_ids))
        at_nodes = np.zeros(len(self.node_ids))
        for assigned in self.nodal_laws:
            at_nodes[assigned.rows] = _onset(assigned)
        nodal = self._nodal_elements()
        onsets[nodal] = at_nodes[self.element_nodes[nodal]].min(axis=1, initial=0.0)
        for assigned in self.normal_laws:
            onsets[assigned.rows] = _onset(assigned)
        return onsets

    def _nodal_elements(self) -> IndexArray:
        """Return the elements without a normal law of their own whose two nodes have springs."""
        sprung = np.zeros(len(self.node_ids), np.bool_)
        for assigned in self.nodal_laws:
            sprung[assigned.rows] = True
        held = np.logical_and(*sprung[self.element_nodes].T)
        for assigned in self._restrained:
            held[assigned.rows] = False
        return np.flatnonzero(held)

    def _assigned(self, name: str) -> AssignedLaw:
        """Return all rows of a law with their checked parameters; raise ValueError or ElementError."""
        law = law_named(name)
        parts = [assignment for assignment in self.laws if assignment.law == name]
        count = len(self.element_ids if law.acts_on == "elements" else self.node_ids)
        rows = np.concatenate([_rows(part, count) for part in parts])
        order = np.argsort(rows, kind="stable")
        rows = rows[order]
        self._refuse_first(law, rows[1:], rows[1:] == rows[:-1], f"has two {name} laws")
        columns = [_columns(law, part) for part in parts]
        values = {each.name: np.concatenate([part[each.name] for part in columns])[order] for each in law.parameters}
        for each in law.parameters:
            wrong = each.invalid(values[each.name])
            value = float(values[each.name][np.argmax(wrong)]) if wrong.any() else 0.0
            what = f"has a {name} law whose {each.name.replace('_', ' ')} is {value!r}; expected {each.valid_range}"
            self._refuse_first(law, rows, wrong, what)
        if law.check is not None:
            bad, what = law.check(values)
            self._refuse_first(law, rows, bad, f"has a {name} law: {what}")
        if law.tables:
            index, size = ("curve", len(self.curves)) if isinstance(law, NormalLaw) else ("table", len(self.tables))
            missing = (values[index] >= size) | (values[index] % 1.0 != 0.0)
            self._refuse_first(law, rows, missing, f"has a {index} that does not exist")
        if law.needs_diameter:
            self._refuse_first(law, rows, np.isnan(self.diameter[rows]), f"has a {name} law and no diameter")
        return AssignedLaw(law, rows, values)

    def _check_elements(self, nodes: int) -> None:
        first, second = ((ends >= 0) & (ends < nodes) for ends in self.element_nodes.T)
        self._require(first & second, "has a node that does not exist")
        self._require(np.isfinite(self.length) & (self.length >= 0.0), "has no usable length")
        usable = np.isfinite(self.diameter) & (self.diameter > 0.0)
        self._require(usable | np.isnan(self.diameter), "has a diameter that is not positive and finite")

    def _check_normal(self) -> None:
        for laws in (self._restrained, self.nodal_laws):
            if len(laws) > 1:
                rows = np.sort(np.concatenate([assigned.rows for assigned in laws]))
                self._refuse_first(laws[0].law, rows[1:], rows[1:] == rows[:-1], "has two normal laws")

        for assigned in self.normal_laws:
            for name in ("unloading", "suction") if isinstance(assigned.law, PathLaw) else ():
                also = self.assigned[name].rows if name in self.assigned else np.zeros(0, np.intp)
                what = f"has a {assigned.law.name} law, which has its own {name}, and an additional {name} law"
                self._refuse_first(assigned.law, assigned.rows, np.isin(assigned.rows, also), what)

    def _require(self, holds: BoolArray, otherwise: str) -> None:
        broken = np.flatnonzero(~holds)
        if broken.size:
            element = int(self.element_ids[broken[0]])
            raise ElementError(f"element {element} {otherwise}", element)

    def _refuse_first(self, law: Law, rows: IndexArray, wrong: BoolArray, what: str) -> None:
        """Raise ElementError or ValueError for the first wrong row of a law, if any."""
        if not wrong.any():
            return
        row = rows[np.argmax(wrong)]
        if law.acts_on == "nodes":
            raise ValueError(f"node {self.node_ids[row]} {what}")
        element = int(self.element_ids[row])
        raise ElementError(f"element {element} {what}", element)


def _kind(name: str) -> LawKind:
    known = LawKind.__members__ if name in BUILT_IN else {}
    return LawKind.LINEAR if name == "smoothed" else known.get(name.upper(), LawKind.OTHER)


def _is_normal(assigned: AssignedLaw, acts_on: str) -> bool:
    return isinstance(assigned.law, NormalLaw) and assigned.law.acts_on == acts_on


def _onset(assigned: AssignedLaw) -> FloatArray:
    law = assigned.law
    return np.asarray(law.onset(*assigned.columns)) if isinstance(law, NormalLaw) else np.zeros(len(assigned.rows))


def _rows(assignment: LawAssignment, count: int) -> IndexArray:
    rows = np.asarray(assignment.rows)
    if rows.ndim != 1 or (rows.dtype.kind not in "iu" and rows.size) or ((rows < 0) | (rows >= count)).any():
        raise ValueError(f"the rows of the law {assignment.law!r} must be indices from 0 to {count - 1}")
    return rows.astype(np.intp)


def _columns(law: Law, assignment: LawAssignment) -> dict[str, FloatArray]:
    """Return the parameters of an assignment as arrays (k,); -0.0 becomes 0.0."""
    unknown = set(assignment.parameters) - {each.name for each in law.parameters}
    if unknown:
        expected = ", ".join(each.name for each in law.parameters) or "none"
        raise ValueError(f"the law {law.name!r} has no parameter {min(unknown)!r}; it has {expected}")
    columns = {}
    for each in law.parameters:
        value = assignment.parameters.get(each.name, each.default)
        if value is None:
            raise ValueError(f"the law {law.name!r} needs the parameter {each.name!r}")
        array = np.asarray(value)
        if array.dtype.kind not in "biuf" or array.shape not in ((), (len(assignment.rows),)):
            shape = f"({len(assignment.rows)},)"
            raise ValueError(f"{each.name} of the law {law.name!r} must be numbers of shape {shape}, not {array.shape}")
        columns[each.name] = np.broadcast_to(array, (len(assignment.rows),)) + 0.0
    return columns


def _expect(array: NDArray[np.generic], name: str, kinds: str, shape: tuple[int, ...]) -> None:
    if array.shape != shape or array.dtype.kind not in kinds:
        what = {"f": "floats", "b": "booleans"}.get(kinds, "integers")
        raise ValueError(f"{name} must be {what} of shape {shape}, not {array.dtype} of shape {array.shape}")
