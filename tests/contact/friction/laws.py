"""Friction laws and paths of single nodes for the tests."""

from __future__ import annotations

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.contact.friction.law import FrictionHistory, FrictionLaw, FrictionState
from mudline.contact.friction.return_mapping import ExtraLimit, FrictionForce, slide

U1 = np.array([[0.0, 1.0, 0.0]])
U2 = np.array([[0.0, 0.0, 1.0]])
STICK, SLIP, OPEN = FrictionState.STICK, FrictionState.SLIP, FrictionState.OPEN


def law(
    coefficients: tuple[float, float],
    stiffness: float | tuple[float, float] = np.nan,
    *,
    mobilisation: float = np.nan,
    ellipse: bool = False,
) -> FrictionLaw:
    """The law of one node."""
    spring = np.broadcast_to(np.asarray(stiffness, dtype=np.float64), (2,)).reshape(1, 2).copy()
    return FrictionLaw(
        np.array([coefficients]),
        spring,
        np.full((1, 2), mobilisation),
        np.array([ellipse]),
        np.array([True]),
    )


def pressed(first: float, second: float, height: float = 0.0) -> FloatArray:
    """A point by its offsets along u1 and u2."""
    return np.array([[height, first, second]])


def anchored(held: FrictionLaw, at: FloatArray | None = None) -> FrictionHistory:
    """A node that touched down at a point, the origin unless told."""
    place = pressed(0.0, 0.0) if at is None else at
    return slide(held, FrictionHistory.start(held), place, (U1, U2), np.array([1.0])).history


def move(
    held: FrictionLaw,
    history: FrictionHistory,
    to: tuple[float, float],
    compression: float,
    extra: ExtraLimit | None = None,
) -> FrictionForce:
    """One step of a single node."""
    return slide(held, history, pressed(*to), (U1, U2), np.array([compression]), extra)
