"""Values that a part of a deck gives."""

from __future__ import annotations

import math


def number(part: object, name: str, default: float = math.nan) -> float:
    """A value that is given and is a number, else `default`."""
    value = getattr(part, name, None)
    return float(value) if isinstance(value, float | int) else default
