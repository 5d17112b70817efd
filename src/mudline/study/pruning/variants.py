"""The scenes whose cost is compared: the deck's own, each law beside the curve, everything at once."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mudline.contact.input import ContactInput
from mudline.contact.seabed import Seabed
from mudline.study.pruning import seabeds
from mudline.study.pruning.forced import forced
from mudline.study.pruning.pipe import Pipe
from mudline.study.pruning.tiling import chain, tiled

AS_IT_IS, CURVE, EVERYTHING = "scene as it is", "curve", "everything"
_BESIDE = ("nodal", "unloading", "suction spring", "suction", "friction", "lateral", "trench peak")
"""What everything has besides normal laws of its elements."""


@dataclass(frozen=True, slots=True)
class Variant:
    """A scene of any size.

    Attributes:
        name: for tables.
        make: gives the input with so many nodes.
        lies: whether the nodes stay where the deck has them, instead of being pressed into the seabed.
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
        laws=tuple(forced(law, pipe, nodes) for law in laws),
        curves=(pipe.curve,) if "curve" in laws else (),
    )


def variants(inputs: ContactInput, pipe: Pipe) -> list[Variant]:
    """All of them, the deck's own first, everything at once last."""

    def having(*laws: str) -> Callable[[int], ContactInput]:
        return lambda nodes: line(pipe, nodes, laws)

    def on(seabed: Callable[[float], Seabed]) -> Callable[[int], ContactInput]:
        return lambda nodes: replace(line(pipe, nodes), seabed=seabed(pipe.length * nodes))

    return [
        Variant(AS_IT_IS, lambda nodes: tiled(inputs, nodes), lies=True),
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
        Variant("curve, sloping bed", on(lambda _: seabeds.sloping())),
        Variant("curve, 2 planes", on(lambda reach: seabeds.planes(2, reach))),
        Variant("curve, profile", on(lambda reach: seabeds.profile(100, reach))),
        Variant("curve, scattered points", on(lambda reach: seabeds.scattered(400, reach))),
        Variant(EVERYTHING, lambda nodes: everything(pipe, nodes)),
    ]


def everything(pipe: Pipe, nodes: int) -> ContactInput:
    """Every law on every element and node, curves and linear laws by turns, on two planes."""
    by_turns = [
        replace(law, rows=law.rows[first::2])
        for first, law in enumerate(forced(name, pipe, nodes) for name in ("curve", "smoothed"))
    ]
    return replace(
        line(pipe, nodes),
        laws=(*by_turns, *(forced(law, pipe, nodes) for law in _BESIDE)),
        seabed=seabeds.planes(2, pipe.length * nodes),
    )
