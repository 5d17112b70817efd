"""The seabed: its type, what carries the elements, the values of its fields."""

from __future__ import annotations

from mudline.linting.rules.seabed import (
    constraints,
    depth,
    families,
    friction,
    overlaps,
    position,
    profile,
    restraint,
    slope,
    types,
    values,
)

__all__ = [
    "constraints",
    "depth",
    "families",
    "friction",
    "overlaps",
    "position",
    "profile",
    "restraint",
    "slope",
    "types",
    "values",
]
