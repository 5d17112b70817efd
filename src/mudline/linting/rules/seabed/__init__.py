"""The seabed: its type, what carries the elements, the values of its fields."""

from __future__ import annotations

from mudline.linting.rules.seabed import depth, families, friction, position, profile, restraint, slope, types, values

__all__ = ["depth", "families", "friction", "position", "profile", "restraint", "slope", "types", "values"]
