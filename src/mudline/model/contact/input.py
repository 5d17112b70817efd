"""What the evaluator is given: nodes, elements, and the laws of each, as plain arrays; errors that name them."""

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
    """A node's position or velocity is not finite, or what follows from it there overflows.

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
    """An element has no usable law, or a value of it overflows.

    Attributes:
        element: the element's id.
        step: the time step, from 0; None when it is the input that is wrong.
    """

    def __init__(self, message: str, element: int, step: int | None = None) -> None:
        super().__init__(message)
        self.element = element
        self.step = step

    def __reduce__(self) -> tuple[type[ElementError], tuple[str, int, int | None]]:
        return type(self), (str(self), self.element, self.step)


class LawKind(IntEnum):
    """The normal law of an element, as results name it."""

    NONE = 0
    """No restraint."""
    CURVE = 1
    """Force per unit length over embedment ratio."""
    LINEAR = 2
    """Force per unit length proportional to penetration, maybe with a quadratic zone."""
    RIGID = 3
    """A constraint, not a spring."""
    NODAL = 4
    """Springs of its nodes; no force per unit length of its own."""
    SOIL = 6
    """A hysteretic soil, whose force follows a path."""
    OTHER = 5
    """A law that was registered."""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class LawAssignment:
    """A law of some elements or nodes.

    Attributes:
        law: name of the law, see `mudline.model.contact.laws`.
        rows: (k,) indices of elements, or of nodes for a law of nodes.
        parameters: value of each parameter, a number or an array (k,); those left out have their defaults.
    """

    law: str
    rows: IndexArray
    parameters: Mapping[str, ArrayLike] = field(default_factory=dict)

    __repr__ = short_repr


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class AssignedLaw:
    """All rows of an input that have a law, ascending, with every parameter as an array (k,) of floats."""

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
        """What the plan says of it."""
        plan = self.law.plan or f"with {self.law.summary}"
        return (
            f"{counted(len(self.rows), self.law.acts_on[:-1])} {plan}"
            if isinstance(plan, str)
            else plan(self.parameters)
        )

    def spread(self, name: str, count: int, otherwise: float = np.nan) -> FloatArray:
        """Return a parameter for all of `count` elements or nodes, `otherwise` where there is no such law."""
        found = np.full(count, otherwise)
        found[self.rows] = self.parameters[name]
        return found


class Names(Protocol):
    """What the laws of elements are called, and in which units all is: what tables of results say beside numbers."""

    @property
    def units(self) -> str:
        """The unit system: "metric", "imperial" or "user"."""

    @property
    def source(self) -> str:
        """The deck."""

    @property
    def law_names(self) -> Sequence[str]:
        """(m,) `curve:NAME`, `linear`, `nodal`, `soil`, `rigid` or `none`."""

    @property
    def law_sets(self) -> Sequence[str | None]:
        """(m,) the set through which each element got its law."""


_WEIGHTS = ("weight", "empty_weight")


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class ContactInput:
    """Nodes (n), elements (m) and their laws. The arrays are not copied; do not change them.

    Attributes:
        node_ids: (n,) numbers of the nodes, for messages.
        coordinates: (n, 3) positions evaluated when no others are given, X up.
        element_ids: (m,) numbers of the elements, for messages.
        element_nodes: (m, 2) indices of each element's nodes in `node_ids`.
        length: (m,) unstretched lengths, >= 0.
        diameter: (m,) external diameters, > 0, or NaN where there is none.
        laws: which elements and nodes have which laws, with which parameters; an element has one normal law at most.
        curves: what the parameter of the law "curve" points to.
        tables: what that of the law "trench table" points to: (rows, 2) distance from the centreline, ascending, and
            lateral resistance per unit length; maybe a third column, see `laws.trench`.
        tension: what happens where a curve pulls: "keep" its negative force, or "cut" force and stiffness to 0.
        seabed: its shape; None for a flat one at X = 0.
        weight: (m,) submerged weights per unit length, NaN where unknown; None when none is. Forces do without them.
        empty_weight: (m,) the same without contents and without masses at nodes; None where that is the same.
        left_out: reasons, by stage of the plan, why something the scene asks for is not evaluated.
        names: what the laws, sets and units are called; None where nobody said.

    Raises:
        ValueError: an array has the wrong shape or kind, an index points nowhere, or there is no law of a name.
        ElementError: an element's law lacks what it needs, or has a parameter out of its range.
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
    names: Names | None = None
    _lines: list[Lines] = field(init=False, repr=False, default_factory=list)
    assigned: dict[str, AssignedLaw] = field(init=False, repr=False)
    """The laws that some element or node has, by name."""

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
            if (given := getattr(self, name)) is not None:
                _expect(given, name, "f", (elements,))
        expect_word(self.tension, "tension", ("keep", "cut"), "'keep' or 'cut'")
        self._check_elements(nodes)
        names = dict.fromkeys(assignment.law for assignment in self.laws)
        found = {name: self._assigned(name) for name in names}
        object.__setattr__(self, "assigned", {name: given for name, given in found.items() if len(given.rows)})
        self._check_normal()

    @property
    def lines(self) -> Lines:
        """The lines that the elements form; found when they are first asked for."""
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
        """The name of each element's law (m,): `curve:NAME`, or that of its `LawKind`."""
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
        """The set (m,) through which each element got its law; None where nobody said."""
        return [None] * len(self.element_ids) if self.names is None else self.names.law_sets

    def has(self, *names: str) -> bool:
        """Whether some element or node has one of these laws."""
        return any(name in self.assigned for name in names)

    @property
    def needs_velocities(self) -> list[str]:
        """Names of the laws that ask for velocities along the normals."""
        return [name for name, given in self.assigned.items() if given.law.velocities]

    @property
    def normal_laws(self) -> list[AssignedLaw]:
        """The normal laws of elements that are there, a rigid seabed left out."""
        return [given for given in self.assigned.values() if _is_normal(given, "elements")]

    @property
    def _restrained(self) -> list[AssignedLaw]:
        """Normal laws of elements, a rigid seabed included."""
        return [*self.normal_laws, *(given for name, given in self.assigned.items() if name == "rigid")]

    @property
    def nodal_laws(self) -> list[AssignedLaw]:
        """The normal laws of nodes that are there."""
        return [given for given in self.assigned.values() if _is_normal(given, "nodes")]

    @property
    def law(self) -> NDArray[np.int8]:
        """`LawKind` of each element (m,)."""
        found = np.zeros(len(self.element_ids), np.int8)
        found[self._nodal_elements()] = LawKind.NODAL
        for given in self._restrained:
            found[given.rows] = _kind(given.law.name)
        return found

    @property
    def curve_index(self) -> IndexArray:
        """Curve of each element (m,), -1 for those that have none."""
        found = np.full(len(self.element_ids), -1, np.intp)
        if (given := self.assigned.get("curve")) is not None:
            found[given.rows] = given["curve"].astype(np.intp)
        return found

    def onset(self) -> FloatArray:
        """Return the penetration (m,) from which on each element is in contact: 0, or where its zone begins.

        An element whose law is that of its nodes begins where the first of their zones does.
        """
        found = np.zeros(len(self.element_ids))
        at_nodes = np.zeros(len(self.node_ids))
        for given in self.nodal_laws:
            at_nodes[given.rows] = _onset(given)
        nodal = self._nodal_elements()
        found[nodal] = at_nodes[self.element_nodes[nodal]].min(axis=1, initial=0.0)
        for given in self.normal_laws:
            found[given.rows] = _onset(given)
        return found

    def _nodal_elements(self) -> IndexArray:
        """Elements without a normal law of their own whose two nodes have one."""
        sprung = np.zeros(len(self.node_ids), np.bool_)
        for given in self.nodal_laws:
            sprung[given.rows] = True
        held = np.logical_and(*sprung[self.element_nodes].T)
        for given in self._restrained:
            held[given.rows] = False
        return np.flatnonzero(held)

    def _assigned(self, name: str) -> AssignedLaw:
        """All rows of a law, checked."""
        law = law_named(name)
        parts = [assignment for assignment in self.laws if assignment.law == name]
        count = len(self.element_ids if law.acts_on == "elements" else self.node_ids)
        rows = np.concatenate([_rows(part, count) for part in parts])
        order = np.argsort(rows, kind="stable")
        rows = rows[order]
        self._refuse_first(law, rows[1:], rows[1:] == rows[:-1], f"has two {name} laws")
        columns = [_columns(law, part) for part in parts]
        found = {each.name: np.concatenate([part[each.name] for part in columns])[order] for each in law.parameters}
        for each in law.parameters:
            wrong = each.invalid(found[each.name])
            value = float(found[each.name][np.argmax(wrong)]) if wrong.any() else 0.0
            what = f"has a {name} law whose {each.name.replace('_', ' ')} is {value!r}; expected {each.valid_range}"
            self._refuse_first(law, rows, wrong, what)
        if law.check is not None:
            bad, what = law.check(found)
            self._refuse_first(law, rows, bad, f"has a {name} law: {what}")
        if law.tables:
            index, held = ("curve", len(self.curves)) if isinstance(law, NormalLaw) else ("table", len(self.tables))
            missing = (found[index] >= held) | (found[index] % 1.0 != 0.0)
            self._refuse_first(law, rows, missing, f"has a {index} that does not exist")
        if law.needs_diameter:
            self._refuse_first(law, rows, np.isnan(self.diameter[rows]), f"has a {name} law and no diameter")
        return AssignedLaw(law, rows, found)

    def _check_elements(self, nodes: int) -> None:
        first, second = ((ends >= 0) & (ends < nodes) for ends in self.element_nodes.T)
        self._require(first & second, "has a node that does not exist")
        self._require(np.isfinite(self.length) & (self.length >= 0.0), "has no usable length")
        usable = np.isfinite(self.diameter) & (self.diameter > 0.0)
        self._require(usable | np.isnan(self.diameter), "has a diameter that is not positive and finite")

    def _check_normal(self) -> None:
        for laws in (self._restrained, self.nodal_laws):
            if len(laws) > 1:
                rows = np.sort(np.concatenate([given.rows for given in laws]))
                self._refuse_first(laws[0].law, rows[1:], rows[1:] == rows[:-1], "has two normal laws")

        for given in self.normal_laws:
            for name in ("unloading", "suction") if isinstance(given.law, PathLaw) else ():
                beside = self.assigned[name].rows if name in self.assigned else np.zeros(0, np.intp)
                what = f"has a {given.law.name} law, which has its own {name}, and a law of {name} beside it"
                self._refuse_first(given.law, given.rows, np.isin(given.rows, beside), what)

    def _require(self, holds: BoolArray, otherwise: str) -> None:
        broken = np.flatnonzero(~holds)
        if broken.size:
            element = int(self.element_ids[broken[0]])
            raise ElementError(f"element {element} {otherwise}", element)

    def _refuse_first(self, law: Law, rows: IndexArray, wrong: BoolArray, what: str) -> None:
        """Raise for the first of the rows of a law that is wrong, if there is one."""
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


def _is_normal(given: AssignedLaw, acts_on: str) -> bool:
    return isinstance(given.law, NormalLaw) and given.law.acts_on == acts_on


def _onset(given: AssignedLaw) -> FloatArray:
    law = given.law
    return np.asarray(law.onset(*given.columns)) if isinstance(law, NormalLaw) else np.zeros(len(given.rows))


def _rows(assignment: LawAssignment, count: int) -> IndexArray:
    rows = np.asarray(assignment.rows)
    if rows.ndim != 1 or (rows.dtype.kind not in "iu" and rows.size) or ((rows < 0) | (rows >= count)).any():
        raise ValueError(f"the rows of the law {assignment.law!r} must be indices from 0 to {count - 1}")
    return rows.astype(np.intp)


def _columns(law: Law, assignment: LawAssignment) -> dict[str, FloatArray]:
    """The parameters of an assignment as arrays (k,); a value of -0.0 is 0.0."""
    unknown = set(assignment.parameters) - {each.name for each in law.parameters}
    if unknown:
        expected = ", ".join(each.name for each in law.parameters) or "none"
        raise ValueError(f"the law {law.name!r} has no parameter {min(unknown)!r}; it has {expected}")
    found = {}
    for each in law.parameters:
        value = assignment.parameters.get(each.name, each.default)
        if value is None:
            raise ValueError(f"the law {law.name!r} needs the parameter {each.name!r}")
        given = np.asarray(value)
        if given.dtype.kind not in "biuf" or given.shape not in ((), (len(assignment.rows),)):
            shape = f"({len(assignment.rows)},)"
            raise ValueError(f"{each.name} of the law {law.name!r} must be numbers of shape {shape}, not {given.shape}")
        found[each.name] = np.broadcast_to(given, (len(assignment.rows),)) + 0.0
    return found


def _expect(array: NDArray[np.generic], name: str, kinds: str, shape: tuple[int, ...]) -> None:
    if array.shape != shape or array.dtype.kind not in kinds:
        what = {"f": "floats", "b": "booleans"}.get(kinds, "integers")
        raise ValueError(f"{name} must be {what} of shape {shape}, not {array.dtype} of shape {array.shape}")
