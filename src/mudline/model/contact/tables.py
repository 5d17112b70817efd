"""An input as the drivers want it, made once for each model, and what a scene with history remembers between steps."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mudline.basics.short_repr import outline
from mudline.model.contact.arrays import BoolArray, FloatArray, IndexArray
from mudline.model.contact.input import AssignedLaw, ContactInput
from mudline.model.contact.laws import NormalLaw, PathLaw
from mudline.model.contact.line import Line
from mudline.model.contact.seabed import heading

if TYPE_CHECKING:
    from mudline.model.contact.laws.friction import FrictionHistory, FrictionLaw
    from mudline.model.contact.laws.suction import SuctionHistory
    from mudline.model.contact.laws.unloading import UnloadingHistory
    from mudline.model.contact.trenches import LaidCentreline


_Part = Any
"""What a law remembers: an array, or a dataclass of arrays, with slots."""
REMEMBERED = ("unloading", "suction", "friction", "touchdown", "breakout", "paths")
IN_PLACE = ("breakout", "paths")
"""What the compiled loops move on from what it is."""


@dataclass(frozen=True, slots=True, eq=False, repr=False, weakref_slot=True)
class ContactState:
    """The state behind a step. It is never changed: a step gives a new one, or writes the one that it gets for `out`.

    Attributes:
        positions: (n, 3) of the step, for velocities by backward difference; None before the first step.
        laid: (n, 3) of the first step, along which trenches run; None before it.
        unloading: largest penetrations and trench bottoms of the elements that unload on a line of their own (k,).
        suction: states of the elements with suction (k,).
        friction: stick points of the nodes (n,).
        touchdown: (k, 3) midpoints of the elements with lateral springs when they touched down; NaN out of contact.
        breakout: (5, k) of the nodes with a breakout: the place of first contact (NaN out of contact), s and w.
        paths: (k, c) what the elements remember whose force follows a path.
    """

    positions: FloatArray | None = None
    laid: FloatArray | None = None
    unloading: UnloadingHistory | None = None
    suction: SuctionHistory | None = None
    friction: FrictionHistory | None = None
    touchdown: FloatArray | None = None
    breakout: FloatArray | None = None
    paths: FloatArray | None = None

    def __repr__(self) -> str:
        when = "before the first step" if self.positions is None else f"after a step of {len(self.positions)} nodes"
        held = ", ".join(name for name, _ in self._parts())
        return outline(f"ContactState {when}", held or "nothing to remember")

    @property
    def shapes(self) -> tuple[object, ...]:
        """The shapes of all that is remembered beside positions, by which states of different models differ."""
        return tuple((name, *(array.shape for array in arrays_of(part))) for name, part in self._parts())

    def _parts(self) -> list[tuple[str, _Part]]:
        """What the laws that are there remember, by the names of the fields."""
        return [(name, part) for name in REMEMBERED if (part := getattr(self, name)) is not None]

    def following(self, spare: ContactState | None, positions: FloatArray, laid: FloatArray) -> ContactState:
        """Return a state behind this one, whose arrays are to be written: those of `spare`, if there is one."""
        found = spare
        if found is None:
            found = ContactState(**{name: _like(part) for name, part in self._parts()})
        object.__setattr__(found, "positions", positions)
        object.__setattr__(found, "laid", laid)
        return found

    def remember(self, before: ContactState, names: tuple[str, ...] = REMEMBERED) -> None:
        """Write what the state before this one remembers into the arrays of this one."""
        for name in names if self is not before else ():
            if (part := getattr(self, name)) is not None:
                for new, old in zip(arrays_of(part), arrays_of(getattr(before, name)), strict=True):
                    new[...] = old


def arrays_of(part: _Part) -> list[NDArray[Any]]:
    """Return the arrays of what a law remembers."""
    return [part] if isinstance(part, np.ndarray) else [getattr(part, name) for name in part.__slots__]


def _like(part: _Part) -> _Part:
    """The same with arrays of its own, in the same order in memory, which are not filled in."""
    made = [np.empty_like(array) for array in arrays_of(part)]
    return made[0] if isinstance(part, np.ndarray) else type(part)(*made)


class Batch(NamedTuple):
    """Steps to be evaluated.

    Attributes:
        points: (steps, n, 3) positions, NaN for nodes without one.
        speed: (steps, n) velocities along the normals; None where nothing asks for them.
        laid: (n, 3) positions of the first step of the series.
        complete: whether all nodes have a position.
    """

    points: FloatArray
    speed: FloatArray | None
    laid: FloatArray
    complete: bool


class NormalRows(NamedTuple):
    """Elements, or nodes, with one normal law: their rows (k,) ascending, and its parameters, each (k,).

    `curve` is the index of the curve of a law with curves, else -1; `path` the first of its rows in what elements on a
    path remember, -1 for a law without.
    """

    law: NormalLaw
    rows: IndexArray
    columns: tuple[FloatArray, ...]
    curve: int = -1
    path: int = -1


class Tables:
    """The laws of an input. Attributes of laws that nothing has are None.

    Attributes:
        line: how elements join nodes.
        half: (m,) half of the lengths. diameter: (m,).
        onset: (m,) penetration at which contact begins; None where that is the mudline everywhere.
        normal: normal laws of elements. nodal: those of nodes.
        unloading: stiffness. springs: stiffness and extent of suction springs. lateral: stiffness times half length.
        friction: that of all nodes, whose arrays (n, 2) have each direction in one piece.
        breakout: nodes with it. shares: 1 over their numbers of elements (k,). embeds: whether it asks for z/D.
        damping, nodal_damping: coefficients of elements (m,), of nodes (n,), 0 where there is none; None without any.
        suction: parameters of `suction.SuctionLaw`, in its order.
        level: trenches in which the seabed is lowered.
        pulling: elements with suction whose curve pulls somewhere; None when there are none.
        cuts: whether curves that pull are cut to 0.
        rigid: (n,) nodes of elements on a rigid seabed; None when there are none.
        velocities: whether a law asks for velocities along the normals.
        history: whether a step's result depends on the steps before it.
    """

    def __init__(self, given: ContactInput) -> None:
        self.given = given
        self.line = Line(given.element_nodes, len(given.node_ids))
        self.half: FloatArray = 0.5 * given.length
        self.diameter = given.diameter
        onset = given.onset()
        self.onset: FloatArray | None = onset if onset.any() else None
        self.normal, self._paths = _with_paths([rows for law in given.normal_laws for rows in _normal_rows(law)])
        self.nodal = [rows for law in given.nodal_laws for rows in _normal_rows(law)]
        self.unloading, self.springs, self.suction = map(given.assigned.get, ("unloading", "suction spring", "suction"))
        self.damping = _coefficients(given, "damping", len(self.half))
        self.nodal_damping = _coefficients(given, "nodal damping", len(given.node_ids))
        self.lateral = _lateral(given)
        self.friction: FrictionLaw | None = None
        if (found := given.assigned.get("friction")) is not None:
            self.friction = _friction_law(found, len(given.node_ids))
        self.trench = None
        if self.friction is not None and given.has("trench peak", "trench wall", "trench table"):
            from mudline.model.contact.trenches import trench_rows  # noqa: PLC0415 - most friction has no trench

            self.trench = trench_rows(given, self.friction.coefficients[:, 1])
        self.breakout = _breakout(given, self)
        broken = np.empty(0, np.intp) if self.breakout is None else self.breakout.rows
        self.shares: FloatArray = 1.0 / np.diff(self.line.start)[broken]
        self.embeds = self.breakout is not None and any(self.breakout.columns[at].any() for at in (1, 3))
        self.level = None
        if given.has("trench level"):
            from mudline.model.contact.laws.trench import LEVEL  # noqa: PLC0415 - as above
            from mudline.model.contact.trenches import trench_rows  # noqa: PLC0415 - as above

            self.level = trench_rows(given, np.zeros(len(given.node_ids)), (LEVEL,))
        self._laid: tuple[FloatArray, LaidCentreline] | None = None
        self.pulling = _pulling(given)
        self.cuts = given.tension == "cut"
        self.rigid: BoolArray | None = None
        if "rigid" in given.assigned:
            self.rigid = np.zeros(len(given.node_ids), np.bool_)
            self.rigid[given.element_nodes[given.assigned["rigid"].rows]] = True
            self.rigid.flags.writeable = False  # results have it too
        self.velocities = bool(given.needs_velocities)
        # velocities are differences to the step before where none are given
        laws = [found.law for found in given.assigned.values()]
        self.history = self.velocities or self.level is not None or any(law.history for law in laws)

    def laid_line(self, laid: FloatArray) -> LaidCentreline:
        """Return the line as it was `laid`, prepared once: the states of a run share that array."""
        from mudline.model.contact.trenches import LaidCentreline  # noqa: PLC0415 - most friction has no trench

        kept = self._laid
        if kept is None or kept[0] is not laid:
            # in one assignment, so that threads which share the model see pairs that belong together
            self._laid = kept = (laid, LaidCentreline(laid, self.line))
        return kept[1]

    def initial_state(self) -> ContactState:
        """Return the state before the first step: nothing has touched the seabed."""
        found = {
            given.law.state: given.law.initial(len(given.rows), given.parameters)
            for given in self.given.assigned.values()
            if given.law.initial is not None
        }
        if self.friction is not None:
            from mudline.model.contact.laws.friction import FrictionHistory  # noqa: PLC0415 - only now is it needed

            found["friction"] = FrictionHistory.initial(self.friction.active)
        return ContactState(paths=None if self._paths is None else self._paths.copy(), **found)


def rows_within(rows: IndexArray, begin: int, end: int) -> slice:
    """Return which of ascending rows lie in a range."""
    low, high = np.searchsorted(rows, [begin, end]).tolist()
    return slice(low, high)


def _normal_rows(given: AssignedLaw) -> list[NormalRows]:
    """The rows of a normal law; a law with curves has one for each curve."""
    law = given.law
    if not isinstance(law, NormalLaw):
        return []
    if not law.tables:
        return [NormalRows(law, given.rows, given.columns)]
    index = given.columns[-1].astype(np.intp)
    return [NormalRows(law, given.rows[index == each], (), each) for each in np.unique(index).tolist()]


def _with_paths(normal: list[NormalRows]) -> tuple[list[NormalRows], FloatArray | None]:
    """The same with their places in what elements on a path remember, and that before the first step, (k, c)."""
    starts = [rows.law.start for rows in normal if isinstance(rows.law, PathLaw) for _ in rows.rows]
    if not starts:
        return normal, None
    found, placed, first = np.zeros((len(starts), max(map(len, starts)))), [], 0
    for rows in normal:
        if isinstance(rows.law, PathLaw):
            found[first : first + len(rows.rows), : len(rows.law.start)] = rows.law.start
            placed.append(rows._replace(path=first))
            first += len(rows.rows)
        else:
            placed.append(rows)
    return placed, found


def _coefficients(given: ContactInput, name: str, count: int) -> FloatArray | None:
    """The damping of all of `count` elements or nodes."""
    found = given.assigned.get(name)
    return None if found is None else found.spread("damping", count, 0.0)


def _lateral(given: ContactInput) -> AssignedLaw | None:
    found = given.assigned.get("lateral")
    if found is None:
        return None
    with np.errstate(over="ignore"):  # a step refuses the reaction
        return replace(found, parameters={"stiffness": found["stiffness"] * (0.5 * given.length[found.rows])})


def _breakout(given: ContactInput, tables: Tables) -> AssignedLaw | None:
    """The breakout of nodes that have it; ValueError for a node without friction in a box."""
    found = given.assigned.get("breakout")
    if found is None:
        return None
    able = np.zeros(len(given.node_ids), np.bool_)
    if tables.friction is not None:
        able = tables.friction.active & ~tables.friction.ellipse
    if not able[found.rows].all():
        node = given.node_ids[found.rows[~able[found.rows]][0]]
        raise ValueError(f"node {node} has a breakout law, which needs friction in a box")
    return found


def _friction_law(given: AssignedLaw, nodes: int) -> FrictionLaw:
    """The friction of all nodes as arrays by direction."""
    from mudline.model.contact.laws.friction import FrictionLaw  # noqa: PLC0415 - only now is it needed

    active = np.zeros(nodes, np.bool_)
    active[given.rows] = True
    coefficients, stiffness, mobilisation = (
        np.stack([given.spread(f"{side}_{name}", nodes, otherwise) for side in ("axial", "lateral")]).T
        for name, otherwise in (("coefficient", 0.0), ("stiffness", np.nan), ("mobilisation", np.nan))
    )
    mobilisation[np.isnan(mobilisation) & (coefficients == 0.0)] = 1.0
    angle = given.spread("angle", nodes)
    turned = np.flatnonzero(~np.isnan(angle))
    turn = np.array([heading(degrees) for degrees in angle[turned].tolist()]).reshape(-1, 2).T
    ellipse = given.spread("elliptic", nodes, 0.0) > 0.0
    return FrictionLaw(coefficients, stiffness, mobilisation, ellipse, active, turned, turn[0], turn[1])


def _pulling(given: ContactInput) -> IndexArray | None:
    """Elements with suction on a curve that is kept where it pulls, and pulls somewhere below the seabed."""
    if given.tension == "cut" or not given.has("suction") or not given.has("curve"):
        return None
    pulls = [
        bool((curve.forces[curve.ratios > 0.0] < 0.0).any() or curve.slopes[-1] < 0.0 or curve.evaluate(0.0)[0] < 0.0)
        for curve in given.curves
    ]
    on_pulling = np.array([*pulls, False])[given.curve_index]
    found = np.intersect1d(np.flatnonzero(on_pulling), given.assigned["suction"].rows)
    return found if found.size else None


def steepest_anywhere(tables: Tables, rows: NormalRows) -> FloatArray:
    """Return the largest stiffness (k,) that a normal law can reach on its elements, or nodes."""
    with np.errstate(all="ignore"):  # what overflows is refused where a step comes to it
        if rows.curve >= 0:
            from mudline.model.contact.laws.curve import steepest_slopes  # noqa: PLC0415 - only now is it needed

            slopes: FloatArray = steepest_slopes(tables.given.curves[rows.curve]).max() / tables.diameter[rows.rows]
            return slopes
        diameter = tables.diameter[rows.rows] if rows.law.acts_on == "elements" else np.zeros(len(rows.rows))
        found = rows.law.steepest(np.full(len(rows.rows), np.inf), diameter, *rows.columns)
    return np.broadcast_to(found, len(rows.rows)).copy()
