"""Input prepared for the drivers, once for each model, and the state of a scene with history between steps."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mudline.basics.short_repr import outline
from mudline.model.contact.arrays import BoolArray, FloatArray, IndexArray
from mudline.model.contact.input import AssignedLaw, ContactInput
from mudline.model.contact.laws import NormalLaw, PathLaw, Value, law_module
from mudline.model.contact.line import Incidence
from mudline.model.contact.seabed import heading

if TYPE_CHECKING:
    from mudline.model.contact.laws.friction import FrictionHistory, FrictionLaw
    from mudline.model.contact.laws.suction import SuctionHistory
    from mudline.model.contact.laws.unloading import UnloadingHistory
    from mudline.model.contact.trenches import LaidCentreline
    from mudline.model.curves import ForceCurve


_Part = Any
"""History of a law: an array, or a dataclass of arrays, with slots."""
IN_PLACE = ("breakout", "paths")
"""Histories that the compiled loops update in place."""


@dataclass(frozen=True, slots=True, eq=False, repr=False, weakref_slot=True)
class ContactState:
    """The state after a step. It is never changed: a step returns a new state, or rewrites the state passed in `out`.

    Attributes:
        positions: (n, 3) positions of the step, for velocities by backward difference; None before the first step.
        laid: (n, 3) positions of the first step, along which trenches run; None before it.
        unloading: largest penetrations and trench bottoms of the elements with an unloading law (k,).
        suction: states of the elements with suction (k,).
        friction: stick points of the nodes (n,).
        touchdown: (k, 3) midpoints of the elements with lateral springs when they touched down; NaN out of contact.
        breakout: (5, k) of the nodes with a breakout: the place of first contact (NaN out of contact), s and w.
        paths: (k, c) memory of the elements whose force follows a path.
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
        """The shapes of all histories, which differ between the states of different models."""
        return tuple((name, *(array.shape for array in arrays_of(part))) for name, part in self._parts())

    def _parts(self) -> list[tuple[str, _Part]]:
        """Return the histories of the laws with their field names."""
        return [(name, part) for name in _REMEMBERED if (part := getattr(self, name)) is not None]

    def following(self, spare: ContactState | None, positions: FloatArray, laid: FloatArray) -> ContactState:
        """Return a state after this one with arrays to be written, those of `spare` if given."""
        state = spare
        if state is None:
            state = ContactState(**{name: _like(part) for name, part in self._parts()})
        object.__setattr__(state, "positions", positions)
        object.__setattr__(state, "laid", laid)
        return state

    def remember(self, before: ContactState, names: tuple[str, ...] | None = None) -> None:
        """Copy the histories of the state before into the arrays of this state."""
        for name, part in self._parts() if self is not before else ():
            if names is None or name in names:
                for new, old in zip(arrays_of(part), arrays_of(getattr(before, name)), strict=True):
                    new[...] = old


_REMEMBERED = tuple(each.name for each in fields(ContactState) if each.name not in ("positions", "laid"))


def arrays_of(part: _Part) -> list[NDArray[Any]]:
    """Return the arrays of a history."""
    return [part] if isinstance(part, np.ndarray) else [getattr(part, name) for name in part.__slots__]


def _like(part: _Part) -> _Part:
    """Return a history of the same shape and memory order, not filled in."""
    arrays = [np.empty_like(array) for array in arrays_of(part)]
    return arrays[0] if isinstance(part, np.ndarray) else type(part)(*arrays)


class StepBatch(NamedTuple):
    """Steps to be evaluated.

    Attributes:
        points: (steps, n, 3) positions, NaN for nodes without a position.
        speed: (steps, n) velocities along the normals; None if no law needs them.
        laid: (n, 3) positions of the first step of the series.
        complete: whether all nodes have a position.
    """

    points: FloatArray
    speed: FloatArray | None
    laid: FloatArray
    complete: bool


class NormalRows(NamedTuple):
    """Elements, or nodes, with one normal law.

    Attributes:
        law: the law.
        rows: (k,) indices of elements or nodes, ascending.
        columns: its parameters, each (k,).
        curve: the curve of a law with curves, else None.
        path: first of its rows in the memory of elements on a path, -1 for a law without.
    """

    law: NormalLaw
    rows: IndexArray
    columns: tuple[FloatArray, ...]
    curve: ForceCurve | None = None
    path: int = -1

    def write_reaction(self, z: FloatArray, diameter: FloatArray | float, out: FloatArray) -> None:
        """Write force, slope and stiffness (3, steps, k), those of the first loading, at penetrations (steps, k)."""
        force, slope, stiffness = out
        if self.curve is None:
            force[...], stiffness[...] = self.law.reaction(z, diameter, *self.columns)
            np.multiply(stiffness, diameter, out=slope)
        else:
            self.curve.fill((z / diameter).reshape(-1), force.reshape(-1), slope.reshape(-1))
            np.divide(slope, diameter, out=stiffness)

    def steepest(self, z: FloatArray, diameter: FloatArray | float) -> Value:
        """Return the largest stiffness between the onset and penetrations (..., k), of this shape or (k,)."""
        if self.curve is None:
            return self.law.steepest(z, diameter, *self.columns)
        return law_module("linear").steepest_slope(self.curve, z / diameter) / diameter


class LawTables:
    """The laws of an input as arrays. The attribute of an absent law is None.

    Attributes:
        line: incidence of elements and nodes.
        half: (m,) half of the lengths.
        diameter: (m,) external diameters.
        onset: (m,) penetration at which contact begins; None if it is 0 everywhere.
        normal: normal laws of elements.
        nodal: normal laws of nodes.
        unloading: stiffness of unloading lines.
        springs: stiffness and extent of suction springs.
        lateral: stiffness of lateral springs times half length.
        friction: friction of all nodes; the arrays (n, 2) are contiguous along each direction.
        breakout: nodes with a breakout.
        shares: (k,) 1 over the numbers of elements of the nodes with a breakout.
        embeds: whether a breakout depends on z/D.
        damping, nodal_damping: coefficients of elements (m,) and of nodes (n,), 0 without damping.
        suction: parameters of `suction.SuctionLaw`, in its order.
        level: trenches with a lowered seabed.
        pulling: elements with suction whose curve pulls somewhere; None if there are none.
        cuts: whether curves that pull are cut to 0.
        rigid: (n,) nodes of elements on a rigid seabed; None if there are none.
        velocities: whether a law needs velocities along the normals.
        history: whether the result of a step depends on earlier steps.
    """

    def __init__(self, given: ContactInput) -> None:
        self.given = given
        self.line = Incidence(given.element_nodes, len(given.node_ids))
        self.half: FloatArray = 0.5 * given.length
        self.diameter = given.diameter
        onset = given.onset()
        self.onset: FloatArray | None = onset if onset.any() else None
        self.normal, self._paths = _with_paths([rows for law in given.normal_laws for rows in _normal_rows(law, given)])
        self.nodal = [rows for law in given.nodal_laws for rows in _normal_rows(law, given)]
        self.unloading, self.springs, self.suction = map(given.assigned.get, ("unloading", "suction spring", "suction"))
        self.damping = _coefficients(given, "damping", len(self.half))
        self.nodal_damping = _coefficients(given, "nodal damping", len(given.node_ids))
        self.lateral = _lateral(given)
        self.friction: FrictionLaw | None = None
        if (friction := given.assigned.get("friction")) is not None:
            self.friction = _friction_law(friction, len(given.node_ids))
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
        self.cuts = given.tension == "cut" and any(rows.curve for rows in self.normal)
        self.rigid: BoolArray | None = None
        if "rigid" in given.assigned:
            self.rigid = np.zeros(len(given.node_ids), np.bool_)
            self.rigid[given.element_nodes[given.assigned["rigid"].rows]] = True
            self.rigid.flags.writeable = False  # results have it too
        self.velocities = bool(given.needs_velocities)
        # velocities default to differences to the step before
        laws = [assigned.law for assigned in given.assigned.values()]
        self.history = self.velocities or self.level is not None or any(law.history for law in laws)

    @cached_property
    def steepens(self) -> bool:
        """True if an unloading line may be less steep than the virgin path that led to it."""
        if self.unloading is None:
            return False
        stiffness = np.full(len(self.half), np.inf)
        stiffness[self.unloading.rows] = self.unloading.columns[0]
        return any(bool((steepest_anywhere(self, rows) > stiffness[rows.rows]).any()) for rows in self.normal)

    def laid_line(self, laid: FloatArray) -> LaidCentreline:
        """Return the line as it was `laid`, prepared once: the states of a run share that array."""
        from mudline.model.contact.trenches import LaidCentreline  # noqa: PLC0415 - most friction has no trench

        kept = self._laid
        if kept is None or kept[0] is not laid:
            # in one assignment, so that threads which share the model see matching pairs
            self._laid = kept = (laid, LaidCentreline(laid, self.line))
        return kept[1]

    def initial_state(self) -> ContactState:
        """Return the state before the first step: nothing has touched the seabed."""
        count = {"elements": len(self.half), "nodes": len(self.given.node_ids)}
        histories = {
            law.state: law.initial(assigned.rows, count[law.acts_on], assigned.parameters)
            for assigned in self.given.assigned.values()
            if (law := assigned.law).initial is not None
        }
        return ContactState(paths=None if self._paths is None else self._paths.copy(), **histories)


def _normal_rows(assigned: AssignedLaw, given: ContactInput) -> list[NormalRows]:
    """Return the rows of a normal law; a law with curves has one entry for each curve."""
    law = assigned.law
    if not isinstance(law, NormalLaw):
        return []
    if not law.tables:
        return [NormalRows(law, assigned.rows, assigned.columns)]
    index = assigned.columns[-1].astype(np.intp)
    return [
        NormalRows(law, assigned.rows[index == each], (), given.curves[each])
        for each in np.flatnonzero(np.bincount(index)).tolist()
    ]


def _with_paths(normal: list[NormalRows]) -> tuple[list[NormalRows], FloatArray | None]:
    """Return normal laws with their places in the memory of elements on a path, and its initial values (k, c)."""
    starts = [rows.law.start for rows in normal if isinstance(rows.law, PathLaw) for _ in rows.rows]
    if not starts:
        return normal, None
    memory, placed, first = np.zeros((len(starts), max(map(len, starts)))), [], 0
    for rows in normal:
        if isinstance(rows.law, PathLaw):
            memory[first : first + len(rows.rows), : len(rows.law.start)] = rows.law.start
            placed.append(rows._replace(path=first))
            first += len(rows.rows)
        else:
            placed.append(rows)
    return placed, memory


def _coefficients(given: ContactInput, name: str, count: int) -> FloatArray | None:
    """Return the damping of all of `count` elements or nodes."""
    damping = given.assigned.get(name)
    return None if damping is None else damping.spread("damping", count, 0.0)


def _lateral(given: ContactInput) -> AssignedLaw | None:
    springs = given.assigned.get("lateral")
    if springs is None:
        return None
    with np.errstate(over="ignore"):  # a step refuses the reaction
        return replace(springs, parameters={"stiffness": springs["stiffness"] * (0.5 * given.length[springs.rows])})


def _breakout(given: ContactInput, tables: LawTables) -> AssignedLaw | None:
    """Return the breakout of nodes; ValueError for a node without friction in a box."""
    breakout = given.assigned.get("breakout")
    if breakout is None:
        return None
    in_box = np.zeros(len(given.node_ids), np.bool_)
    if tables.friction is not None:
        in_box = tables.friction.active & ~tables.friction.ellipse
    if not in_box[breakout.rows].all():
        node = given.node_ids[breakout.rows[~in_box[breakout.rows]][0]]
        raise ValueError(f"node {node} has a breakout law, which needs friction in a box")
    return breakout


def _friction_law(assigned: AssignedLaw, nodes: int) -> FrictionLaw:
    """Return the friction of all nodes as arrays by direction."""
    from mudline.model.contact.laws.friction import FrictionLaw  # noqa: PLC0415 - only now is it needed

    active = np.zeros(nodes, np.bool_)
    active[assigned.rows] = True
    coefficients, stiffness, mobilisation = (
        np.stack([assigned.spread(f"{side}_{name}", nodes, otherwise) for side in ("axial", "lateral")]).T
        for name, otherwise in (("coefficient", 0.0), ("stiffness", np.nan), ("mobilisation", np.nan))
    )
    mobilisation[np.isnan(mobilisation) & (coefficients == 0.0)] = 1.0
    angle = assigned.spread("angle", nodes)
    turned = np.flatnonzero(~np.isnan(angle))
    turn = np.array([heading(degrees) for degrees in angle[turned].tolist()]).reshape(-1, 2).T
    ellipse = assigned.spread("elliptic", nodes, 0.0) > 0.0
    return FrictionLaw(coefficients, stiffness, mobilisation, ellipse, active, turned, turn[0], turn[1])


def _pulling(given: ContactInput) -> IndexArray | None:
    """Return elements with suction on an uncut curve that pulls somewhere below the seabed; None if there are none."""
    if given.tension == "cut" or not given.has("suction") or not given.has("curve"):
        return None
    pulls = [
        bool((curve.forces[curve.ratios > 0.0] < 0.0).any() or curve.slopes[-1] < 0.0 or curve.evaluate(0.0)[0] < 0.0)
        for curve in given.curves
    ]
    on_pulling = np.array([*pulls, False])[given.curve_index]
    elements = np.intersect1d(np.flatnonzero(on_pulling), given.assigned["suction"].rows)
    return elements if elements.size else None


def steepest_anywhere(tables: LawTables, rows: NormalRows) -> FloatArray:
    """Return the largest stiffness (k,) that a normal law can reach on its elements or nodes."""
    with np.errstate(all="ignore"):  # an overflow is refused at the step where it occurs
        diameter = tables.diameter[rows.rows] if rows.law.acts_on == "elements" else np.zeros(len(rows.rows))
        return np.broadcast_to(rows.steepest(np.full(len(rows.rows), np.inf), diameter), len(rows.rows)).copy()
