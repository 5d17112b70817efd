"""Friction of nodes on the seabed: two directions, each with a spring to the stick point, up to its Coulomb limit.

`*SEABED FRICTION`, and `FRICTION=` of `*SEABED PROPERTIES`. u1 runs along the line in the plane of the seabed and u2 =
n x u1. With the elongations e_i from the stick point, the normal force N and the springs K_i (constant, or mu_i N /
mobilisation length):

* BOX:      |f_i| <= mu_i N, independently for each direction;
* ELLIPSE:  (f_1 / (mu_1 N))^2 + (f_2 / (mu_2 N))^2 <= 1; a trial force outside is scaled back along its own direction.
  As mu_2 goes to 0 the ellipse shrinks onto the u1 axis. With mu_2 = 0 exactly f_2 is 0 and u1 keeps its own limit, as
  in the box. For any mu_2 > 0 a trial with f_2 beyond its small limit lowers f_1 too.

The scheme is the return mapping of elastic-plastic models: a trial force is brought back to its limit, and the stick
point of a slipping node is moved until the spring carries the limit. A node without normal force has no stick point.

Stick points are points in space, resolved on the present u1 and u2. As long as a node sticks, the force depends on its
position and on the directions, not on its path. No closed loop gives work where K_1 = K_2 or where the directions stay
fixed. Where they turn with the line and K_1 differs from K_2, turning them at an elongation g stores or releases up to
(K_1 - K_2) g^2 / 2, like a spring whose stiffness is changed under load.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import IntEnum
from typing import NamedTuple, Self

import numpy as np

from mudline.basics.short_repr import counted, short_repr
from mudline.model.contact.arrays import BoolArray, FloatArray, IndexArray, StateArray
from mudline.model.contact.laws import Law, Parameter, Reached, Value, where

_TINY = float(np.nextafter(0.0, 1.0))
_FAR, _DROP = 2.0**-1000, 2.0**-550


class FrictionState(IntEnum):
    """State of a node in one direction."""

    NONE = -1
    """No friction law."""
    OPEN = 0
    """No normal force, no stick point."""
    STICK = 1
    """Held by a spring to the stick point."""
    SLIP = 2
    """At the limit; the stick point moves with the node."""


def in_box(trial: Value, limit: Value) -> tuple[Value, Value]:
    """Return the force of one direction in its spring, and whether the direction slips."""
    force = np.maximum(np.minimum(trial, limit), 0.0 - limit)
    return force, force != trial


def norm(a: Value, b: Value) -> Value:
    """Return sqrt(a^2 + b^2) without squares that under- or overflow."""
    a, b = np.abs(a), np.abs(b)
    larger = np.maximum(a, b)
    ratio = np.minimum(a, b) / np.maximum(larger, _TINY)
    return larger * np.sqrt(1.0 + ratio * ratio)


def on_ellipse(trial_1: Value, trial_2: Value, limit_1: Value, limit_2: Value) -> tuple[Value, Value, Value]:
    """Return the forces of both directions in their springs, and whether they slip, for limits above 0."""
    # quotients that would overflow are computed smaller by a power of two
    far = (np.abs(trial_1) * _FAR > limit_1) | (np.abs(trial_2) * _FAR > limit_2)
    drop = where(far, _DROP, 1.0)
    dropped_1, dropped_2 = trial_1 * drop, trial_2 * drop
    size = norm(dropped_1 / (limit_1 / drop), dropped_2 / (limit_2 / drop))
    # a limit too large for a float64 must give NaN, which is refused: its term in the norm would vanish
    share = 1.0 / np.maximum(size, 1.0) + (0.0 * limit_1 + 0.0 * limit_2)
    force_1 = where(far, dropped_1 / size * drop, trial_1 * share)
    force_2 = where(far, dropped_2 / size * drop, trial_2 * share)
    return force_1, force_2, far | (size > 1.0)


def in_ellipse(trial_1: Value, trial_2: Value, limit_1: Value, limit_2: Value) -> tuple[Value, Value, Value, Value]:
    """Return the forces of both directions in their springs, and whether each slips."""
    limited_1, limited_2 = limit_1 > 0.0, limit_2 > 0.0
    held_1, held_2 = where(limited_1, trial_1, 0.0), where(limited_2, trial_2, 0.0)
    force_1, force_2, slips = on_ellipse(held_1, held_2, where(limited_1, limit_1, 1.0), where(limited_2, limit_2, 1.0))
    # a direction without a limit holds nothing
    free_1, free_2 = np.logical_not(limited_1) & (trial_1 != 0.0), np.logical_not(limited_2) & (trial_2 != 0.0)
    return force_1, force_2, slips | free_1, slips | free_2


def slip_distance(slips: Value, elongation: Value, force: Value, stiffness: Value) -> Value:
    """Return the displacement of the stick point after which the spring carries its force."""
    return where(slips, elongation - force / np.maximum(stiffness, _TINY), 0.0)


@dataclass(frozen=True, slots=True, eq=False)
class FrictionLaw:
    """The friction of nodes (n,), by direction: 0 is along u1 (axial), 1 along u2 (lateral).

    Attributes:
        coefficients: (n, 2) Coulomb coefficients mu, >= 0; the limit is mu N.
        stiffness: (n, 2) constant spring Kt, force per length, > 0; NaN to use the mobilisation length.
        mobilisation: (n, 2) mobilisation lengths, > 0: the spring is mu N / length; ignored where a stiffness is given.
        ellipse: (n,) whether an elliptic criterion holds for both directions together instead of one for each.
        active: (n,) nodes that have a law.
        turned: (k,) nodes whose u1 is at an angle to +Y.
        cosine, sine: (k,) cosine and sine of the angle.
    """

    coefficients: FloatArray
    stiffness: FloatArray
    mobilisation: FloatArray
    ellipse: BoolArray
    active: BoolArray
    turned: IndexArray = field(default_factory=lambda: np.empty(0, np.intp))
    cosine: FloatArray = field(default_factory=lambda: np.empty(0))
    sine: FloatArray = field(default_factory=lambda: np.empty(0))

    @property
    def constant(self) -> BoolArray:
        """Directions (n, 2) whose spring is constant."""
        return ~np.isnan(self.stiffness)

    @property
    def fixed(self) -> FloatArray:
        """Stiffness (n, 2) of the constant springs, else 0."""
        return np.where(self.constant, self.stiffness, 0.0)

    @property
    def rising(self) -> FloatArray:
        """Stiffness (n, 2) of the springs per unit of normal force; 0 where they are constant."""
        with np.errstate(all="ignore"):
            rate: FloatArray = np.where(self.constant, 0.0, self.coefficients / self.mobilisation)
        return rate

    def springs(self, normal_force: FloatArray) -> FloatArray:
        """Return the stiffness (n, 2) of the springs under normal forces (n,) >= 0."""
        return self.fixed + self.rising * normal_force[:, None]


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class FrictionHistory:
    """History of friction. It is never changed: a step returns a new history.

    Attributes:
        stick_points: (n, 3) points that the springs pull to; NaN for nodes out of contact.
        states: (n, 2) values of `FrictionState`.
    """

    stick_points: FloatArray
    states: StateArray

    __repr__ = short_repr

    @classmethod
    def initial(cls, active: BoolArray) -> FrictionHistory:
        """Return the history of nodes (n,) that never touched the seabed; `active` marks nodes with friction."""
        states = np.where(active, FrictionState.OPEN, FrictionState.NONE).astype(np.int8)
        return cls(np.full((3, len(active)), np.nan).T, np.stack([states, states]).T)


class ExtraLimit(NamedTuple):
    """Changes of the lateral limit of nodes (n,) by trenches, against outward motion, and by a breakout (negative).

    Attributes:
        force: added limit.
        by_offset: its derivative by an offset.
        by_normal_force: its derivative by N.
        outward: +1 if motion along +u2 leads out of the trench, -1 if motion along -u2 does, 0 for neither.
        gradient: (n, 3) of the offset by the node's position with u2 held, for tangents.
        by_angle: derivative of the offset by a turn of u1 and u2 about the normal, for tangents.
    """

    force: FloatArray
    by_offset: FloatArray
    by_normal_force: FloatArray
    outward: FloatArray
    gradient: FloatArray = np.zeros((0, 3))
    by_angle: FloatArray = np.zeros(0)

    @classmethod
    def none(cls, nodes: int) -> Self:
        """Return no change of the limits of nodes."""
        force, offset, normal, outward, angle = np.zeros((5, nodes))
        return cls(force, offset, normal, outward, np.zeros((nodes, 3)), angle)


class FrictionForce(NamedTuple):
    """Friction on the pipe at nodes (n,), along u1 and u2.

    Attributes:
        force: (n, 2) force on the pipe.
        by_position: (n, 2, 2) d force[i] / d (elongation along u_j), at fixed normal force and limit.
        by_offset: (n, 2) d force[i] / d (offset from the centreline of a trench).
        by_compression: (n, 2) d force[i] / d N.
        elongation: (n, 2) displacement from the stick point before the step, along u1 and u2.
        dissipated: (n,) work done against slipping in this step, >= 0.
        history: history for the next step.
    """

    force: FloatArray
    by_position: FloatArray
    by_offset: FloatArray
    by_compression: FloatArray
    elongation: FloatArray
    dissipated: FloatArray
    history: FrictionHistory

    def tangent(
        self, directions: tuple[FloatArray, FloatArray], extra: ExtraLimit | None
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return derivatives of the forces by position (n, 3, 3), by normal force (n, 3), and by a turn (n, 3).

        A turn of the `directions` u1 and u2, (n, 3) each, by a about the normal makes d u1 = a u2, d u2 = -a u1.
        """
        first, second = directions
        axes = np.stack(directions, axis=1)
        along = np.einsum("nij,njk->nik", self.by_position, axes)
        by_angle = np.stack([self.elongation[:, 1], 0.0 - self.elongation[:, 0]], axis=1)
        change = np.einsum("nij,nj->ni", self.by_position, by_angle)
        if extra is not None:
            along += self.by_offset[:, :, None] * extra.gradient[:, None, :]
            change += self.by_offset * extra.by_angle[:, None]
        turned = change[:, 0, None] * first + change[:, 1, None] * second
        turned += self.force[:, 0, None] * second - self.force[:, 1, None] * first
        by_normal_force = np.einsum("nij,ni->nj", axes, self.by_compression)
        return np.einsum("nij,nik->njk", axes, along), by_normal_force, turned


def slide(
    law: FrictionLaw,
    history: FrictionHistory,
    points: FloatArray,
    directions: tuple[FloatArray, FloatArray],
    compression: FloatArray,
    extra: ExtraLimit | None = None,
) -> FrictionForce:
    """Return friction, with derivatives, of a step of nodes to `points` (n, 3) under normal forces `compression` (n,).

    `directions` are u1 and u2, each (n, 3). A node without normal force is open and loses its stick point; a node in
    contact again gets a new one at its position. The drivers do the same without derivatives.
    """
    closed = law.active & (compression > 0.0)
    before = closed & (history.states[:, 0] > FrictionState.OPEN)
    stick_points = np.where(before[:, None], history.stick_points, points)
    elongation = np.stack([((points - stick_points) * axis).sum(axis=1) for axis in directions], axis=1)
    pressing = np.where(closed, compression, 0.0)
    stiffness, limit = law.springs(pressing), law.coefficients * pressing[:, None]
    trial = stiffness * elongation
    limit_by_offset, limit_by_normal = np.zeros(trial.shape), law.coefficients.copy()
    if extra is not None:
        against = (extra.outward != 0.0) & (np.sign(trial[:, 1]) == extra.outward)
        limit[:, 1] += extra.force * against
        limit_by_offset[:, 1] = np.where(against, extra.by_offset, 0.0)
        limit_by_normal[:, 1] += np.where(against, extra.by_normal_force, 0.0)
    with np.errstate(all="ignore"):
        boxes = [in_box(trial[:, side], limit[:, side]) for side in range(2)]
        ellipse = in_ellipse(trial[:, 0], trial[:, 1], limit[:, 0], limit[:, 1])
    held = np.stack([np.where(law.ellipse, ellipse[side], boxes[side][0]) for side in range(2)], axis=1)
    slips: BoolArray = np.stack([np.where(law.ellipse, ellipse[2 + side], boxes[side][1]) for side in range(2)], axis=1)
    moved = slip_distance(slips, elongation, held, stiffness)
    for side, axis in enumerate(directions):
        stick_points += axis * moved[:, side, None]
    stick_points[~closed] = np.nan
    states = np.where(closed[:, None], slips + np.int8(FrictionState.STICK), FrictionHistory.initial(law.active).states)
    rising, side = law.rising * elongation, np.sign(trial)
    by_position = np.zeros((*slips.shape, 2))
    for one in range(2):
        by_position[:, one, one] = np.where(slips[:, one], 0.0, stiffness[:, one])
    by_offset = np.where(slips, side * limit_by_offset, 0.0)
    by_normal = np.where(slips, side * limit_by_normal, rising)
    curved = law.ellipse & law.active
    of_ellipse = _ellipse_derivatives((stiffness, trial, limit), rising, limit_by_offset, limit_by_normal)
    for whole, values in zip((by_position, by_offset, by_normal), of_ellipse, strict=True):
        whole[curved] = values[curved]
    return FrictionForce(
        np.subtract(0.0, held),
        np.where(before[:, None, None], 0.0 - by_position, 0.0),  # at touchdown there is no force yet
        np.where(closed[:, None], 0.0 - by_offset, 0.0),
        np.where(closed[:, None], 0.0 - by_normal, 0.0),
        elongation,
        np.where(closed, (held * moved).sum(axis=1), 0.0),
        FrictionHistory(stick_points, states.astype(np.int8)),
    )


def _ellipse_derivatives(
    springs: tuple[FloatArray, FloatArray, FloatArray], rising: FloatArray, by_offset: FloatArray, by_normal: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return derivatives of both forces by position, by offset and by normal force, with an ellipse.

    `springs` are stiffness, trial forces and limits (n, 2), and the other arguments derivatives of the springs by the
    normal force and of the limits. With g the norm of trial / limit the force is trial / g.
    """
    stiffness, trial, limit = springs
    with np.errstate(all="ignore"):
        limited = limit > 0.0
        limit, trial = np.where(limited, limit, 1.0), np.where(limited, trial, 0.0)
        stiffness, rising = np.where(limited, stiffness, 0.0), np.where(limited, rising, 0.0)
        share = trial / limit
        size = norm(share[:, 0], share[:, 1])[:, None]
        scale = np.maximum(size, 1.0)
        unit = np.where((size > 1.0) & limited, share / scale, 0.0)
        # relative change of g with a trial force and, falling, with a limit
        by_trial, by_limit = unit / (limit * scale), unit * unit / limit
        force = trial / scale
        growth = by_trial * stiffness
        growth_by_offset = 0.0 - (by_limit * by_offset).sum(axis=1, keepdims=True)
        growth_by_normal = (by_trial * rising - by_limit * by_normal).sum(axis=1, keepdims=True)
        by_position = -force[:, :, None] * growth[:, None, :]
        for axis in range(2):
            by_position[:, axis, axis] += stiffness[:, axis] / scale[:, 0]
        return by_position, 0.0 - force * growth_by_offset, rising / scale - force * growth_by_normal


def _plan(parameters: dict[str, FloatArray]) -> str:
    constant = ~(np.isnan(parameters["axial_stiffness"]) & np.isnan(parameters["lateral_stiffness"]))
    parts = []
    if constant.any():
        ellipses = int((constant & (parameters["elliptic"] > 0.0)).sum())
        criterion = f", {ellipses} of them with an ellipse" if ellipses else ""
        parts.append(f"{counted(int(constant.sum()), 'node')} with a constant spring{criterion}")
    if lengths := int((~constant).sum()):
        parts.append(f"{counted(lengths, 'node')} with a mobilisation length, Kt = mu N / length (inferred)")
    return "; ".join(parts)


def _largest(reached: Reached, parameters: dict[str, FloatArray]) -> tuple[FloatArray, None]:
    """Return the spring of a node that sticks, the stiffer of both directions."""
    springs = []
    for side in ("axial", "lateral"):
        coefficient, constant = parameters[f"{side}_coefficient"], parameters[f"{side}_stiffness"]
        rising = coefficient / parameters[f"{side}_mobilisation"]
        spring = np.where(np.isnan(constant), np.where(rising > 0.0, rising * reached.normal_force, 0.0), constant)
        # a direction without a coefficient has no limit to stick below; trench walls add one
        springs.append(spring if reached.walls else np.where(coefficient > 0.0, spring, 0.0))
    return np.maximum(*springs), None


FRICTION = Law(
    name="friction",
    summary="Coulomb friction in two directions",
    stage="friction",
    acts_on="nodes",
    parameters=(
        Parameter("axial_coefficient", "1", "mu_1, along the line"),
        Parameter("lateral_coefficient", "1", "mu_2, across the line"),
        Parameter("axial_stiffness", "F/L", "constant spring K_1", above=True, default=np.nan, optional=True),
        Parameter("lateral_stiffness", "F/L", "constant spring K_2", above=True, default=np.nan, optional=True),
        Parameter("axial_mobilisation", "L", "K_1 = mu_1 N / length", above=True, default=np.nan, optional=True),
        Parameter("lateral_mobilisation", "L", "K_2 = mu_2 N / length", above=True, default=np.nan, optional=True),
        Parameter("elliptic", "1", "1 for the ELLIPSE, 0 for the BOX", high=1.0, default=0.0),
        Parameter(
            "angle", "deg", "of u1 to +Y about the normal; NaN along the line", -np.inf, default=np.nan, optional=True
        ),
    ),
    history=True,
    state="friction",
    initial=lambda rows, count, _: FrictionHistory.initial(np.isin(np.arange(count), rows)),
    plan=_plan,
    largest=_largest,
    equation="f_i = -K_i e_i, |f_i| <= mu_i N",
    source="return mapping after Simo and Hughes (1998), Computational Inelasticity, chapter 1",
)
