"""Friction of one node: what the springs of a direction give, and what slips; see `friction.return_mapping`."""

from __future__ import annotations

import math

from mudline.contact.compiled.jit import jitted

Mapped = tuple[float, float, bool, bool]
"""Forces along u1 and u2, and which of them are at their limit."""


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
