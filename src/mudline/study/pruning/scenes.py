"""The scenes whose cost is compared, of any size: the deck's own, each law beside the curve, everything at once."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from mudline.contact.arrays import FloatArray, IndexArray
from mudline.contact.input import AssignedLaw, ContactInput, LawAssignment
from mudline.contact.laws import law_named
from mudline.contact.laws.suction import from_cohesion
from mudline.contact.seabed import PlanesSeabed, Seabed, SlopingSeabed
from mudline.contact.seabed.profile import ProfileSeabed
from mudline.curves import ForceCurve

AS_IT_IS, CURVE, EVERYTHING = "scene as it is", "curve", "everything"
PLAIN = "plain numpy"
"""The function that is compared with the scene of a curve."""
COHESION = 5000.0
STEPS = 3
"""Of a series: laid, then lifted in waves, then dragged."""
_BESIDE = ("nodal", "unloading", "suction spring", "suction", "friction", "lateral", "trench peak")
"""The laws of "everything" in addition to the normal laws of its elements."""
_WAVE = 200
_DEEPEST = 0.25
_RISE = 0.001
"""Of a seabed over the length: that of a gentle slope."""

# ----------------------------------------------------------------------------------------------------------------- pipe


class Pipe(NamedTuple):
    """What the forced laws are made for: a curve, its steepest slope as stiffness, a diameter, an element length."""

    curve: ForceCurve
    stiffness: float
    diameter: float
    length: float


def pipe_of(inputs: ContactInput, usual: ForceCurve) -> Pipe:
    """The curve that most elements have (`usual` if none has any), the middle diameter and length of the elements."""
    given = inputs.assigned.get("curve")
    curve = usual if given is None else inputs.curves[int(np.bincount(given["curve"].astype(np.intp)).argmax())]
    diameter = _middle(inputs.diameter, 0.3)
    return Pipe(curve, float(np.abs(curve.slopes).max()) / diameter or 1.0, diameter, _middle(inputs.length, 1.0))


def _middle(values: FloatArray, default: float) -> float:
    usable = values[np.isfinite(values) & (values > 0.0)]
    return float(np.median(usable)) if usable.size else default


# --------------------------------------------------------------------------------------------------------------- scenes


@dataclass(frozen=True, slots=True)
class Variant:
    """A scene of any size.

    Attributes:
        name: for tables.
        make: the input with a number of nodes, or about that many where whole copies of the deck are made.
        lies: whether the nodes are where the deck has them, instead of embedded in the seabed.
    """

    name: str
    make: Callable[[int], ContactInput]
    lies: bool = False


def line(pipe: Pipe, nodes: int, laws: Sequence[str] = ("curve",)) -> ContactInput:
    """A straight line along Y with these laws everywhere and nothing else."""
    elements = nodes - 1
    points = np.zeros((nodes, 3))
    points[:, 1] = pipe.length * np.arange(nodes)
    return ContactInput(
        node_ids=np.arange(1, nodes + 1),
        coordinates=points,
        element_ids=np.arange(1, nodes),
        element_nodes=chain(nodes),
        length=np.full(elements, pipe.length),
        diameter=np.full(elements, pipe.diameter),
        laws=tuple(law_everywhere(law, pipe, nodes) for law in laws),
        curves=(pipe.curve,) if "curve" in laws else (),
    )


def variants(inputs: ContactInput, pipe: Pipe) -> list[Variant]:
    """All of them, the deck's own first, everything at once last."""

    def having(*laws: str) -> Callable[[int], ContactInput]:
        return lambda nodes: line(pipe, nodes, laws)

    def on(seabed: Callable[[float], Seabed]) -> Callable[[int], ContactInput]:
        return lambda nodes: replace(line(pipe, nodes), seabed=seabed(pipe.length * nodes))

    return [
        Variant(AS_IT_IS, lambda nodes: repeated(inputs, copies_for(inputs, nodes)), lies=True),
        Variant(CURVE, having("curve")),
        Variant("linear law", having("linear")),
        Variant("linear law, smoothing", having("smoothed")),
        Variant("curve, nodal springs", having("curve", "nodal")),
        Variant("curve, unloading", having("curve", "unloading")),
        Variant("curve, suction springs", having("curve", "suction spring")),
        Variant("curve, suction", having("curve", "suction")),
        Variant("curve, lateral springs", having("curve", "lateral")),
        Variant("curve, friction", having("curve", "friction")),
        Variant("curve, friction, trench", having("curve", "friction", "trench peak")),
        Variant("curve, sloping bed", on(lambda _: sloping())),
        Variant("curve, 2 planes", on(lambda reach: planes(2, reach))),
        Variant("curve, profile", on(lambda reach: profile(100, reach))),
        Variant("curve, scattered points", on(lambda reach: scattered(400, reach))),
        Variant(EVERYTHING, lambda nodes: everything(pipe, nodes)),
    ]


def everything(pipe: Pipe, nodes: int) -> ContactInput:
    """Every law on every element and node, curves and linear laws alternating, on two planes."""
    by_turns = [
        replace(law, rows=law.rows[first::2])
        for first, law in enumerate(law_everywhere(name, pipe, nodes) for name in ("curve", "smoothed"))
    ]
    return replace(
        line(pipe, nodes),
        laws=(*by_turns, *(law_everywhere(law, pipe, nodes) for law in _BESIDE)),
        seabed=planes(2, pipe.length * nodes),
    )


def law_everywhere(law: str, pipe: Pipe, nodes: int) -> LawAssignment:
    """A law of this name on a chain of nodes."""
    rows = np.arange(nodes if law_named(law).acts_on == "nodes" else nodes - 1)
    parameters = _numbers(pipe)[law]
    if law == "friction":
        parameters = {**parameters, "elliptic": rows % 2 == 0}
    return LawAssignment(law, rows, parameters)


def _numbers(pipe: Pipe) -> dict[str, Mapping[str, ArrayLike]]:
    """Parameters by law; zones of a hundredth of the diameter, a peak of a tenth of the stiffness at each node."""
    size, stiffness = pipe.diameter, pipe.stiffness
    zone = {"stiffness": stiffness, "half_width": 0.01 * size}
    return {
        "curve": {"curve": 0},
        "linear": {"stiffness": stiffness},
        "smoothed": zone,
        "nodal": zone,
        "unloading": {"stiffness": 2.0 * stiffness},
        "suction spring": {"stiffness": 0.1 * stiffness, "extent": 0.2 * size},
        "suction": from_cohesion(np.array(COHESION), np.array(size))._asdict(),
        "friction": {
            "axial_coefficient": 0.35,
            "lateral_coefficient": 0.6,
            "axial_mobilisation": 0.01 * size,
            "lateral_mobilisation": 0.1 * size,
        },
        "lateral": {"stiffness": 0.1 * stiffness},
        "trench peak": {"bottom": 2.0 * size, "upper": 4.0 * size, "peak": 0.1 * stiffness * size / pipe.length},
    }


def repeated(inputs: ContactInput, copies: int) -> ContactInput:
    """Copies of an input side by side, each with the order of nodes and elements of the deck."""
    nodes, elements = len(inputs.node_ids), len(inputs.element_ids)
    first = np.repeat(np.arange(copies), elements)[:, None] * nodes
    return replace(
        inputs,
        node_ids=np.arange(1, copies * nodes + 1),
        coordinates=np.tile(inputs.coordinates, (copies, 1)),
        element_ids=np.arange(1, copies * elements + 1),
        element_nodes=np.tile(inputs.element_nodes, (copies, 1)) + first,
        length=np.tile(inputs.length, copies),
        diameter=np.tile(inputs.diameter, copies),
        laws=tuple(
            _repeated(given, copies, nodes if given.law.acts_on == "nodes" else elements)
            for given in inputs.assigned.values()
        ),
        weight=None if inputs.weight is None else np.tile(inputs.weight, copies),
    )


def copies_for(inputs: ContactInput, nodes: int) -> int:
    """How many copies of an input have about this number of nodes; at least one."""
    return max(1, round(nodes / max(len(inputs.node_ids), 1)))


def with_curve(inputs: ContactInput, pipe: Pipe) -> ContactInput:
    """The elements of an input, in their order, with the curve and the diameter of the pipe and nothing else."""
    elements = len(inputs.element_ids)
    return ContactInput(
        node_ids=inputs.node_ids,
        coordinates=inputs.coordinates,
        element_ids=inputs.element_ids,
        element_nodes=inputs.element_nodes,
        length=inputs.length,
        diameter=np.full(elements, pipe.diameter),
        laws=(LawAssignment("curve", np.arange(elements), {"curve": 0}),),
        curves=(pipe.curve,),
    )


def _repeated(given: AssignedLaw, copies: int, count: int) -> LawAssignment:
    """A law on the copies of `count` elements or nodes."""
    rows = np.tile(given.rows, copies) + np.repeat(np.arange(copies), len(given.rows)) * count
    return LawAssignment(
        given.law.name, rows, {name: np.tile(values, copies) for name, values in given.parameters.items()}
    )


def chain(nodes: int) -> IndexArray:
    """The nodes (m, 2) of elements that follow each other."""
    found: IndexArray = np.column_stack([np.arange(nodes - 1), np.arange(1, nodes)])
    return found


# -------------------------------------------------------------------------------------------------------------- seabeds


def planes(number: int, reach: float) -> PlanesSeabed:
    """A valley of this many planes over lengths 0 to `reach`; one more plane is steeper than the one before."""
    places = np.linspace(0.0, reach, number)
    points = np.column_stack([np.zeros(number), places, np.zeros(number)])
    return PlanesSeabed(points, np.linspace(0.0, _RISE, number))


def profile(points: int, reach: float) -> ProfileSeabed:
    """A cubic through waves."""
    places = np.linspace(0.0, reach, points)
    return ProfileSeabed(places, _RISE * np.sin(places / reach * 20.0), "CUBIC BESSEL")


def sloping() -> SlopingSeabed:
    """One slope, turned to the line."""
    return SlopingSeabed(_RISE, 30.0)


def scattered(points: int, reach: float) -> Seabed:
    """A plain strip of triangles about the line; raises ImportError without scipy."""
    from mudline.contact.seabed.scattered import ScatteredSeabed  # noqa: PLC0415 - only this seabed needs scipy

    rng = np.random.default_rng(1)
    along = np.concatenate([[-reach, -reach, 2.0 * reach, 2.0 * reach], rng.uniform(0.0, reach, points - 4)])
    across = np.concatenate([[-reach, reach, -reach, reach], rng.uniform(-0.1 * reach, 0.1 * reach, points - 4)])
    return ScatteredSeabed(np.column_stack([_RISE * np.sin(along / reach * 20.0), along, across]))


# ------------------------------------------------------------------------------------------------------------ positions


def positions(variant: Variant, inputs: ContactInput, pipe: Pipe) -> FloatArray:
    """Positions (n, 3): those of the deck, or from the seabed down to a quarter of the diameter, at random."""
    points = inputs.coordinates.copy()
    if not variant.lies:
        y, z = points[:, 1].copy(), points[:, 2].copy()
        level = np.zeros(len(points)) if inputs.seabed is None else inputs.seabed.elevation(y, z)
        points[:, 0] = level - np.random.default_rng(3).uniform(0.01, _DEEPEST, len(points)) * pipe.diameter
    return points


def series(points: FloatArray, pipe: Pipe, steps: int = STEPS) -> FloatArray:
    """Positions (steps, n, 3) of nodes that are moved up by a part of the diameter, along and across the line."""
    waves = np.sin(2.0 * np.pi / _WAVE * np.arange(len(points)))
    lift = pipe.diameter * np.maximum(0.4 * waves, -0.02)
    drag = 0.02 * pipe.diameter
    moved = np.empty((steps, *points.shape))
    for step in range(steps):
        moved[step] = points
        if step % STEPS:
            moved[step, :, 0] += lift
        if step % STEPS == STEPS - 1:
            moved[step, :, 1:] += drag
    return moved
