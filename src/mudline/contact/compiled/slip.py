"""Friction of one node: what the springs of a direction give, and what slips; see `friction.return_mapping`."""

from __future__ import annotations

import math
from typing import Final

from mudline.contact.compiled.jit import jitted

Mapped = tuple[float, float, bool, bool]
"""Forces along u1 and u2, and which of them are at their limit."""

_SURELY: Final = 1.0 - 1e-12


@jitted
def inside(first: float, second: float, first_limit: float, second_limit: float, elliptic: bool) -> bool:  # noqa: FBT001 - compiled calls name no arguments
    """Whether trial forces are surely within their limits; not said of all that are within an ellipse."""
    within = (abs(first) <= first_limit) & (abs(second) <= second_limit)
    if not elliptic or not within:
        return within
    one, other = first / first_limit, second / second_limit
    return one * one + other * other < _SURELY


@jitted
def box(first: float, second: float, first_limit: float, second_limit: float) -> Mapped:
    """Trial forces, each within its own limit."""
    one, other = abs(first) > first_limit, abs(second) > second_limit
    return (
        math.copysign(first_limit, first) if one else first,
        math.copysign(second_limit, second) if other else second,
        one,
        other,
    )


@jitted
def ellipse(first: float, second: float, first_limit: float, second_limit: float) -> Mapped:
    """Trial forces within the ellipse of the limits."""
    one, other = first_limit > 0.0, second_limit > 0.0
    along = first if one else 0.0
    across = second if other else 0.0
    gauge = math.hypot(along / first_limit if one else 0.0, across / second_limit if other else 0.0)
    slides = gauge > 1.0
    scale = gauge if slides else 1.0
    return (
        along / scale,
        across / scale,
        slides or (not one and first != 0.0),
        slides or (not other and second != 0.0),
    )


@jitted
def returned(first: float, second: float, first_limit: float, second_limit: float, elliptic: bool) -> Mapped:  # noqa: FBT001 - compiled calls name no arguments
    """Trial forces, drawn back to their limits."""
    if elliptic:
        return ellipse(first, second, first_limit, second_limit)
    return box(first, second, first_limit, second_limit)


@jitted
def dragged(slips: bool, elongation: float, force: float, stiffness: float) -> float:  # noqa: FBT001 - compiled calls name no arguments
    """The way of the anchor to where the spring bears its force."""
    if not slips:
        return 0.0
    return elongation - (force / stiffness if stiffness > 0.0 else elongation)
