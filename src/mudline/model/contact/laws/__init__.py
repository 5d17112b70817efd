"""The contact laws: in each module a kind of them, with parameters, equation, tangents, state and source.

A law is known by its name and imported when an input has it. `register` adds one: a normal law of a module of your own
is evaluated, stepped, planned and differentiated like the others, with numpy and with compiled loops.

The functions of a law are expressions: they take floats (in compiled loops) and arrays (in numpy) alike and give the
same bits for both, as long as they use `+ - * /`, comparisons, `&`, `|`, `np.maximum`, `np.minimum`, `np.abs`,
`np.sqrt`, `np.nextafter`, `np.float_power` (not `**`, which numpy computes with code of its own) and `where` (not
`np.where`); a loop may end where `every` number would stay as it is.
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
"""A float or an array of floats: what expressions take and give."""
Reaction = Callable[..., tuple[Value, Value]]


def where(condition: Value, one: Value, other: Value) -> Value:
    """Return `one` where the condition holds, else `other`; for numbers and for arrays."""
    return np.where(condition, one, other)


def every(condition: Value) -> bool:
    """Return whether a condition holds, for all of an array."""
    return bool(np.all(condition))


class Reached(NamedTuple):
    """What the rows (k,) of a law beside the normal ones come to, for its largest stiffness and damping.

    Attributes:
        virgin: of elements: the steepest stiffness of their normal laws.
        speed: of elements: pull-out velocities (..., k) >= 0; None for any.
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
    """How the rows (k,) of a law beside the normal ones move in a step, for its damping there.

    Attributes:
        z: penetration.
        v: pull-out velocity.
        uplift: height above where the reaction of the seabed vanishes.
        before, after: what suction remembers.
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
        meaning: what it is.
        low: least value.
        above: whether the least value itself is not allowed.
        high: largest value, which is allowed when finite.
        default: value where none is given; None where one has to be given.
        optional: whether NaN stands for "none".
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
        """Return which values (k,) are not allowed."""
        with np.errstate(invalid="ignore"):
            allowed = np.isfinite(values) & (values <= self.high)
            allowed &= (values > self.low) if self.above else (values >= self.low)
        found: BoolArray = ~allowed
        return found & ~np.isnan(values) if self.optional else found


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class Law:
    """A contact law.

    Attributes:
        name: how assignments, plans and tables call it.
        summary: what it is, in a few words.
        stage: the stage of the plan that evaluates it.
        acts_on: whether its rows are elements or nodes.
        parameters: what each row needs.
        needs_diameter: whether an element needs an external diameter.
        velocities: whether a step asks for velocities along the normals.
        history: whether a step's result depends on the steps before it.
        tables: whether it takes tables besides numbers; `parameters` then has the index of one.
        check: what the parameters, by name, must be to each other: where it does not hold, and what it is.
        state: field of `ContactState` that has what its rows remember, where it remembers something.
        initial: (number of rows, parameters by name) to that before the first step.
        damping: (`Moving`, parameters by name) to minus d force / d pull-out velocity of each row, for tangents.
        plan: what the plan says behind the number of rows, or a function of the parameters by name to all that it
            says; "with" and the summary where it is empty, nothing for None.
        largest: (`Reached`, parameters by name) to the largest stiffness and the largest damping of each row, for laws
            beside the normal ones; None stands for no damping.
        equation: in one line.
        source: where the equation is published.
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
    initial: Callable[[int, dict[str, FloatArray]], Any] | None = None
    damping: Callable[[Moving, dict[str, FloatArray]], FloatArray] | None = None
    equation: str = ""
    source: str = ""

    __repr__ = short_repr

    def __reduce_ex__(self, protocol: SupportsIndex) -> str | tuple[Any, ...]:
        """Pickle a law of this package by its name, as some of its functions have none."""
        return (law_named, (self.name,)) if self.name in BUILT_IN else object.__reduce_ex__(self, protocol)


def _no_equation(*_: Value) -> Any:  # noqa: ANN401 - in place of any equation
    """Raise TypeError for a law whose reaction comes from tables."""
    raise TypeError("the law has no equation")


def _never(*parameters: Value) -> Value:
    """Contact begins at the mudline."""
    return 0.0 * parameters[0]


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class NormalLaw(Law):
    """A law of the reaction along the normal of the seabed, without history.

    Attributes:
        reaction: (penetration z, diameter D, *parameters) to force and stiffness d force / d z: per unit length for a
            law of elements, of the node for a law of nodes. It is asked for z of any size and sign, and counts where
            z > onset. Not for a law with tables.
        steepest: (z, D, *parameters) to the largest stiffness between the onset and z; z may be infinite.
        onset: (*parameters) to the penetration at which contact begins.
    """

    reaction: Reaction = field(default=_no_equation)
    steepest: Callable[..., Value] = field(default=_no_equation)
    plan: str | Callable[[dict[str, FloatArray]], str] | None = None
    onset: Callable[..., Value] = field(default=_never)

    __repr__ = short_repr


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class PathLaw(NormalLaw):
    """A normal law whose force depends on the path of an element; `reaction` and `steepest` are those of its first way.

    An element remembers some numbers; the last of them is an event of its present way, which is sought only when a step
    may come to it. A step to z = max(depth, 0) is `begin`, `locate` where `pending` says so, and `advance`.

    Attributes:
        start: what an element remembers that never touched the seabed.
        begin: (z, memory) to the memory with a reversal, where going to z is one.
        pending: (z, memory) to which event has to be known, from 1 on, 0 for none.
        locate: of each event (D, memory, parameters) to where it is.
        advance: (z, D, memory, parameters) to force, stiffness d force / d z on going on in this direction, and memory.
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
        """Write force and stiffness (steps, k) at depths of elements, and what they remember behind, `held` (k, c)."""
        count = len(self.start)
        memory = tuple(held[:, :count].T)
        for deep, force, stiffness in zip(depth, *out, strict=True):
            z = np.where(deep > 0.0, deep, 0.0)
            memory = self.begin(z, memory)
            pending = self.pending(z, memory)
            if pending.any():
                event = memory[-1].copy()
                for kind, locate in enumerate(self.locate, 1):
                    (wanted,) = (pending == kind).nonzero()
                    here = tuple(values[wanted] for values in memory), tuple(values[wanted] for values in parameters)
                    event[wanted] = locate(diameter[wanted], *here)
                memory = (*memory[:-1], event)
            force[...], stiffness[...], memory = self.advance(z, diameter, memory, parameters)
        held[:, :count] = np.stack(memory, axis=1)


_LAWS: dict[str, str | Law] = {
    "linear": "linear:LINEAR",
    "smoothed": "linear:SMOOTHED",
    "nodal": "linear:NODAL",
    "curve": "curve:CURVE",
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
"""Module and name of each law, or the law itself once it was asked for."""
MODULES = tuple(dict.fromkeys(str(place).partition(":")[0] for place in _LAWS.values()))
"""Modules of the laws of this package."""
BUILT_IN = tuple(_LAWS)
"""Names of the laws of this package; others are added with `register`."""


@cache
def law_module(name: str) -> ModuleType:
    """Return a module of this package; sooner than an import in a function, and it waits as that does."""
    return import_module(f"{__name__}.{name}")


def known_laws() -> tuple[str, ...]:
    """Return the names of all laws."""
    return tuple(_LAWS)


def law_named(name: str) -> Law:
    """Return the law of this name.

    Raises:
        ValueError: there is no such law.
    """
    found = _LAWS.get(name)
    if found is None:
        raise ValueError(f"unknown contact law {name!r}; known are {', '.join(_LAWS)}")
    if isinstance(found, str):
        module, _, attribute = found.partition(":")
        law: Law = getattr(import_module(f"{__name__}.{module}"), attribute)
        _LAWS[name] = found = law
    return found


def is_normal(name: str) -> bool:
    """Whether the law of a name is one of the reaction along the normal."""
    return isinstance(law_named(name), NormalLaw)


def register(law: Law) -> NormalLaw:
    """Add a normal law of elements or nodes, and return it.

    Raises:
        TypeError: it is not a normal law without history, or has no reaction or steepest stiffness.
        ValueError: another law has its name.
    """
    if not isinstance(law, NormalLaw) or law.history or law.tables or _no_equation in {law.reaction, law.steepest}:
        raise TypeError("only normal laws without history can be added: a NormalLaw with reaction and steepest")
    if law.name in _LAWS and _LAWS[law.name] is not law:
        raise ValueError(f"contact law {law.name!r} is already registered")
    _LAWS[law.name] = law
    return law
