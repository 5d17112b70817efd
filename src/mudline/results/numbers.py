"""Numbers for people: six significant digits, an empty cell where there is none."""

from __future__ import annotations

import math


def shown(value: float | None, digits: int = 6) -> str:
    """A number in the shortest common form; "" for None."""
    if value is None:
        return ""
    return "" if math.isnan(value) else f"{value:.{digits}g}"
