"""Suction of one element; see `suction.stepping`."""

from __future__ import annotations

from typing import Final

from mudline.contact.compiled.jit import jitted

_FREE: Final = 0
_COMPRESSION: Final = 1
_SUCTION: Final = 2
_HOLD: Final = 3
_BROKEN: Final = 4

Breakout = tuple[float, float, float, float]
"""Depth factor and exponent, v_r, and Delta_B at v_r."""

Law = tuple[float, float, float, float, float]
"""Force factor times cyclic factor, force exponent, the slowest pace of the largest suction, and the corners."""


@jitted
def breakout(law: Breakout, v_max: float) -> float:
    """Delta_B, the uplift at breakout."""
    return law[0] * v_max ** law[1] if v_max > law[2] else law[3]


@jitted
def next_state(
    before: tuple[bool, float, int], depth: float, uplift: float, velocity: float
) -> tuple[bool, float, int]:
    """What an element that is not compressed remembers: armed, v_max (that of the episode so far comes in), state."""
    armed, v_max, state = before
    beyond = uplift >= depth
    if armed and not velocity > 0.0:
        return True, v_max, _HOLD
    if armed and not beyond:
        return True, v_max, _SUCTION
    if beyond and (armed or state == _BROKEN):
        return False, v_max, _BROKEN
    return False, 0.0, _FREE


@jitted
def pull(law: Law, depth: float, uplift: float, velocity: float) -> tuple[float, float]:
    """Force per unit length of an element in suction, and its derivative by uplift."""
    exponent, first, second = law[1], law[3], law[4]
    pace = max(velocity, law[2])
    share = velocity / pace
    force = law[0] * pace**exponent * ((2.0 - exponent + (exponent - 1.0) * share) * share)
    share = max(uplift, 0.0) / depth
    part = min(max(min(share / first, (1.0 - share) / (1.0 - second)), 0.0), 1.0)
    slope = 0.0
    if 0.0 < share < first:
        slope = 1.0 / first
    elif second < share < 1.0:
        slope = -1.0 / (1.0 - second)
    return 0.0 - force * part, 0.0 - force * slope / depth
