"""Linear and piecewise linear laws: normal laws, springs against uplift and lateral springs, damping, the rigid seabed.

`*EMBEDMENT` and `*SEABED STIFFNESS` are curves over the ratio of penetration to diameter,

    F = F_i + s_i (z / D - r_i),  dF/dz = s_i / D

in the segment i that contains z / D; see `mudline.model.curves`. A negative force is kept, or cut to 0.

`STIFFNESS=number` of `*SEABED PROPERTIES` and of `*ELASTIC SURFACE`; `NODAL STIFFNESS=`, `SMOOTHING=` and `FORM=` of
`*SEABED CONTACT`. With the stiffness K and the half width h of the zone, over the penetration z:

* h = 0:      the kinked law F = K max(z, 0);
* CENTRED:    F = K (z + h)^2 / (4 h) on -h < z < h, exactly K z beyond it, 0 below;
* ONE-SIDED:  F = K z^2 / (4 h) on 0 < z < 2 h, K (z - h) beyond it, 0 below.

Force and slope dF/dz are continuous for h > 0.

`SUCTION=` of `*SEABED PROPERTIES` is a spring against uplift, up to some height above the seabed (INFERRED),

    f = -k x for 0 < x <= extent, 0 elsewhere,

x the height of the element above the point where its contact begins. It has no history. Together with an unloading line
it acts only where the element is above the seabed.

`LATERAL=` of `*SEABED PROPERTIES` is a spring to the point where the element touched down (INFERRED). It acts per unit
length at the middle of an element in contact, along n x t, where t is the element's direction and n the mean normal of
the seabed at its nodes (over a break of the seabed the mean of the normals on both sides). Each node takes half of the
force:

    f = -k ((n x t) . (x - x_touchdown)) (n x t).

`DAMPING=` of `*SEABED CONTACT` damps inward motion in contact,

    f = c v_n for an inward velocity v_n > 0 of points below the mudline, 0 outward.

It is added to the reaction, which friction depends on, and never pulls.

`TYPE=RIGID` is a constraint on the nodes, gap >= 0, and gives no force.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from mudline.basics.short_repr import counted
from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.laws import Law, Moving, NormalLaw, Parameter, Reached, Value, where

if TYPE_CHECKING:
    from mudline.model.curves import ForceCurve

_WIDEST = 0.25 * float(np.finfo(np.float64).max)
"""Half widths above this are halved in sums that would overflow."""
_SMALL_SHARE = 2.0**-960
_LIFT = 2.0**60


def on_segment(ratio: Value, start: Value, force: Value, slope: Value) -> Value:
    """Return the force at a ratio of the segment with this start, force and slope."""
    return force + slope * (ratio - start)


def steepest_slopes(curve: ForceCurve) -> FloatArray:
    """Return for each segment (n - 1,) the steepest slope between the mudline and its end."""
    first = int(curve.segment(np.zeros(1))[0])
    slopes: FloatArray = np.concatenate(
        [np.full(first, curve.slopes[first]), np.maximum.accumulate(curve.slopes[first:])]
    )
    return slopes


def steepest_slope(curve: ForceCurve, ratio: FloatArray) -> FloatArray:
    """Return the steepest slope (d force / d ratio) of the curve between the mudline and each embedment ratio > 0.

    At a point of the curve the segment to its right is not included; an infinite ratio includes the whole curve.
    """
    return steepest_slopes(curve)[np.searchsorted(curve.ratios[1:-1], ratio)]


def linear_reaction(z: Value, diameter: Value, stiffness: Value) -> tuple[Value, Value]:
    """Return F = K z, and K."""
    return stiffness * z, stiffness


def constant_stiffness(z: Value, diameter: Value, stiffness: Value, *_zone: Value) -> Value:
    """Return K, the largest stiffness of a linear law at any penetration, with a zone or without."""
    return stiffness


def smoothed_reaction(
    z: Value, diameter: Value, stiffness: Value, half_width: Value, one_sided: Value
) -> tuple[Value, Value]:
    """Return force and dF/dz; in the zone K w s / 2 and K s, w the distance into the zone and s = w / (2 h).

    The share s multiplies the larger of K and w first, so that no intermediate value overflows or vanishes before the
    force does.
    """
    scale = where(half_width > _WIDEST, 0.5, 1.0)
    width, shift = scale * half_width, where(one_sided > 0.0, half_width, 0.0)
    into = scale * z + (width - scale * shift)
    # a share too small for all of its digits is computed larger by a power of two
    lift = where(into < _SMALL_SHARE * width, _LIFT, 1.0)
    drop = 1.0 / lift
    share = lift * into / where(half_width > 0.0, 2.0 * width, 1.0)
    in_zone = np.maximum(stiffness, into) * drop * (share * (1.5 - scale)) * np.minimum(stiffness, into)
    inside = z < half_width + shift
    return where(inside, in_zone, stiffness * (z - shift)), where(inside, stiffness * drop * share, stiffness)


def zone_onset(stiffness: Value, half_width: Value, one_sided: Value) -> Value:
    """Return the penetration at which contact begins: -h for CENTRED smoothing, else 0."""
    return where(one_sided > 0.0, 0.0, 0.0 - half_width)


def penetration_under(force: Value, stiffness: Value, half_width: Value, one_sided: Value) -> Value:
    """Return the penetration at which the smoothed law has a force > 0."""
    beyond = force / stiffness
    shift = where(one_sided > 0.0, half_width, 0.0)
    # K w^2 / (4 h) = F, as long as w < 2 h
    into = 2.0 * np.sqrt(half_width) * np.sqrt(beyond)
    return where(beyond < half_width, into - (half_width - shift), beyond + shift)


def automatic_half_width(static_penetration: FloatArray, diameter: FloatArray) -> FloatArray:
    """Return h of SMOOTHING=AUTO, min(0.1 Z, 0.01 D), from the static penetration Z and the diameter D of each point.

    It is 0, no smoothing, where one of them is NaN (unknown) or not positive.
    """
    with np.errstate(all="ignore"):
        width = np.minimum(0.1 * static_penetration, 0.01 * diameter)
    return np.where(width > 0.0, width, 0.0)


_STIFFNESS = Parameter("stiffness", "F/L2", "force per unit length and length of penetration")
_HALF_WIDTH = Parameter("half_width", "L", "half width h of the quadratic zone; 0 for a kinked law", default=0.0)
_ONE_SIDED = Parameter("one_sided", "1", "1 for a zone below the mudline only", high=1.0, default=0.0)


def _planned_nodes(parameters: dict[str, FloatArray]) -> str:
    nodes = len(parameters["stiffness"])
    return f"{counted(nodes, 'node')} with a stiffness of {'its' if nodes == 1 else 'their'} own"


CURVE = NormalLaw(
    name="curve",
    summary="force-embedment curve",
    acts_on="elements",
    parameters=(Parameter("curve", "1", "index of the curve"),),
    needs_diameter=True,
    tables=True,
    equation="F = F_i + s_i (z / D - r_i)",
    source="definition of *EMBEDMENT and *SEABED STIFFNESS",
)
LINEAR = NormalLaw(
    name="linear",
    summary="linear stiffness",
    acts_on="elements",
    parameters=(_STIFFNESS,),
    reaction=linear_reaction,
    steepest=constant_stiffness,
    plan="with a linear stiffness, at the mean depth (inferred)",
    equation="F = K z",
    source="definition of STIFFNESS=",
)
SMOOTHED = replace(
    LINEAR,
    name="smoothed",
    summary="linear stiffness with a quadratic zone",
    parameters=(_STIFFNESS, _HALF_WIDTH, _ONE_SIDED),
    reaction=smoothed_reaction,
    onset=zone_onset,
    equation="F = K (z + h)^2 / (4 h) in the zone, K z beyond (CENTRED); K z^2 / (4 h), K (z - h) (ONE-SIDED)",
    source="definition of SMOOTHING= and FORM=",
)
NODAL = replace(
    SMOOTHED,
    name="nodal",
    summary="stiffness of a node",
    acts_on="nodes",
    parameters=(Parameter("stiffness", "F/L", "force per length of penetration of the node"), _HALF_WIDTH, _ONE_SIDED),
    plan=_planned_nodes,
    equation="as `smoothed`, at the node's own penetration",
    source="definition of NODAL STIFFNESS=",
)


def _own_stiffness(_reached: Reached, parameters: dict[str, FloatArray]) -> tuple[FloatArray, None]:
    return parameters["stiffness"], None


def _planned(what: str) -> Callable[[dict[str, FloatArray]], str]:
    return lambda parameters: f"{counted(int((parameters['stiffness'] > 0.0).sum()), 'element')} with a spring {what}"


def spring_suction(uplift: Value, stiffness: Value, extent: Value) -> tuple[Value, Value]:
    """Return the force per unit length at a height `uplift` above the seabed, and its stiffness -d force / d x."""
    acts = (uplift > 0.0) & (uplift <= extent)
    return where(acts, 0.0 - stiffness * uplift, 0.0), where(acts, stiffness, 0.0)


SUCTION_SPRING = Law(
    name="suction spring",
    summary="spring against uplift, without history",
    stage="suction",
    acts_on="elements",
    parameters=(
        Parameter("stiffness", "F/L2", "force per unit length and length of uplift"),
        Parameter("extent", "L", "height above the seabed up to which it acts"),
    ),
    plan=_planned("up to an extent, without history (inferred)"),
    largest=_own_stiffness,
    equation="f = -k x for 0 < x <= extent",
    source="SUCTION= of *SEABED PROPERTIES (INFERRED)",
)


def lateral_force(stiffness: Value, elongation: Value) -> Value:
    """Return the force along n x t on each of the two nodes; `stiffness` is k times half of the element's length."""
    return -stiffness * elongation


def lateral_tangent(
    stiffness: FloatArray, across: FloatArray, arm: FloatArray, turn: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return derivatives (k, 3, 3) of the force on each of the two nodes by the positions of the first and the second.

    `across` (k, 3) is n x t, `arm` (k, 3) the displacement from the touchdown point, `turn` (k, 3, 3) the derivative of
    n x t by the second node's position, minus that by the first's.
    """
    force = -stiffness * np.einsum("ki,ki->k", across, arm)
    first, second = (
        across[:, :, None]
        * ((0.0 - stiffness)[:, None] * (0.5 * across + sign * np.einsum("ki,kij->kj", arm, turn)))[:, None]
        + force[:, None, None] * sign * turn
        for sign in (-1.0, 1.0)
    )
    return first, second


LATERAL = Law(
    name="lateral",
    summary="spring to the touchdown point of the element",
    stage="lateral",
    acts_on="elements",
    parameters=(Parameter("stiffness", "F/L2", "force per unit length and length of lateral displacement"),),
    history=True,
    state="touchdown",
    initial=lambda rows, *_: np.full((len(rows), 3), np.nan, order="F"),
    plan=_planned("to its touchdown point (inferred), in place of friction"),
    largest=_own_stiffness,
    equation="f = -k y, y the displacement along n x t from the touchdown point",
    source="LATERAL= of *SEABED PROPERTIES (INFERRED)",
)


def damping_force(z: Value, v: Value, damping: Value) -> Value:
    """Return the force at a depth and a pull-out velocity, both arrays or numbers."""
    return where((z > 0.0) & (v < 0.0), 0.0 - damping * v, 0.0)


def _largest_damping(_reached: Reached, parameters: dict[str, FloatArray]) -> tuple[FloatArray, FloatArray]:
    damping = np.where(parameters["damping"] > 0.0, parameters["damping"], np.nan)
    return 0.0 * damping, damping


def _at(step: Moving, parameters: dict[str, FloatArray]) -> FloatArray:
    return np.where((step.z > 0.0) & (step.v < 0.0), parameters["damping"], 0.0)


DAMPING = Law(
    name="damping",
    summary="damping of inward motion",
    acts_on="elements",
    parameters=(Parameter("damping", "FT/L2", "c, per unit length"),),
    velocities=True,
    largest=_largest_damping,
    damping=_at,
    equation="f = c v_n, inward and in contact only",
    source="definition of DAMPING=",
)
NODAL_DAMPING = replace(
    DAMPING,
    name="nodal damping",
    summary="damping of inward motion of a node",
    acts_on="nodes",
    parameters=(Parameter("damping", "FT/L", "c, of the node"),),
)
RIGID = Law(
    name="rigid",
    summary="rigid seabed, a constraint",
    acts_on="elements",
    parameters=(),
    plan=None,
    equation="gap >= 0",
    source="definition of TYPE=RIGID",
)
