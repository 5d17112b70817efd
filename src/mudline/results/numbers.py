"""Numbers for people and for JSON."""

from __future__ import annotations

import math


def shown(value: float | None, digits: int = 6) -> str:
    """A number in the shortest common form; "" for None and NaN."""
    if value is None or math.isnan(value):
        return ""
    return f"{value:.{digits}g}"


def finite(value: float | None) -> float | None:
    """A number that JSON can hold; None for what overflowed or is none."""
    return value if value is not None and math.isfinite(value) else None
