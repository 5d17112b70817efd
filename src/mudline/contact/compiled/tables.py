"""An input as flat arrays for compiled loops, made once for each model."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mudline.contact.arrays import BoolArray, FloatArray
from mudline.contact.friction.directions import senses
from mudline.contact.inputs import ContactInput, LawKind
from mudline.contact.suction.law import SuctionLaw, suction_depth

if TYPE_CHECKING:  # a scene without curves does not load them
    from mudline.curves import ForceCurve

SmallIndexArray = NDArray[np.int32]


class Curves(NamedTuple):
    """The points of all curves, one after the other, and the steepest slopes from the mudline to each segment."""

    first: SmallIndexArray
    last: SmallIndexArray
    ratios: FloatArray
    forces: FloatArray
    tails: FloatArray
    steepest: FloatArray


class Elements(NamedTuple):
    """Elements (m,).

    Attributes:
        ends: (m, 2) their nodes.
        senses: (m, 2) how their tangents count there.
        curve: curves of those that have one, else -1.
        numbers: (m, 8) half of the length, diameter, linear stiffness, beginning of contact, half width of the zone,
            stiffness and extent of the spring against uplift, stiffness of the lateral spring.
        one_sided: as in `Smoothing`.
        on_curve, on_line, sprung, pulled, unloaded, guided: the elements with a curve, a linear law, a spring against
            uplift, suction, an unloading line, and a lateral spring.
    """

    ends: SmallIndexArray
    senses: FloatArray
    curve: SmallIndexArray
    numbers: FloatArray
    one_sided: BoolArray
    on_curve: SmallIndexArray
    on_line: SmallIndexArray
    sprung: SmallIndexArray
    pulled: SmallIndexArray
    unloaded: SmallIndexArray
    guided: SmallIndexArray


class Nodes(NamedTuple):
    """Nodes (n,).

    Attributes:
        numbers: (n, 8) coefficients of friction along u1 and u2, springs, springs per normal force, cosine and sine of
            the angle (NaN for none).
        springs: (n, 2) stiffness of the nodal spring, 0 for none, and half width of its zone.
        one_sided: as in `NodalSprings`.
        sprung: nodes that have one.
        active: nodes that have friction.
        elliptic: nodes whose limits are those of an ellipse.
        trench: (n, 3) half widths of the bottom and at the top, and peak force, NaN for none.
        line: row in `lines` of nodes that have a straight centreline, else -1.
        lines: (k, 4) place and direction in the plan.
    """

    numbers: FloatArray
    springs: FloatArray
    one_sided: BoolArray
    sprung: SmallIndexArray
    active: BoolArray
    elliptic: BoolArray
    trench: FloatArray
    line: SmallIndexArray
    lines: FloatArray


class Has(NamedTuple):
    """What there is."""

    cuts: bool
    suction: bool
    friction: bool
    lateral: bool


class Tables(NamedTuple):
    """All of them; `laws` (k, 9) are `pull.Breakout` and `pull.Law` of the elements with suction."""

    has: Has
    elements: Elements
    nodes: Nodes
    curves: Curves
    laws: FloatArray


def tables(inputs: ContactInput, onset: FloatArray) -> Tables:
    """The input as tables; elements are in contact from the depths `onset` (m,) on."""
    extras = inputs.extras
    laws = np.empty((0, 9)) if extras.suction is None else _suction_laws(extras.suction.law)
    has = Has(
        cuts=inputs.tension == "cut",
        suction=extras.suction is not None,
        friction=extras.friction is not None,
        lateral=extras.lateral is not None,
    )
    return Tables(has, _elements(inputs, onset), _nodes(inputs), _curves(inputs), laws)


def _elements(inputs: ContactInput, onset: FloatArray) -> Elements:
    extras, count = inputs.extras, len(inputs.element_ids)
    none = np.zeros(count)
    smooth, springs = extras.smoothing, extras.suction_springs
    uplift = (none, none) if springs is None else (springs.stiffness, springs.extent)
    lateral = none if extras.lateral is None else extras.lateral
    with np.errstate(over="ignore"):  # a step refuses the reaction
        numbers = (
            0.5 * inputs.length,
            inputs.diameter,
            inputs.linear_stiffness,
            onset,
            none if smooth is None else smooth.half_width,
            np.where(uplift[0] > 0.0, uplift[0], 0.0),
            uplift[1],
            np.where(lateral > 0.0, lateral * inputs.length, 0.0),
        )
    unloading = np.full(count, np.nan) if extras.unloading is None else extras.unloading
    held = np.zeros(0, np.intp) if extras.suction is None else extras.suction.elements
    return Elements(
        inputs.element_nodes.astype(np.int32),
        senses(inputs.element_nodes, len(inputs.node_ids)),
        np.where(inputs.law == LawKind.CURVE, inputs.curve_index, -1).astype(np.int32),
        _columns(numbers),
        np.zeros(count, np.bool_) if smooth is None else smooth.one_sided.copy(),
        inputs.with_law(LawKind.CURVE).astype(np.int32),
        inputs.with_law(LawKind.LINEAR).astype(np.int32),
        np.flatnonzero(uplift[0] > 0.0).astype(np.int32),
        held.astype(np.int32),
        np.flatnonzero(~np.isnan(unloading)).astype(np.int32),
        np.flatnonzero(lateral > 0.0).astype(np.int32),
    )


def _suction_laws(law: SuctionLaw) -> FloatArray:
    slowest = np.maximum(law.regularisation * (law.force_exponent < 2.0), np.nextafter(0.0, 1.0))
    return _columns(
        [
            law.depth_factor,
            law.depth_exponent,
            law.regularisation,
            suction_depth(law, np.zeros(len(law.cyclic))),
            law.force_factor * law.cyclic,
            law.force_exponent,
            slowest,
            law.first_corner,
            law.second_corner,
        ]
    )


def _nodes(inputs: ContactInput) -> Nodes:
    extras, count = inputs.extras, len(inputs.node_ids)
    numbers, active, elliptic = np.zeros((count, 8)), np.zeros(count, np.bool_), np.zeros(count, np.bool_)
    if extras.friction is not None:
        law, turn = extras.friction.law, np.radians(extras.friction.angle)
        with np.errstate(all="ignore"):
            rising = np.where(law.constant, 0.0, law.coefficients / law.mobilisation)
        constant = np.where(law.constant, law.stiffness, 0.0)
        numbers = _columns([law.coefficients, constant, rising, np.cos(turn), np.sin(turn)])
        active, elliptic = law.active.copy(), law.ellipse.copy()
    nodal = extras.nodal
    springs = np.zeros((count, 2))
    if nodal is not None:
        springs = _columns([np.nan_to_num(nodal.stiffness), nodal.half_width])
    trench, line, lines = np.full((count, 3), np.nan), np.full(count, -1, np.int32), np.empty((0, 4))
    if extras.trench is not None:
        widths = extras.trench.law
        trench = _columns([0.5 * widths.bottom, 0.5 * widths.upper, widths.peak])
        straight = np.flatnonzero(~np.isnan(extras.trench.straight[:, 0]))
        ends, line[straight] = np.unique(extras.trench.straight[straight], axis=0, return_inverse=True)
        way = ends[:, 2:] - ends[:, :2]
        lines = _columns([ends[:, :2], way / np.hypot(*way.T)[:, None]])
    one_sided = np.zeros(count, np.bool_) if nodal is None else nodal.one_sided.copy()
    sprung = np.flatnonzero(springs[:, 0] > 0.0).astype(np.int32)
    return Nodes(numbers, springs, one_sided, sprung, active, elliptic, trench, line, lines)


def _curves(inputs: ContactInput) -> Curves:
    curves = inputs.curves
    counts = np.array([len(curve.ratios) for curve in curves], np.int32)
    last = np.cumsum(counts, dtype=np.int32) - 1
    joined = [np.concatenate([np.empty(0), *parts]) for parts in zip(*map(_points, curves), strict=True)]
    ratios, forces, tails, steepest = joined or [np.empty(0)] * 4
    return Curves((last - counts + 1).astype(np.int32), last.astype(np.int32), ratios, forces, tails, steepest)


def _points(curve: ForceCurve) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Ratios, forces, slopes to the right, and the steepest slope between the mudline and the segment there."""
    tails = np.append(curve.slopes, curve.slopes[-1])
    first = int(curve.segment(np.zeros(1))[0])
    steepest = np.concatenate([np.full(first, tails[first]), np.maximum.accumulate(tails[first:])])
    return curve.ratios, curve.forces, tails, steepest


def two_of_each(ends: SmallIndexArray, known: BoolArray) -> SmallIndexArray:
    """The first two elements (n, 2) at each node, -1 where there are fewer; those of nodes not `known` do not count."""
    found = np.full((len(known), 2), -1, np.int32)
    elements = np.flatnonzero(known[ends].all(axis=1))
    node, element = ends[elements].reshape(-1), np.repeat(elements, 2)
    order = np.argsort(node, kind="stable")
    node, element = node[order], element[order]
    rank = np.arange(len(node)) - np.searchsorted(node, node)
    for place in range(2):
        found[node[rank == place], place] = element[rank == place]
    return found


def _columns(arrays: Sequence[FloatArray]) -> FloatArray:
    """The arrays beside each other, row by row in memory."""
    return np.ascontiguousarray(np.column_stack(arrays))
