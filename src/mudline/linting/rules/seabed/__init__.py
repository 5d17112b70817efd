"""The seabed: its type, what carries the elements, the values of its fields."""

from __future__ import annotations

from mudline.linting.rules.seabed import profile, restraint, types, values

__all__ = ["profile", "restraint", "types", "values"]
