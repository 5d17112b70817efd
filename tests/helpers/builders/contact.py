"""Scenes for the tests: lines with laws on them, motions of their nodes, and the same scene written in another way."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import ArrayLike

from mudline.model.contact import ContactInput, ContactModel, ContactResult, LawAssignment, Tension
from mudline.model.contact.arrays import BoolArray, FloatArray, IndexArray
from mudline.model.contact.laws import law_named
from mudline.model.contact.laws.suction import SuctionLaw, from_cohesion
from mudline.model.contact.seabed import Seabed
from mudline.model.contact.stiffest import LawStiffness, Stiffest
from mudline.model.contact.tables import ContactState
from mudline.model.curves import ForceCurve

CLAY = ForceCurve([(0.0, 0.0), (0.1, 2000.0), (0.3, 4500.0), (0.5, 6000.0)], name="clay")
SAND = ForceCurve([(0.0, 0.0), (1.0, 40000.0)], name="sand")
PULLING = ForceCurve([(0.1, -100.0), (0.2, 100.0), (0.4, 900.0)], name="pulling")
NONE, CURVE, LINEAR, RIGID = "", "curve", "linear", "rigid"
"""Normal laws of the elements of `chain`."""
STIFFNESS = 50000.0
ALONG_Y = {"start_y": 0.0, "start_z": 0.0, "end_y": 1.0, "end_z": 0.0}
"""The straight centreline of a trench along +Y at Z = 0."""
FRICTION = (
    *("axial_coefficient", "lateral_coefficient", "axial_stiffness", "lateral_stiffness"),
    *("axial_mobilisation", "lateral_mobilisation", "elliptic", "angle"),
)

each_backend = pytest.mark.parametrize("backend", ["numpy", "fast"])

# --------------------------------------------------------------------------------------------------------------- chains


def chain(  # noqa: PLR0913 - each has a default
    laws: Sequence[str],
    *beside: LawAssignment,
    curves: tuple[ForceCurve, ...] = (CLAY,),
    curve_index: Sequence[int] | None = None,
    tables: tuple[FloatArray, ...] = (),
    diameter: ArrayLike = 0.3,
    length: ArrayLike = 2.0,
    stiffness: ArrayLike = STIFFNESS,
    tension: Tension = "keep",
    seabed: Seabed | None = None,
) -> ContactInput:
    """Elements along Y with these normal laws and other laws `beside` them; nodes from 101 on, elements from 11.

    The nodes lie 2 apart on the seabed. `stiffness` is that of elements with the linear law.
    """
    count = len(laws)
    rows = {name: [row for row, law in enumerate(laws) if law == name] for name in (CURVE, LINEAR, RIGID)}
    given = np.zeros(count, np.intp) if curve_index is None else np.array(curve_index, np.intp)
    spread = {name: np.broadcast_to(np.asarray(values, np.float64), count).copy() for name, values in
              (("diameter", diameter), ("length", length), ("stiffness", stiffness))}  # fmt: skip
    coordinates = np.zeros((count + 1, 3))
    coordinates[:, 1] = 2.0 * np.arange(count + 1)
    return ContactInput(
        node_ids=101 + np.arange(count + 1, dtype=np.int64),
        coordinates=coordinates,
        element_ids=11 + np.arange(count, dtype=np.int64),
        element_nodes=np.column_stack((np.arange(count, dtype=np.intp), 1 + np.arange(count, dtype=np.intp))),
        length=spread["length"],
        diameter=spread["diameter"],
        laws=(
            on(CURVE, rows[CURVE], curve=given[rows[CURVE]]),
            on(LINEAR, rows[LINEAR], stiffness=spread["stiffness"][rows[LINEAR]]),
            on(RIGID, rows[RIGID]),
            *beside,
        ),
        curves=curves,
        tables=tables,
        tension=tension,
        seabed=seabed,
    )


def mixed(count: int, seed: int) -> ContactInput:
    """A chain with every normal law, two curves, and diameters and lengths of its own for each element."""
    rng = np.random.default_rng(seed)
    laws = rng.choice([NONE, CURVE, LINEAR, RIGID], count, p=[0.1, 0.5, 0.3, 0.1]).tolist()
    index = rng.integers(0, 2, count).tolist()
    diameter, length = rng.uniform(0.1, 0.6, count), rng.uniform(0.5, 3.0, count)
    return chain(laws, curves=(CLAY, SAND), curve_index=index, diameter=diameter, length=length)


def apart(inputs: ContactInput) -> ContactInput:
    """The same elements, each between two nodes of its own; without laws of nodes."""
    count = len(inputs.element_ids)
    return replace(
        without(inputs, "nodal", "friction"),
        node_ids=101 + np.arange(2 * count),
        coordinates=inputs.coordinates[inputs.element_nodes].reshape(-1, 3),
        element_nodes=np.arange(2 * count).reshape(-1, 2),
    )


# ----------------------------------------------------------------------------------------------------------------- laws


def on(law: str, rows: int | Sequence[int] | IndexArray, **parameters: ArrayLike) -> LawAssignment:
    """A law of rows, or of as many rows from the first on."""
    picked = np.arange(rows) if isinstance(rows, int) else np.asarray(rows, np.intp)
    return LawAssignment(law, picked, parameters)


def without(inputs: ContactInput, *names: str) -> ContactInput:
    """The input without some laws."""
    return replace(inputs, laws=tuple(law for law in inputs.laws if law.law not in names))


def only(inputs: ContactInput, *names: str) -> ContactInput:
    """The input with no other laws than these."""
    return replace(inputs, laws=tuple(law for law in inputs.laws if law.law in names))


def beside(inputs: ContactInput, *laws: LawAssignment) -> ContactInput:
    """The input with more laws."""
    return replace(inputs, laws=(*inputs.laws, *laws))


def changed(inputs: ContactInput, law: str, **parameters: ArrayLike) -> ContactInput:
    """The input with other values of parameters of all rows of a law, in ascending order of the rows."""
    given = inputs.assigned[law]
    return beside(without(inputs, law), LawAssignment(law, given.rows, {**given.parameters, **parameters}))


def floats(values: ArrayLike, count: int = 1) -> FloatArray:
    """As many values."""
    return np.broadcast_to(np.asarray(values, np.float64), (count,)).copy()


def bridge_law(
    elements: int = 1,
    cohesion: ArrayLike = 5000.0,
    diameter: ArrayLike = 0.3,
    regularisation: ArrayLike = 1e-3,
    corners: tuple[float, float] = (0.2, 0.8),
) -> SuctionLaw:
    """Suction after Bridge et al. of pipes in soil of some cohesion, without cyclic degradation."""
    factors = from_cohesion(floats(cohesion, elements), floats(diameter, elements))
    first, second = (floats(corner, elements) for corner in corners)
    slow, none = floats(regularisation, elements), floats(np.nan, elements)
    return SuctionLaw(*factors, first, second, floats(1.0, elements), slow, none)


def suction(law: SuctionLaw, rows: Sequence[int] | None = None) -> LawAssignment:
    """The law on these elements, or on as many from the first as it has rows."""
    return on("suction", len(law.cyclic) if rows is None else rows, **law._asdict())


def friction(
    rows: int | Sequence[int],
    coefficients: tuple[float, float] = (0.5, 0.8),
    stiffness: float | tuple[float, float] = 1e5,
    *,
    mobilisation: float = np.nan,
    ellipse: bool = False,
    angle: float = np.nan,
) -> LawAssignment:
    """One law for these nodes; `mobilisation` instead of a stiffness of NaN."""
    springs = np.broadcast_to(np.asarray(stiffness, np.float64), 2).tolist()
    values = (*coefficients, *springs, mobilisation, mobilisation, float(ellipse), angle)
    return on("friction", rows, **dict(zip(FRICTION, values, strict=True)))


def trench(
    rows: int | Sequence[int],
    bottom: float,
    upper: float,
    peak: ArrayLike,
    centreline: Mapping[str, ArrayLike] = ALONG_Y,
) -> LawAssignment:
    """A trench of these elements along +Y at Z = 0, with a peak resistance per unit length."""
    return on("trench peak", rows, bottom=bottom, upper=upper, peak=peak, **centreline)


def law_of(found: Stiffest, law: str) -> LawStiffness:
    """What a time step has to resolve of one law."""
    held: LawStiffness = found.__getitem__(law)
    return held


# -------------------------------------------------------------------------------------------------------------- motions


def at_depths(depths: ArrayLike) -> FloatArray:
    """Positions (..., n, 3) of nodes at these depths (..., n) below the seabed."""
    depth = np.asarray(depths, np.float64)
    positions = np.zeros((*depth.shape, 3))
    positions[..., 0] = -depth
    return positions


def depth_at(ratio: float, diameter: float) -> float:
    """The depth whose embedment ratio is exactly `ratio`."""
    depth = ratio * diameter
    near = (depth, float(np.nextafter(depth, -np.inf)), float(np.nextafter(depth, np.inf)))
    return next(candidate for candidate in near if candidate / diameter == ratio)


def heave(depths: ArrayLike, pull_out: ArrayLike, nodes: int = 2) -> tuple[FloatArray, FloatArray]:
    """Positions and velocities (steps, n, 3) of a chain that stays level: depths and pull-out velocities (steps,)."""
    depth = np.repeat(np.asarray(depths, np.float64)[:, None], nodes, axis=1)
    positions = at_depths(depth)
    positions[..., 1] = 2.0 * np.arange(nodes)
    velocities = np.zeros_like(positions)
    velocities[..., 0] = np.broadcast_to(np.asarray(pull_out, np.float64)[:, None], depth.shape)
    return positions, velocities


def drawn(places: ArrayLike, depth: ArrayLike = 0.02, nodes: int = 2) -> FloatArray:
    """Positions (steps, n, 3) of a chain along Y at a depth, drawn along (steps, 2) to offsets in Y and Z."""
    offsets = np.asarray(places, np.float64)
    positions, _ = heave(np.broadcast_to(np.asarray(depth, np.float64), len(offsets)), np.zeros(len(offsets)), nodes)
    positions[..., 1:] += offsets[:, None, :]
    return positions


def stepped(
    contact: ContactModel, positions: ArrayLike, velocities: ArrayLike | None = None
) -> Iterator[tuple[ContactResult, ContactState]]:
    """Results and states of the steps of positions (steps, n, 3), whose velocities are 0 where they are not given."""
    places = np.asarray(positions, np.float64)
    rates = np.zeros_like(places) if velocities is None else np.asarray(velocities, np.float64)
    state = contact.initial_state()
    for place, rate in zip(places, rates, strict=True):
        result, state = contact.step(place, rate, state)
        yield result, state


def walk(contact: ContactModel, positions: ArrayLike, velocities: ArrayLike | None = None) -> list[ContactResult]:
    """The results of `stepped`."""
    return [result for result, _ in stepped(contact, positions, velocities)]


def line(elements: int, seed: int) -> FloatArray:
    """Nodes of a slightly bent line along Y, a little below X = 0."""
    rng = np.random.default_rng(seed)
    points = np.zeros((elements + 1, 3))
    points[:, 0] = rng.uniform(-0.08, -0.02, elements + 1)
    points[:, 1] = np.cumsum(rng.uniform(1.5, 2.5, elements + 1))
    points[:, 2] = np.cumsum(rng.uniform(-0.2, 0.2, elements + 1))
    return points


def moved(points: FloatArray, steps: int, seed: int) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Positions and velocities (steps, n, 3) of nodes that heave and drift, and the times (steps,) of the steps."""
    rng = np.random.default_rng(seed)
    moves = rng.normal(scale=(0.04, 0.02, 0.03), size=(steps, *points.shape))
    moves += rng.normal(scale=(0.05, 0.02, 0.05), size=(steps, 1, 3))  # the line as a whole
    positions = points + np.cumsum(moves, axis=0)
    times = np.cumsum(rng.uniform(0.05, 0.5, steps))
    velocities = np.diff(positions, axis=0, prepend=positions[:1]) / np.diff(times, prepend=0.0)[:, None, None]
    return positions, velocities, times


def journey(elements: int, steps: int, seed: int) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Positions and velocities (steps, n, 3) of a line that heaves and drifts, and the times (steps,) of its steps."""
    return moved(line(elements, seed), steps, seed)


# ----------------------------------------------------------------------------------------------------------- everything

TABLES = (np.array([[0.01, 100.0], [0.1, 400.0], [0.3, 50.0]]), np.array([[0.0, 250.0], [0.5, 250.0]]))
"""Tabulated resistances of trenches."""


def everything(elements: int, seed: int, seabed: Seabed | None = None) -> ContactInput:
    """A scene in which each law holds somewhere, if the line is not very short."""
    rng = np.random.default_rng(seed)
    points = line(elements, seed)
    normal = rng.choice(5, elements, p=[0.35, 0.15, 0.3, 0.1, 0.1])
    curve, linear, smoothed, rigid, bare = (np.flatnonzero(normal == kind) for kind in range(5))
    diameter = rng.choice([0.3, 0.5], elements)
    unloads, springs = _some(rng, elements, 0.4), _some(rng, elements, 0.2)
    lateral, nodal = _some(rng, elements, 0.3), _some(rng, elements + 1, 0.3)
    suction_law = _random_suction(diameter, rng)
    # a soil has its own unloading and suction
    soil = np.setdiff1d(np.concatenate([bare, linear]), np.concatenate([unloads, suction_law.rows]))
    return ContactInput(
        node_ids=np.arange(1, elements + 2),
        coordinates=points,
        element_ids=np.arange(1, elements + 1),
        element_nodes=np.column_stack([np.arange(elements), np.arange(1, elements + 1)]),
        length=np.sqrt((np.diff(points, axis=0) ** 2).sum(axis=1)),
        diameter=diameter,
        laws=(
            on("curve", curve, curve=rng.integers(0, 2, len(curve))),
            on("linear", np.setdiff1d(linear, soil), stiffness=2.0e4),
            on(
                "smoothed",
                smoothed,
                stiffness=2.0e4,
                half_width=rng.uniform(0.0, 0.02, len(smoothed)),
                one_sided=rng.integers(0, 2, len(smoothed)),
            ),
            on("rigid", rigid),
            on("soil", soil, strength=np.linspace(1e3, 8e3, len(soil)), gradient=1500.0, buoyancy=9000.0),
            on(
                "nodal",
                nodal,
                stiffness=3.0e4,
                half_width=rng.uniform(0.0, 0.01, len(nodal)),
                one_sided=rng.integers(0, 2, len(nodal)),
            ),
            on("unloading", unloads, stiffness=rng.choice([1.0e3, 4.0e5], len(unloads))),
            on("suction spring", springs, stiffness=800.0, extent=0.2),
            suction_law,
            _random_friction(elements + 1, rng),
            on("lateral", lateral, stiffness=900.0),
            *_random_trenches(elements, rng),
        ),
        curves=(CLAY, SAND),
        tables=TABLES,
        seabed=seabed,
        weight=rng.uniform(500.0, 1500.0, elements),
    )


def all_laws(elements: int, seed: int, seabed: Seabed | None = None) -> ContactInput:
    """Everything, with a curve that is cut: with the loops of random scenes of all laws, which are compiled once."""
    return replace(everything(elements, seed, seabed), curves=(CLAY, PULLING), tension="cut")


def _some(rng: np.random.Generator, count: int, share: float) -> IndexArray:
    """Some of as many rows."""
    return np.flatnonzero(rng.random(count) < share)


def _random_suction(diameter: FloatArray, rng: np.random.Generator) -> LawAssignment:
    """The law of Bridge et al. on some of the elements, some with a factor for each cycle."""
    rows = _some(rng, len(diameter), 0.7)
    count = len(rows)
    law = bridge_law(count, 4000.0, diameter[rows])
    floor = np.where(rng.random(count) < 0.4, 0.5, np.nan)
    return suction(law._replace(cyclic=rng.choice([1.0, 0.9], count), cyclic_floor=floor), rows.tolist())


def _random_friction(nodes: int, rng: np.random.Generator) -> LawAssignment:
    """Springs of both kinds, some with an ellipse, some at an angle, on most of the nodes."""
    rows = _some(rng, nodes, 0.9)
    count = len(rows)
    constant = np.where(rng.random((count, 1)) < 0.5, rng.uniform(2e4, 1e5, (count, 2)), np.nan)
    columns = np.column_stack(
        [
            rng.uniform(0.2, 0.9, (count, 2)),
            constant,
            rng.uniform(0.005, 0.05, (count, 2)),
            rng.random(count) < 0.4,
            np.where(rng.random(count) < 0.3, rng.uniform(-180.0, 180.0, count), np.nan),
        ]
    )
    return on("friction", rows, **dict(zip(FRICTION, columns.T, strict=True)))


def _random_trenches(elements: int, rng: np.random.Generator) -> list[LawAssignment]:
    """Trenches of all three kinds on most of the elements, some along a straight centreline."""
    kind = rng.choice(4, elements, p=[0.3, 0.2, 0.3, 0.2])
    found = []
    parameters: list[tuple[str, dict[str, ArrayLike]]] = [
        ("trench peak", {"peak": 350.0}),
        ("trench wall", {"depth": 0.1}),
        ("trench table", {"table": 0}),
    ]
    for number, (name, own) in enumerate(parameters):
        rows = np.flatnonzero(kind == number)
        straight = np.where(rng.random((len(rows), 1)) < 0.3, np.array([[0.0, 0.1, 50.0, 0.3]]), np.nan)
        given = {**own, **dict(zip(ALONG_Y, straight.T, strict=True)), "upper": rng.choice([0.4, 0.6], len(rows))}
        if name == "trench table":
            given["table"] = rng.integers(0, len(TABLES), len(rows))
        found.append(on(name, rows, bottom=0.02, **given))
    return found


# -------------------------------------------------------------------------------------------- the same in another order


def rearranged(inputs: ContactInput, order: IndexArray, turned: BoolArray) -> ContactInput:
    """The same elements in another order, some written from their second node to their first."""
    ends = np.where(turned[:, None], inputs.element_nodes[:, ::-1], inputs.element_nodes)[order]
    return replace(
        inputs,
        element_ids=inputs.element_ids[order],
        element_nodes=ends,
        length=inputs.length[order],
        diameter=inputs.diameter[order],
        weight=None if inputs.weight is None else inputs.weight[order],
        laws=_at(inputs, "elements", np.argsort(order)),
    )


def renumbered(inputs: ContactInput, order: IndexArray) -> ContactInput:
    """The same nodes in another order: node k of the new input is node order[k] of the old one."""
    place = np.argsort(order)
    return replace(
        inputs,
        node_ids=inputs.node_ids[order],
        coordinates=inputs.coordinates[order],
        element_nodes=place[inputs.element_nodes],
        laws=_at(inputs, "nodes", place),
    )


def _at(inputs: ContactInput, kind: str, place: IndexArray) -> tuple[LawAssignment, ...]:
    """The laws where those of elements, or of nodes, stand in other places."""
    return tuple(
        replace(law, rows=place[law.rows]) if law_named(law.law).acts_on == kind else law for law in inputs.laws
    )


def alone(inputs: ContactInput, element: int) -> ContactInput:
    """One element with its own laws, and none of nodes."""
    one = slice(element, element + 1)
    laws = []
    for name, given in inputs.assigned.items():
        held = given.rows == element
        if given.law.acts_on == "elements" and held.any():
            laws.append(on(name, 1, **{key: values[held] for key, values in given.parameters.items()}))
    return replace(
        inputs,
        element_ids=inputs.element_ids[one],
        element_nodes=inputs.element_nodes[one],
        length=inputs.length[one],
        diameter=inputs.diameter[one],
        weight=None if inputs.weight is None else inputs.weight[one],
        laws=tuple(laws),
    )
