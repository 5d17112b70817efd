"""The scenes whose cost is compared, of any size: each law beside a curve, and everything at once."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from mudline.contact.arrays import FloatArray
from mudline.contact.input import ContactInput, LawAssignment
from mudline.contact.laws import law_named
from mudline.contact.laws.suction import from_cohesion
from mudline.contact.seabed import PlanesSeabed, Seabed, SlopingSeabed
from mudline.contact.seabed.profile import ProfileSeabed
from mudline.contact.seabed.scattered import ScatteredSeabed
from tests.builders.contact import CLAY

CURVE, EVERYTHING = "curve", "everything"
DIAMETER, LENGTH = 0.3, 2.0
_STIFFNESS = float(CLAY.slopes.max()) / DIAMETER
_RISE = 0.001
"""Of a seabed over the length: that of a gentle slope."""
_WAVE = 200

_LAWS: dict[str, Mapping[str, ArrayLike]] = {
    "curve": {"curve": 0},
    "linear": {"stiffness": _STIFFNESS},
    "smoothed": {"stiffness": _STIFFNESS, "half_width": 0.003},
    "nodal": {"stiffness": _STIFFNESS, "half_width": 0.003},
    "unloading": {"stiffness": 2.0 * _STIFFNESS},
    "suction spring": {"stiffness": 0.1 * _STIFFNESS, "extent": 0.06},
    "suction": from_cohesion(np.array(5000.0), np.array(DIAMETER))._asdict(),
    "friction": {
        **{"axial_coefficient": 0.35, "lateral_coefficient": 0.6},
        **{"axial_mobilisation": 0.003, "lateral_mobilisation": 0.03},
    },
    "lateral": {"stiffness": 0.1 * _STIFFNESS},
    "trench peak": {"bottom": 0.6, "upper": 1.2, "peak": 0.015 * _STIFFNESS},
}
"""Parameters by law."""


def law_everywhere(law: str, nodes: int) -> LawAssignment:
    """A law of this name on a chain of nodes."""
    rows = np.arange(nodes if law_named(law).acts_on == "nodes" else nodes - 1)
    parameters = {**_LAWS[law], "elliptic": rows % 2 == 0} if law == "friction" else _LAWS[law]
    return LawAssignment(law, rows, parameters)


def line(nodes: int, *laws: str, seabed: Seabed | None = None) -> ContactInput:
    """A straight line along Y with these laws everywhere and nothing else."""
    count = nodes - 1
    points = np.zeros((nodes, 3))
    points[:, 1] = LENGTH * np.arange(nodes)
    return ContactInput(
        node_ids=np.arange(1, nodes + 1),
        coordinates=points,
        element_ids=np.arange(1, nodes),
        element_nodes=np.column_stack([np.arange(count), np.arange(1, nodes)]),
        length=np.full(count, LENGTH),
        diameter=np.full(count, DIAMETER),
        laws=tuple(law_everywhere(law, nodes) for law in laws),
        curves=(CLAY,) if "curve" in laws else (),
        seabed=seabed,
    )


def everything(nodes: int) -> ContactInput:
    """Every law on every element and node, curves and linear laws alternating, on two planes."""
    beside = ("nodal", "unloading", "suction spring", "suction", "friction", "lateral", "trench peak")
    by_turns = [
        replace(law, rows=law.rows[first::2])
        for first, law in enumerate(law_everywhere(name, nodes) for name in ("curve", "smoothed"))
    ]
    return replace(
        line(nodes, "curve", *beside, seabed=planes(2, LENGTH * nodes)),
        laws=(*by_turns, *(law_everywhere(law, nodes) for law in beside)),
    )


def planes(number: int, reach: float) -> PlanesSeabed:
    """A valley of this many planes over lengths 0 to `reach`; one more plane is steeper than the one before."""
    points = np.column_stack([np.zeros(number), np.linspace(0.0, reach, number), np.zeros(number)])
    return PlanesSeabed(points, np.linspace(0.0, _RISE, number))


def _profile(reach: float) -> ProfileSeabed:
    places = np.linspace(0.0, reach, 100)
    return ProfileSeabed(places, _RISE * np.sin(places / reach * 20.0), "CUBIC BESSEL")


def _scattered(reach: float) -> ScatteredSeabed:
    """A plain strip of triangles about the line."""
    rng = np.random.default_rng(1)
    along = np.concatenate([[-reach, -reach, 2.0 * reach, 2.0 * reach], rng.uniform(0.0, reach, 396)])
    across = np.concatenate([[-reach, reach, -reach, reach], rng.uniform(-0.1 * reach, 0.1 * reach, 396)])
    return ScatteredSeabed(np.column_stack([_RISE * np.sin(along / reach * 20.0), along, across]))


def _having(*laws: str) -> Callable[[int], ContactInput]:
    return lambda nodes: line(nodes, *laws)


def _on(seabed: Callable[[float], Seabed]) -> Callable[[int], ContactInput]:
    return lambda nodes: line(nodes, "curve", seabed=seabed(LENGTH * nodes))


SCENES: dict[str, Callable[[int], ContactInput]] = {
    CURVE: _having("curve"),
    "linear law": _having("linear"),
    "linear law, smoothing": _having("smoothed"),
    "curve, nodal springs": _having("curve", "nodal"),
    "curve, unloading": _having("curve", "unloading"),
    "curve, suction springs": _having("curve", "suction spring"),
    "curve, suction": _having("curve", "suction"),
    "curve, lateral springs": _having("curve", "lateral"),
    "curve, friction": _having("curve", "friction"),
    "curve, friction, trench": _having("curve", "friction", "trench peak"),
    "curve, sloping bed": _on(lambda _: SlopingSeabed(_RISE, 30.0)),
    "curve, 2 planes": _on(lambda reach: planes(2, reach)),
    "curve, profile": _on(_profile),
    "curve, scattered points": _on(_scattered),
    EVERYTHING: everything,
}
"""By name, of a number of nodes."""


def positions(inputs: ContactInput) -> FloatArray:
    """Positions (n, 3) from the seabed down to a quarter of the diameter, at random: every element touches."""
    points = inputs.coordinates.copy()
    y, z = points[:, 1].copy(), points[:, 2].copy()
    level = np.zeros(len(points)) if inputs.seabed is None else inputs.seabed.elevation(y, z)
    points[:, 0] = level - np.random.default_rng(3).uniform(0.01, 0.25, len(points)) * DIAMETER
    return points


def series(points: FloatArray, steps: int) -> FloatArray:
    """Positions (steps, n, 3) of nodes that are laid, lifted in waves, and dragged, by parts of the diameter."""
    waves = np.sin(2.0 * np.pi / _WAVE * np.arange(len(points)))
    moved = np.repeat(points[None], steps, axis=0)
    turn = np.arange(steps) % 3
    moved[turn > 0, :, 0] += DIAMETER * np.maximum(0.4 * waves, -0.02)
    moved[turn == 2, :, 1:] += 0.02 * DIAMETER
    return moved
