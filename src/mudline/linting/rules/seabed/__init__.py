"""The seabed: what carries the elements, what is given twice or for nothing, where the nodes lie."""

from __future__ import annotations

from mudline.linting.rules.seabed import (
    constraints,
    depth,
    families,
    friction,
    overlaps,
    position,
    restraint,
)

__all__ = [
    "constraints",
    "depth",
    "families",
    "friction",
    "overlaps",
    "position",
    "restraint",
]
