"""The scenes whose cost is compared: the deck's own, each stage beside the curve, everything at once."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.contact.extras import Extras
from mudline.contact.floors import Floor
from mudline.contact.inputs import ContactInput, LawKind
from mudline.curves import ForceCurve
from mudline.study.pruning import beds, forced
from mudline.study.pruning.tiling import chain, tiled

AS_IT_IS, CURVE, EVERYTHING = "scene as it is", "curve", "everything"


class Pipe(NamedTuple):
    """What the forced stages are made for: a curve, its steepest slope as stiffness, a diameter, an element length."""

    curve: ForceCurve
    stiffness: float
    diameter: float
    length: float


@dataclass(frozen=True, slots=True)
class Variant:
    """A scene of any size.

    Attributes:
        name: for tables.
        make: gives the input with so many nodes.
        lies: whether the nodes stay where the deck has them, instead of being pressed into the bed.
    """

    name: str
    make: Callable[[int], ContactInput]
    lies: bool = False


def pipe_of(inputs: ContactInput, usual: ForceCurve) -> Pipe:
    """The curve that most elements have (`usual` if none has any), the middle diameter and length of the elements."""
    indices = inputs.curve_index[inputs.with_law(LawKind.CURVE)]
    curve = inputs.curves[int(np.bincount(indices).argmax())] if indices.size else usual
    diameter = _middle(inputs.diameter, 0.3)
    return Pipe(curve, float(np.abs(curve.slopes).max()) / diameter or 1.0, diameter, _middle(inputs.length, 1.0))


def line(pipe: Pipe, nodes: int, law: LawKind = LawKind.CURVE) -> ContactInput:
    """A straight line along Y with one law and nothing else."""
    elements = nodes - 1
    points = np.zeros((nodes, 3))
    points[:, 1] = pipe.length * np.arange(nodes)
    on_curve = law is LawKind.CURVE
    return ContactInput(
        node_ids=np.arange(1, nodes + 1),
        coordinates=points,
        element_ids=np.arange(1, nodes),
        element_nodes=chain(nodes),
        length=np.full(elements, pipe.length),
        diameter=np.full(elements, pipe.diameter),
        law=np.full(elements, law, np.int8),
        curve_index=np.full(elements, 0 if on_curve else -1),
        curves=(pipe.curve,) if on_curve else (),
        linear_stiffness=np.full(elements, np.nan if on_curve else pipe.stiffness),
    )


def variants(inputs: ContactInput, pipe: Pipe) -> list[Variant]:
    """All of them, the deck's own first, everything at once last."""
    size, stiffness = pipe.diameter, pipe.stiffness

    def beside(extras: Callable[[int], Extras], law: LawKind = LawKind.CURVE) -> Callable[[int], ContactInput]:
        return lambda nodes: replace(line(pipe, nodes, law), extras=extras(nodes))

    def on(floor: Callable[[float], Floor]) -> Callable[[int], ContactInput]:
        return lambda nodes: replace(line(pipe, nodes), floor=floor(pipe.length * nodes))

    return [
        Variant(AS_IT_IS, lambda nodes: tiled(inputs, nodes), lies=True),
        Variant(CURVE, lambda nodes: line(pipe, nodes)),
        Variant("linear law", lambda nodes: line(pipe, nodes, LawKind.LINEAR)),
        Variant(
            "linear law, smoothing",
            beside(lambda nodes: Extras(smoothing=forced.smoothing(nodes - 1, size)), LawKind.LINEAR),
        ),
        Variant("curve, nodal springs", beside(lambda nodes: Extras(nodal=forced.nodal(nodes, size, stiffness)))),
        Variant("curve, unloading", beside(lambda nodes: Extras(unloading=forced.unloading(nodes - 1, stiffness)))),
        Variant(
            "curve, suction springs",
            beside(lambda nodes: Extras(suction_springs=forced.suction_springs(nodes - 1, size, stiffness))),
        ),
        Variant("curve, suction", beside(lambda nodes: Extras(suction=forced.suction(nodes - 1, size)))),
        Variant("curve, lateral springs", beside(lambda nodes: Extras(lateral=forced.lateral(nodes - 1, stiffness)))),
        Variant("curve, friction", beside(lambda nodes: Extras(friction=forced.friction(nodes, size)))),
        Variant(
            "curve, friction, trench",
            beside(
                lambda nodes: Extras(
                    friction=forced.friction(nodes, size), trench=forced.trench(nodes, size, stiffness)
                )
            ),
        ),
        Variant("curve, sloping bed", on(lambda _: beds.sloping())),
        Variant("curve, 2 planes", on(lambda reach: beds.planes(2, reach))),
        Variant("curve, profile", on(lambda reach: beds.profile(100, reach))),
        Variant("curve, scattered points", on(lambda reach: beds.scattered(400, reach))),
        Variant(EVERYTHING, lambda nodes: everything(pipe, nodes)),
    ]


def everything(pipe: Pipe, nodes: int) -> ContactInput:
    """Every stage on every element and node, curves and linear laws by turns, on two planes."""
    elements, size, stiffness = nodes - 1, pipe.diameter, pipe.stiffness
    on_curve = np.arange(elements) % 2 == 0
    extras = Extras(
        smoothing=forced.smoothing(elements, size),
        nodal=forced.nodal(nodes, size, stiffness),
        unloading=forced.unloading(elements, stiffness),
        suction_springs=forced.suction_springs(elements, size, stiffness),
        suction=forced.suction(elements, size),
        friction=forced.friction(nodes, size),
        lateral=forced.lateral(elements, stiffness),
        trench=forced.trench(nodes, size, stiffness),
    )
    return replace(
        line(pipe, nodes),
        law=np.where(on_curve, LawKind.CURVE, LawKind.LINEAR).astype(np.int8),
        curve_index=np.where(on_curve, 0, -1),
        linear_stiffness=np.where(on_curve, np.nan, stiffness),
        floor=beds.planes(2, pipe.length * nodes),
        extras=extras,
    )


def _middle(values: FloatArray, default: float) -> float:
    usable = values[np.isfinite(values) & (values > 0.0)]
    return float(np.median(usable)) if usable.size else default
