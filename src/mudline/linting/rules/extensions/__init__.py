"""The extension keywords: what they need, and values and combinations that they cannot have."""

from __future__ import annotations

from mudline.linting.rules.extensions import bed, suction, trench, unloading

__all__ = ["bed", "suction", "trench", "unloading"]
