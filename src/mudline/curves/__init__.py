"""Force-embedment curves.

curve = ForceCurve([(0.3, 4500.0), (0.0, 0.0), (0.1, 2000.0)])
force, slope = curve.evaluate(0.2)
"""

from __future__ import annotations

from mudline.curves.curve import ForceCurve
from mudline.curves.points import CurveError, QueryError

__all__ = ["CurveError", "ForceCurve", "QueryError"]
