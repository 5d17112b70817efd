"""Chains of elements along Y, numbered as decks number them: nodes from 101, elements from 11."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mudline.contact import ContactInput, LawKind, Tension
from mudline.curves import ForceCurve

CLAY = ForceCurve([(0.0, 0.0), (0.1, 2000.0), (0.3, 4500.0), (0.5, 6000.0)], name="clay")
SAND = ForceCurve([(0.0, 0.0), (1.0, 40000.0)], name="sand")
PULLING = ForceCurve([(0.1, -100.0), (0.2, 100.0), (0.4, 900.0)], name="pulling")
NONE, CURVE, LINEAR, RIGID = LawKind.NONE, LawKind.CURVE, LawKind.LINEAR, LawKind.RIGID


def chain(
    laws: Sequence[LawKind],
    *,
    curves: tuple[ForceCurve, ...] = (CLAY,),
    curve_index: Sequence[int] | None = None,
    diameter: ArrayLike = 0.3,
    tension: Tension = "keep",
) -> ContactInput:
    """Elements of length 2 with these laws, the linear ones of stiffness 50000; nodes lie on the bed."""
    count = len(laws)
    law = np.array(laws, np.int8)
    coordinates = np.zeros((count + 1, 3))
    coordinates[:, 1] = 2.0 * np.arange(count + 1)
    return ContactInput(
        node_ids=101 + np.arange(count + 1, dtype=np.int64),
        coordinates=coordinates,
        element_ids=11 + np.arange(count, dtype=np.int64),
        element_nodes=np.column_stack((np.arange(count, dtype=np.intp), 1 + np.arange(count, dtype=np.intp))),
        length=np.full(count, 2.0),
        diameter=np.array(np.broadcast_to(np.asarray(diameter, np.float64), count)),
        law=law,
        curve_index=np.where(law == CURVE, 0 if curve_index is None else np.array(curve_index, np.intp), -1),
        curves=curves,
        linear_stiffness=np.where(law == LINEAR, 50000.0, np.nan),
        tension=tension,
    )


def mixed(count: int, seed: int) -> ContactInput:
    """A chain with every law, two curves, and diameters and lengths of its own for each element."""
    rng = np.random.default_rng(seed)
    laws = rng.choice([NONE, CURVE, LINEAR, RIGID], count, p=[0.1, 0.5, 0.3, 0.1]).tolist()
    inputs = chain([LawKind(law) for law in laws], curves=(CLAY, SAND), curve_index=rng.integers(0, 2, count).tolist())
    return replace(inputs, diameter=rng.uniform(0.1, 0.6, count), length=rng.uniform(0.5, 3.0, count))


def at_depths(depths: ArrayLike) -> NDArray[np.float64]:
    """Positions (..., n, 3) of nodes at these depths (..., n) below the bed."""
    depth = np.asarray(depths, np.float64)
    positions = np.zeros((*depth.shape, 3))
    positions[..., 0] = -depth
    return positions


def depth_at(ratio: float, diameter: float) -> float:
    """The depth whose embedment ratio is exactly `ratio`."""
    depth = ratio * diameter
    near = (depth, float(np.nextafter(depth, -np.inf)), float(np.nextafter(depth, np.inf)))
    return next(candidate for candidate in near if candidate / diameter == ratio)
