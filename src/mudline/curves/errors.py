"""Points that make no curve, and ratios that have no force."""

from __future__ import annotations


class CurveError(ValueError):
    """Points that do not make a curve.

    Attributes:
        code: rule code of the fault: `SYN002` (a number that is not finite), `CRV001` (fewer than two distinct
            points), `CRV003` (two forces at one ratio), `CRV011` (a width or a slope that a float64 cannot hold).
        index: the offending point in the order given, from 0; of two points the later one; -1 for the whole curve.
    """

    def __init__(self, code: str, index: int, message: str) -> None:
        super().__init__(message)
        self.code = code
        self.index = index

    def __reduce__(self) -> tuple[type[CurveError], tuple[str, int, str]]:
        return type(self), (self.code, self.index, str(self))


class QueryError(ValueError):
    """A ratio that has no force: it is not finite, or the force there overflows.

    Attributes:
        index: position of the ratio in the flattened query.
        ratio: the ratio.
    """

    def __init__(self, index: int, ratio: float, message: str) -> None:
        super().__init__(message)
        self.index = index
        self.ratio = ratio

    def __reduce__(self) -> tuple[type[QueryError], tuple[int, float, str]]:
        return type(self), (self.index, self.ratio, str(self))
