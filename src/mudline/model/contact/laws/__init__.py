"""The contact laws: each module has one kind of law, with parameters, equation, tangents, state and source.

A law is found by its name and imported when an input has it. `register` adds a normal law from your own module: it is
evaluated, stepped, planned and differentiated like the others, with numpy and with compiled loops.

The functions of a law are expressions: they take floats (in compiled loops) and arrays (in numpy) alike and give the
same bits for both, as long as they use only `+ - * /`, comparisons, `&`, `|`, `np.maximum`, `np.minimum`, `np.abs`,
`np.sqrt`, `np.nextafter`, `np.float_power` (not `**`, which numpy computes with code of its own) and `where` (not
`np.where`). A loop may end when `every` number would stay unchanged.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache
from importlib import import_module
from types import ModuleType
from typing import Any, Literal, NamedTuple, SupportsIndex

import numpy as np

from mudline.basics.short_repr import short_repr
from mudline.model.contact.arrays import BoolArray, FloatArray, IndexArray

Value = Any
"""A float or an array of floats, as arguments and results of expressions."""
Reaction = Callable[..., tuple[Value, Value]]


def where(condition: Value, value: Value, otherwise: Value) -> Value:
    """Return `value` where the condition holds, else `otherwise`; for numbers and for arrays."""
    return np.where(condition, value, otherwise)


def every(condition: Value) -> bool:
    """Return True if a condition holds, for all elements of an array."""
    return bool(np.all(condition))


class Reached(NamedTuple):
    """Extreme conditions of the rows (k,) of a law that is no normal law, for its largest stiffness and damping.

    Attributes:
        virgin: of elements: the steepest stiffness of their normal laws.
        speed: of elements: pull-out velocities (..., k) >= 0; None for any velocity.
        normal_force: of nodes: the largest normal force, NaN where unknown.
        lateral: of nodes: the coefficient of their lateral friction.
        walls: whether trenches add to the limits of friction.
    """

    virgin: FloatArray
    speed: FloatArray | None
    normal_force: FloatArray
    lateral: FloatArray
    walls: bool

    def of_rows(self, rows: IndexArray, acts_on: str) -> Reached:
        """Return some rows of all elements, or of all nodes."""
        if acts_on == "nodes":
            return self._replace(normal_force=self.normal_force[rows], lateral=self.lateral[rows])
        return self._replace(virgin=self.virgin[rows], speed=None if self.speed is None else self.speed[..., rows])


class Moving(NamedTuple):
    """Motion of the rows (k,) of a law in a step, for its damping there.

    Attributes:
        z: penetration.
        v: pull-out velocity.
        uplift: height above the point where the reaction of the seabed vanishes.
        before, after: histories of suction.
    """

    z: FloatArray
    v: FloatArray
    uplift: FloatArray
    before: Any
    after: Any


class Parameter(NamedTuple):
    """A parameter of a law: one number per element or node.

    Attributes:
        name: its name in `LawAssignment.parameters`.
        unit: powers of force F, length L and time T; 1 for none.
        meaning: description.
        low: least value.
        above: whether the least value itself is excluded.
        high: largest value, included if finite.
        default: value of a missing parameter; None if it is mandatory.
        optional: whether NaN is allowed and means "none".
    """

    name: str
    unit: str
    meaning: str
    low: float = 0.0
    above: bool = False
    high: float = np.inf
    default: float | None = None
    optional: bool = False

    @property
    def valid_range(self) -> str:
        """The range in words."""
        if np.isinf(self.low):
            return "a finite number"
        least = f"{'> ' if self.above else '>= '}{self.low:g}"
        if np.isinf(self.high):
            return least
        most = f"{self.high:g}"
        return f"{least} and {'<' if float(most) > self.high else '<='} {most}"

    def invalid(self, values: FloatArray) -> BoolArray:
        """Return which values (k,) are out of range."""
        with np.errstate(invalid="ignore"):
            allowed = np.isfinite(values) & (values <= self.high)
            allowed &= (values > self.low) if self.above else (values >= self.low)
        invalid: BoolArray = ~allowed
        return invalid & ~np.isnan(values) if self.optional else invalid


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class Law:
    """A contact law.

    Attributes:
        name: name in assignments, plans and tables.
        summary: description in a few words.
        stage: the stage of the plan that evaluates it.
        acts_on: whether its rows are elements or nodes.
        parameters: parameters of each row.
        needs_diameter: whether an element needs an external diameter.
        velocities: whether a step needs velocities along the normals.
        history: whether the result of a step depends on earlier steps.
        tables: whether it uses curves or tables; a parameter is then the index of one.
        check: (parameters by name) to the rows whose parameters contradict each other, and the fault in words.
        state: field of `ContactState` with its history; "" without.
        initial: (rows, number of all elements or nodes, parameters by name) to the history before the first step.
        damping: (`Moving`, parameters by name) to minus d force / d pull-out velocity of each row, for tangents.
        plan: text of the plan after the number of rows, or a function of the parameters by name to the whole text. ""
            means "with" and the summary, for a normal law its name too; None no text.
        largest: (`Reached`, parameters by name) to the largest stiffness and the largest damping of each row, for laws
            other than normal laws; None for no damping.
        equation: equation in one line.
        source: publication of the equation.
    """

    name: str
    summary: str
    acts_on: Literal["elements", "nodes"]
    parameters: tuple[Parameter, ...]
    stage: str = "normal law"
    needs_diameter: bool = False
    velocities: bool = False
    history: bool = False
    tables: bool = False
    check: Callable[[dict[str, FloatArray]], tuple[BoolArray, str]] | None = None
    plan: str | Callable[[dict[str, FloatArray]], str] | None = ""
    largest: Callable[[Reached, dict[str, FloatArray]], tuple[FloatArray, FloatArray | None]] | None = None
    state: str = ""
    initial: Callable[[IndexArray, int, dict[str, FloatArray]], Any] | None = None
    damping: Callable[[Moving, dict[str, FloatArray]], FloatArray] | None = None
    equation: str = ""
    source: str = ""

    __repr__ = short_repr

    def __reduce_ex__(self, protocol: SupportsIndex) -> str | tuple[Any, ...]:
        """Pickle a law of this package by its name, as some of its functions cannot be pickled."""
        return (law_named, (self.name,)) if self.name in BUILT_IN else object.__reduce_ex__(self, protocol)


def _no_equation(*_: Value) -> Any:  # noqa: ANN401 - in place of any equation
    """Raise TypeError for a law whose reaction comes from tables."""
    raise TypeError("the law has no equation")


def _never(*parameters: Value) -> Value:
    """Return 0: contact begins at the mudline."""
    return 0.0 * parameters[0]


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class NormalLaw(Law):
    """A law of the reaction along the normal of the seabed, without history.

    Attributes:
        reaction: (penetration z, diameter D, *parameters) to force and stiffness d force / d z, per unit length for a
            law of elements, of the node for a law of nodes. It is called with z of any size and sign, and used where z
            > onset. Not for a law with tables.
        steepest: (z, D, *parameters) to the largest stiffness between the onset and z; z may be infinite.
        onset: (*parameters) to the penetration at which contact begins.
    """

    reaction: Reaction = field(default=_no_equation)
    steepest: Callable[..., Value] = field(default=_no_equation)
    onset: Callable[..., Value] = field(default=_never)

    __repr__ = short_repr


_AWAY = 2.0**-40
"""Relative size of a test increment of the penetration: small for the stiffness, large against rounding of forces."""


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class PathLaw(NormalLaw):
    """A normal law whose force depends on the path of an element.

    `reaction` and `steepest` are those of the first loading. An element has a memory of some numbers. The last of them
    is an event of its present branch, computed only when a step may reach it. A step to z = max(depth, 0) is `begin`,
    `locate` if `pending` requires it, and `advance`.

    Attributes:
        start: memory of an element that never touched the seabed.
        begin: (z, memory) to the memory, with a reversal if going to z is one.
        pending: (z, memory) to the number of the event that must be known, from 1 on, 0 for none.
        locate: for each event (D, memory, parameters) to its z.
        advance: (z, D, memory, parameters) to force, stiffness d force / d z of continued motion, and memory.
    """

    start: tuple[float, ...]
    begin: Callable[..., tuple[Value, ...]]
    pending: Callable[..., Value]
    locate: tuple[Callable[..., Value], ...]
    advance: Callable[..., tuple[Value, Value, tuple[Value, ...]]]

    __repr__ = short_repr

    def follow(
        self,
        depth: FloatArray,
        held: FloatArray,
        diameter: FloatArray,
        parameters: tuple[FloatArray, ...],
        out: tuple[FloatArray, FloatArray],
    ) -> None:
        """Write force and stiffness (steps, k) at depths of elements; update the memory `held` (k, c) in place."""
        count = len(self.start)
        memory = tuple(held[:, :count].T)
        for deep, force, stiffness in zip(depth, *out, strict=True):
            z = np.where(deep > 0.0, deep, 0.0)
            memory = self.begin(z, memory)
            pending = self.pending(z, memory)
            if pending.any():
                event = memory[-1].copy()
                for kind, locate in enumerate(self.locate, 1):
                    (rows,) = (pending == kind).nonzero()
                    here = tuple(values[rows] for values in memory), tuple(values[rows] for values in parameters)
                    event[rows] = locate(diameter[rows], *here)
                memory = (*memory[:-1], event)
            force[...], stiffness[...], memory = self.advance(z, diameter, memory, parameters)
        held[:, :count] = np.stack(memory, axis=1)

    def turned_round(self, held: FloatArray, diameter: FloatArray, parameters: tuple[FloatArray, ...]) -> FloatArray:
        """Return the stiffness (k,) of an increment opposite to the last, from the memory `held` (k, c)."""
        now = tuple(held[:, : len(self.start)].T)
        turns = self.begin(np.nextafter(now[0], np.inf), now)[2] != now[2]  # deeper would be a reversal
        z = now[0] * np.where(turns, 1.0 + _AWAY, 1.0 - _AWAY)
        stiffness: FloatArray = self.advance(z, diameter, self.begin(z, now), parameters)[1]
        return stiffness


_LAWS: dict[str, str | Law] = {
    "linear": "linear:LINEAR",
    "smoothed": "linear:SMOOTHED",
    "nodal": "linear:NODAL",
    "curve": "linear:CURVE",
    "rigid": "linear:RIGID",
    "unloading": "unloading:UNLOADING",
    "suction": "suction:SUCTION_LAW",
    "suction spring": "linear:SUCTION_SPRING",
    "friction": "friction:FRICTION",
    "lateral": "linear:LATERAL",
    "trench peak": "trench:TRENCH_PEAK",
    "trench table": "trench:TRENCH_TABLE",
    "trench wall": "trench:TRENCH_WALL",
    "soil": "soil:SOIL",
    "breakout": "breakout:BREAKOUT",
    "damping": "linear:DAMPING",
    "nodal damping": "linear:NODAL_DAMPING",
    "trench level": "trench:TRENCH_LEVEL",
}
"""Module and name of each law, or the law itself after its first use."""
MODULES = tuple(dict.fromkeys(str(place).partition(":")[0] for place in _LAWS.values()))
"""Modules of the laws of this package."""
BUILT_IN = tuple(_LAWS)
"""Names of the laws of this package; others are added with `register`."""


@cache
def law_module(name: str) -> ModuleType:
    """Return a module of this package, imported at the first call; a cached call is faster than an import statement."""
    return import_module(f"{__name__}.{name}")


def known_laws() -> tuple[str, ...]:
    """Return the names of all laws."""
    return tuple(_LAWS)


def law_named(name: str) -> Law:
    """Return the law of this name.

    Raises:
        ValueError: the law does not exist.
    """
    entry = _LAWS.get(name)
    if entry is None:
        raise ValueError(f"unknown contact law {name!r}; known are {', '.join(_LAWS)}")
    if isinstance(entry, str):
        module, _, attribute = entry.partition(":")
        law: Law = getattr(import_module(f"{__name__}.{module}"), attribute)
        _LAWS[name] = entry = law
    return entry


def is_normal(name: str) -> bool:
    """Return True if the law of a name is a normal law."""
    return isinstance(law_named(name), NormalLaw)


def register(law: Law) -> NormalLaw:
    """Add a normal law of elements or nodes, and return it.

    Raises:
        TypeError: the law is not a normal law without history, or has no reaction or steepest stiffness.
        ValueError: another law has its name.
    """
    if not isinstance(law, NormalLaw) or law.history or law.tables or _no_equation in {law.reaction, law.steepest}:
        raise TypeError("only normal laws without history can be added: a NormalLaw with reaction and steepest")
    if law.name in _LAWS and _LAWS[law.name] is not law:
        raise ValueError(f"contact law {law.name!r} is already registered")
    _LAWS[law.name] = law
    return law
