"""Force-embedment curves."""

from __future__ import annotations

from mudline.linting.rules.curves import columns, end, points, shape, start

__all__ = ["columns", "end", "points", "shape", "start"]
