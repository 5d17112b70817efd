"""Vectors, angles and planes in exact arithmetic: rational numbers, roots and angles to 60 digits."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

_DIGITS = 60
ZERO, ONE = Fraction(0), Fraction(1)

Vector = tuple[Fraction, Fraction, Fraction]


def fraction_of(value: Any) -> Fraction:  # noqa: ANN401 - mpmath has no types
    """A number of mpmath: as it has a mantissa and an exponent it is a fraction."""
    from mpmath.libmp import to_rational  # noqa: PLC0415 - comes with the extra "study", and only this needs it

    numerator, denominator = to_rational(value._mpf_)
    return Fraction(int(numerator), int(denominator))


def sine_and_cosine(degrees: float) -> tuple[Fraction, Fraction]:
    """Sine and cosine of an angle in degrees, exact at multiples of 90 as the angle is."""
    from mpmath import mp  # noqa: PLC0415 - see above

    quarters, rest = divmod(Fraction(degrees) % 360, 90)
    if rest > 45:
        quarters, rest = quarters + 1, rest - 90
    with mp.workdps(_DIGITS):
        angle = mp.mpf(rest.numerator) / rest.denominator * mp.pi / 180
        sine, cosine = fraction_of(mp.sin(angle)), fraction_of(mp.cos(angle))
    for _ in range(int(quarters) % 4):
        sine, cosine = cosine, -sine
    return sine, cosine


def root(square: Fraction) -> Fraction:
    """The square root to 60 digits."""
    from mpmath import mp  # noqa: PLC0415 - see above

    with mp.workdps(_DIGITS):
        return fraction_of(mp.sqrt(mp.mpf(square.numerator) / square.denominator))


def product(one: Fraction, other: Fraction) -> Fraction:
    """A product, the sooner where a factor is 0: most components are."""
    return one * other if one and other else ZERO


def dot(one: Vector, other: Vector) -> Fraction:
    """The scalar product."""
    return sum(map(product, one, other), ZERO)


def cross(one: Vector, other: Vector) -> Vector:
    """The vector product."""
    (a, b, c), (d, e, f) = one, other
    return (
        product(b, f) - product(c, e),
        product(c, d) - product(a, f),
        product(a, e) - product(b, d),
    )


def minus(one: Vector, other: Vector) -> Vector:
    """The difference."""
    return one[0] - other[0], one[1] - other[1], one[2] - other[2]


def times(factor: Fraction, one: Vector) -> Vector:
    """A multiple."""
    return product(factor, one[0]), product(factor, one[1]), product(factor, one[2])


def largest_term(one: Vector, other: Vector) -> Fraction:
    """The largest term of a scalar product."""
    return max(map(abs, map(product, one, other)))


def _unit(one: Vector) -> Vector:
    return times(1 / root(dot(one, one)), one)


def vector(values: Sequence[float]) -> Vector:
    """Three floats as they are."""
    x, y, z = (Fraction(float(value)) for value in values)
    return x, y, z


class ExactPlane:
    """A plane through a point, of a slope that rises to a direction; angles in degrees."""

    def __init__(self, slope: float, direction: float, point: Sequence[float]) -> None:
        sine, cosine = sine_and_cosine(slope)
        side, ahead = sine_and_cosine(direction)
        self.normal: Vector = (cosine, -sine * ahead, -sine * side)
        self.point = vector(point)

    @property
    def horizontal(self) -> bool:
        """Whether its normal is +X."""
        return self.normal == (ONE, ZERO, ZERO)

    def along(self, span: Vector) -> Vector:
        """The unit projection of a span; that of +Y where the span has no length."""
        if not any(span):
            span = (ZERO, ONE, ZERO)
        return _unit(minus(span, times(dot(span, self.normal), self.normal)))
