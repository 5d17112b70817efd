"""Force-embedment curves."""

from __future__ import annotations

from mudline.linting.rules.curves import points, shape

__all__ = ["points", "shape"]
