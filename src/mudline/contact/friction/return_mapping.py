"""One step of friction: trial springs, limits, what slips, and the derivatives that go with it.

The scheme is the return mapping of elastic-plastic models. The tangent is consistent with it: a spring that sticks has
its stiffness, one that slips follows its limit, which follows the normal force, so the matrix of a node is unsymmetric.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from mudline.contact.arrays import BoolArray, FloatArray, IndexArray, StateArray
from mudline.contact.friction.law import FrictionHistory, FrictionLaw, FrictionState
from mudline.contact.vectors import blank, dot, gathered, nothing


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


class PreparedLaw:
    """A law as the steps want it, columns in one piece.

    Attributes:
        law: the law itself.
        constant, rising: the springs (n, 2) under a normal force N are constant + rising N.
        coefficients: (n, 2) Coulomb coefficients.
        curved: nodes with an ellipse.
        idle: (n, 2) states of nodes that are open.
    """

    def __init__(self, law: FrictionLaw) -> None:
        self.law = law
        with np.errstate(all="ignore"):
            rising = np.where(law.constant, 0.0, law.coefficients / law.mobilisation)
        self.constant = np.asfortranarray(np.where(law.constant, law.stiffness, 0.0))
        self.rising = np.asfortranarray(rising)
        self.coefficients = np.asfortranarray(law.coefficients)
        self.curved: IndexArray = np.flatnonzero(law.ellipse & law.active)
        self.idle = FrictionHistory.start(law).states


class Limits(NamedTuple):
    """Limits (n, 2) on the side that the trial lies on, and where (n,) the trench is part of the lateral one."""

    force: FloatArray
    against: BoolArray | None


class Springs(NamedTuple):
    """Springs (n, 2), their elongations and the trial forces in them."""

    stiffness: FloatArray
    elongation: FloatArray
    trial: FloatArray


class Moved(NamedTuple):
    """One step of nodes (n,), without derivatives.

    force: (n, 2) force on the pipe.
    springs, limits: what the trial was made of.
    slips: (n, 2) what is at its limit.
    moved: (n, 2) ways that the anchors were dragged along u1 and u2.
    closed, anchored: (n,) nodes that are pressed on, and those of them that were before.
    history: what the next step begins with.
    """

    force: FloatArray
    springs: Springs
    limits: Limits
    slips: BoolArray
    moved: FloatArray
    closed: BoolArray
    anchored: BoolArray
    history: FrictionHistory


class Gauge(NamedTuple):
    """Trials of nodes (k,) against their ellipses.

    able: (k, 2) directions that have a limit. trial: (k, 2) trials in these. share: (k, 2) trial / limit. slides: (k,)
    where the trial is outside. scale: (k,) what it is divided by to lie on the ellipse, or 1.
    """

    able: BoolArray
    trial: FloatArray
    share: FloatArray
    slides: BoolArray
    scale: FloatArray


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
    from mudline.contact.friction.derivatives import with_derivatives  # noqa: PLC0415 - forces alone do without it

    held = PreparedLaw(law)
    return with_derivatives(held, move(held, history, points, directions, compression, extra), extra)


def move(
    held: PreparedLaw,
    history: FrictionHistory,
    points: FloatArray,
    directions: tuple[FloatArray, FloatArray],
    compression: FloatArray,
    extra: ExtraLimit | None = None,
) -> Moved:
    """The same without derivatives."""
    closed = held.law.active & (compression > 0.0)
    anchored = closed & (history.states[:, 0] > FrictionState.OPEN)
    pressing = np.where(closed, compression, 0.0)
    anchors = _anchors(history.anchors, anchored, points)
    springs = _springs(held, pressing, directions, points - anchors)
    limits = _limits(held, springs.trial, pressing, extra)
    force, slips = _in_box(springs.trial, limits.force)
    _into_ellipses(force, slips, held.curved, springs.trial, limits.force)
    moved = _drag(anchors, directions, springs, force, slips)
    states = _left_behind(held, closed, anchors, slips)
    np.subtract(0.0, force, out=force)  # the reaction to what the springs feel, and no -0
    return Moved(force, springs, limits, slips, moved, closed, anchored, FrictionHistory(anchors, states))


def _anchors(before: FloatArray, anchored: BoolArray, points: FloatArray) -> FloatArray:
    """Anchors (n, 3), which stand at the nodes where there were none."""
    anchors = np.array(before, order="F")
    (new,) = (~anchored).nonzero()
    for anchor, place in zip(anchors.T, points.T, strict=True):
        anchor[new] = place[new]
    return anchors


def _springs(
    held: PreparedLaw, pressing: FloatArray, directions: tuple[FloatArray, FloatArray], way: FloatArray
) -> Springs:
    """Springs whose anchors are `way` (n, 3) behind."""
    elongation = blank(len(way), 2)
    for side, axis in enumerate(directions):
        elongation[:, side] = dot(axis, way)
    stiffness = held.rising * pressing[:, None]
    stiffness += held.constant
    return Springs(stiffness, elongation, stiffness * elongation)


def _limits(held: PreparedLaw, trial: FloatArray, pressing: FloatArray, extra: ExtraLimit | None) -> Limits:
    limits = held.coefficients * pressing[:, None]
    if extra is None:
        return Limits(limits, None)
    against = (extra.outward != 0.0) & (np.sign(trial[:, 1]) == extra.outward)
    limits[:, 1] += extra.force * against
    return Limits(limits, against)


def _in_box(trial: FloatArray, limits: FloatArray) -> tuple[FloatArray, BoolArray]:
    """Each direction for itself: the forces in the springs, and what slips."""
    slips = np.abs(trial) > limits
    force = np.minimum(trial, limits)
    return np.maximum(force, -limits, out=force), slips


def gauge(trial: FloatArray, limits: FloatArray) -> Gauge:
    """Trials (k, 2) against the ellipses of their limits."""
    able = limits > 0.0
    trial = np.where(able, trial, 0.0)
    share = trial / np.where(able, limits, 1.0)
    size = np.hypot(share[:, 0], share[:, 1])
    slides = size > 1.0
    return Gauge(able, trial, share, slides, np.where(slides, size, 1.0))


def _into_ellipses(
    force: FloatArray, slips: BoolArray, nodes: IndexArray, trial: FloatArray, limits: FloatArray
) -> None:
    """Both directions together, at `nodes`: a trial outside of the ellipse is drawn back along its own direction."""
    if not nodes.size:
        return
    tried = gathered(trial, nodes)
    found = gauge(tried, gathered(limits, nodes))
    lost = ~found.able & (tried != 0.0)  # a direction without a limit holds nothing
    for side in range(2):
        force[:, side][nodes] = found.trial[:, side] / found.scale
        slips[:, side][nodes] = found.slides | lost[:, side]


def _drag(
    anchors: FloatArray,
    directions: tuple[FloatArray, FloatArray],
    springs: Springs,
    force: FloatArray,
    slips: BoolArray,
) -> FloatArray:
    """Drag the anchors of what slips to where the spring bears its force; return the ways (n, 2)."""
    moved = nothing(len(anchors), 2)
    for side, axis in enumerate(directions):
        (nodes,) = slips[:, side].nonzero()
        stiffness, elongation = springs.stiffness[:, side][nodes], springs.elongation[:, side][nodes]
        stretch = np.where(stiffness > 0.0, force[:, side][nodes] / stiffness, elongation)
        moved[:, side][nodes] = way = elongation - stretch
        for anchor, share in zip(anchors.T, axis.T, strict=True):
            anchor[nodes] += share[nodes] * way
    return moved


def _left_behind(held: PreparedLaw, closed: BoolArray, anchors: FloatArray, slips: BoolArray) -> StateArray:
    """The states; open nodes forget their anchors."""
    states = slips.astype(np.int8)
    states += np.int8(FrictionState.STICK)
    (open_,) = (~closed).nonzero()
    for anchor in anchors.T:
        anchor[open_] = np.nan
    for state, idle in zip(states.T, held.idle.T, strict=True):
        state[open_] = idle[open_]
    return states
