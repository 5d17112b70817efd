"""One step of friction: trial springs, limits, what slips, and the derivatives that go with it.

The scheme is the return mapping of elastic-plastic models. The tangent is consistent with it: a spring that sticks has
its stiffness, one that slips follows its limit, which follows the normal force, so the matrix of a node is unsymmetric.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mudline.contact.arrays import BoolArray, FloatArray, IndexArray
from mudline.contact.friction.law import FrictionHistory, FrictionLaw, FrictionState
from mudline.contact.vectors import dot, scaled


@dataclass(frozen=True, slots=True, eq=False)
class ExtraLimit:
    """What a trench adds to the lateral limit of nodes (n,).

    Attributes:
        force: added force, >= 0.
        slope: its derivative by the offset along u2.
        outward: +1 where motion along +u2 leads out of the trench, -1 where that along -u2 does, 0 for neither.
    """

    force: FloatArray
    slope: FloatArray
    outward: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class FrictionForce:
    """Friction on the pipe at nodes (n,), along u1 and u2.

    Attributes:
        force: (n, 2) force on the pipe.
        by_position: (n, 2, 2) d force[i] / d (elongation along u_j), at one normal force and limit.
        by_offset: (n, 2) d force[i] / d (offset from the centreline of a trench).
        by_compression: (n, 2) d force[i] / d N.
        elongation: (n, 2) way from the anchor before the step, along u1 and u2.
        dissipated: (n,) work done against slipping in this step, >= 0.
        history: what the next step begins with.
    """

    force: FloatArray
    by_position: FloatArray
    by_offset: FloatArray
    by_compression: FloatArray
    elongation: FloatArray
    dissipated: FloatArray
    history: FrictionHistory


class _Limits(NamedTuple):
    """Limits (n, 2) on the side that the trial lies on, and their derivatives by N and by the offset along u2."""

    force: FloatArray
    by_compression: FloatArray
    by_offset: FloatArray


class _Springs(NamedTuple):
    """Springs (n, 2), their elongations, the trial forces in them and the derivatives of these by N."""

    stiffness: FloatArray
    elongation: FloatArray
    trial: FloatArray
    by_compression: FloatArray


class _Mapped(NamedTuple):
    """Spring forces (n, 2), their derivatives (n, 2, 2), (n, 2) and (n, 2), and what slips (n, 2)."""

    force: FloatArray
    by_position: FloatArray
    by_offset: FloatArray
    by_compression: FloatArray
    slips: BoolArray


def slide(
    law: FrictionLaw,
    history: FrictionHistory,
    points: FloatArray,
    directions: tuple[FloatArray, FloatArray],
    compression: FloatArray,
    extra: ExtraLimit | None = None,
) -> FrictionForce:
    """Move nodes to `points` (n, 3) under normal forces `compression` (n,); only what presses counts.

    `directions` are u1 and u2, each (n, 3). A node without normal force is open and forgets its anchor; one that is
    pressed on again gets a new one where it stands.
    """
    closed = law.active & (compression > 0.0)
    anchored = closed & (history.states[:, 0] > FrictionState.OPEN)
    anchors = np.where(anchored[:, None], history.anchors, points)
    way = points - anchors
    elongation = np.empty((len(points), 2))
    for side, axis in enumerate(directions):
        elongation[:, side] = dot(axis, way)
    springs = _springs(law, np.where(closed, compression, 0.0), elongation)
    limits = _limits(law, springs, np.where(closed, compression, 0.0), extra)
    mapped = _box(springs, limits)
    curved = np.flatnonzero(law.ellipse & closed)
    if curved.size:
        _ellipses_in(mapped, curved, springs, limits)
    stretch = np.where(springs.stiffness > 0.0, mapped.force / springs.stiffness, elongation)
    moved = np.where(mapped.slips, elongation - stretch, 0.0)
    for side, axis in enumerate(directions):
        anchors += scaled(axis, moved[:, side])
    states = np.where(mapped.slips, FrictionState.SLIP, FrictionState.STICK)
    return FrictionForce(
        _on_pipe(mapped.force, closed),
        _on_pipe(mapped.by_position, anchored),  # where it touches down there is no force, wherever that is
        _on_pipe(mapped.by_offset, closed),
        _on_pipe(mapped.by_compression, closed),
        springs.elongation,
        np.where(closed, mapped.force[:, 0] * moved[:, 0] + mapped.force[:, 1] * moved[:, 1], 0.0),
        _remembered(law, closed, anchors, states.astype(np.int8)),
    )


def _springs(law: FrictionLaw, compression: FloatArray, elongation: FloatArray) -> _Springs:
    stiffness, rising = law.springs(compression)
    return _Springs(stiffness, elongation, stiffness * elongation, rising * elongation)


def _limits(law: FrictionLaw, springs: _Springs, compression: FloatArray, extra: ExtraLimit | None) -> _Limits:
    limits = law.coefficients * compression[:, None]
    by_offset = np.zeros_like(limits)
    if extra is not None:
        against = (extra.outward != 0.0) & (np.sign(springs.trial[:, 1]) == extra.outward)
        limits[:, 1] += np.where(against, extra.force, 0.0)
        by_offset[:, 1] = np.where(against, extra.slope, 0.0)
    return _Limits(limits, law.coefficients, by_offset)


def _box(springs: _Springs, limits: _Limits) -> _Mapped:
    """Each direction for itself."""
    slips = np.abs(springs.trial) > limits.force
    side = np.sign(springs.trial)
    force = np.where(slips, side * limits.force, springs.trial)
    by_position = np.zeros((*force.shape, 2))
    for axis in range(2):
        by_position[:, axis, axis] = np.where(slips[:, axis], 0.0, springs.stiffness[:, axis])
    by_offset = np.where(slips, side * limits.by_offset, 0.0)
    by_compression = np.where(slips, side * limits.by_compression, springs.by_compression)
    return _Mapped(force, by_position, by_offset, by_compression, slips)


def _ellipse(springs: _Springs, limits: _Limits) -> _Mapped:
    """Both directions together: a trial outside the ellipse of the limits is drawn back along its own direction."""
    able = limits.force > 0.0
    trial = np.where(able, springs.trial, 0.0)
    share = np.divide(trial, limits.force, out=np.zeros_like(trial), where=able)
    gauge = np.hypot(share[:, 0], share[:, 1])
    slides = gauge > 1.0
    scale = np.where(slides, gauge, 1.0)[:, None]
    force = trial / scale
    unit = np.where(slides[:, None] & able, share / scale, 0.0)
    # relative change of the gauge with a trial force and, falling, with a limit
    by_trial = np.divide(unit, limits.force * scale, out=np.zeros_like(trial), where=able)
    by_limit = np.divide(unit * unit, limits.force, out=np.zeros_like(trial), where=able)
    stiffness = np.where(able, springs.stiffness, 0.0)
    growth_by_position = by_trial * stiffness
    growth_by_offset = 0.0 - (by_limit * limits.by_offset).sum(axis=1)
    trial_by_n = np.where(able, springs.by_compression, 0.0)
    growth_by_n = (by_trial * trial_by_n - by_limit * limits.by_compression).sum(axis=1)
    by_position = -force[:, :, None] * growth_by_position[:, None, :]
    for axis in range(2):
        by_position[:, axis, axis] += stiffness[:, axis] / scale[:, 0]
    by_offset = 0.0 - force * growth_by_offset[:, None]
    by_compression = trial_by_n / scale - force * growth_by_n[:, None]
    slips = slides[:, None] | (~able & (springs.trial != 0.0))
    return _Mapped(force, by_position, by_offset, by_compression, slips)


def _ellipses_in(mapped: _Mapped, nodes: IndexArray, springs: _Springs, limits: _Limits) -> None:
    """Put the mapping of the ellipses in the place of that of the boxes at `nodes`."""
    by_ellipse = _ellipse(
        _Springs(*(values.take(nodes, axis=0) for values in springs)),
        _Limits(*(values.take(nodes, axis=0) for values in limits)),
    )
    for whole, values in zip(mapped, by_ellipse, strict=True):
        whole[nodes] = values


def _on_pipe(values: FloatArray, closed: BoolArray) -> FloatArray:
    """The reaction to what the springs feel; nothing where a node is open, and no -0."""
    shape = (-1,) + (1,) * (values.ndim - 1)
    return np.where(closed.reshape(shape), 0.0 - values, 0.0)


def _remembered(law: FrictionLaw, closed: BoolArray, anchors: FloatArray, states: NDArray[np.int8]) -> FrictionHistory:
    open_ = np.where(law.active, FrictionState.OPEN, FrictionState.NONE).astype(np.int8)
    return FrictionHistory(
        np.where(closed[:, None], anchors, np.nan), np.where(closed[:, None], states, open_[:, None])
    )
