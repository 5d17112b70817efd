"""Decimal digits to doubles, many at once: the nearest double, as `float` gives it, or no answer.

A number is its digits, a whole number w, times a power of ten. The upper 64 bits of every power of ten are a table; w
is shifted to 64 bits, and the upper 64 bits of the product of the two are too small by less than `_ERROR`. Where the
product and the product with that error added round to one double, it is the nearest double to the number. Elsewhere,
about once in two hundred times, there is no answer. (After D. Lemire, Number parsing at a gigabyte per second, 2021.)
"""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

Whole = NDArray[np.intp]
Words = NDArray[np.uint64]
Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

MOST_DIGITS = 19
"""The longest number whose digits always fit in 64 bits."""

_LOWEST, _HIGHEST = -342, 308
_ERROR = np.uint64(4)  # the power is cut off, so are three of the four partial products: less than one each
_HALF, _LOWER = np.uint64(32), np.uint64(0xFFFFFFFF)
_BIAS, _FRACTION = 1023, 52
_LARGEST = 2046 - 64  # with a product below 2^64 no double overflows
_NORMAL = np.finfo(np.float64).tiny
_EXACT, _MOST_EXACT = 2**53, 22
_TENS = 10.0 ** np.arange(_MOST_EXACT + 1)
_PLACES = 10 ** np.arange(MOST_DIGITS + 1, dtype=np.uint64)
_UNUSED = [64 - 8 * np.clip(np.arange(MOST_DIGITS + 1) - first, 0, 8).astype(np.uint64) for first in (0, 8, 16)]
_STEPS = tuple(
    (np.uint64(mask), np.uint64(factor), np.uint64(shift))
    for mask, factor, shift in (
        (0x0F0F0F0F0F0F0F0F, 10 << 8 | 1, 8),
        (0x00FF00FF00FF00FF, 100 << 16 | 1, 16),
        (0x0000FFFF0000FFFF, 10_000 << 32 | 1, 32),
    )
)
_LAST, _DIGIT = np.uint64(56), np.uint64(0x0F)
BEFORE = 24
"""How many characters a text needs in front of its first digit, and 8 behind its last, to be read as words."""


def whole_numbers(words: Words, end: Whole, count: Whole) -> Words:
    """The numbers of up to 19 digits whose last one is the character before `end`.

    `words` is the text, eight characters in a word, the first in its lowest byte.
    """
    at = end >> 3
    right = ((end & 7) << 3).astype(np.uint64)
    left = 64 - right
    least, most = int(count.min()), int(count.max())
    behind = words.take(at)
    total = np.zeros(0, np.uint64)
    for number in range(max(-(-most // 8), 1)):
        before = words.take(at - number - 1)
        word = (before >> right) | (behind << left)
        behind = before
        if least < number * 8 + 8:
            unused = _UNUSED[number].take(count)
            word >>= unused
            word <<= unused
        if most == number * 8 + 1:
            word >>= _LAST
            word &= _DIGIT
        else:
            for mask, factor, shift in _STEPS:  # neighbours are added in pairs, fours and eights
                word &= mask
                word *= factor
                word >>= shift
        if number:
            word *= _PLACES[8 * number]
            total += word
        else:
            total = word
    return total


def with_fraction(whole: Words, fraction: Words, places: Whole) -> Words:
    """The digits of both sides of a point as one number; `places` is the count of those behind it."""
    whole *= _PLACES.take(places)
    whole += fraction
    return whole


@cache
def _powers() -> tuple[Words, Words, Whole]:
    """Of each power of ten its upper 64 bits, in two halves, and the power of two to multiply them with."""
    upper: list[int] = []
    exponents: list[int] = []
    for power in range(_LOWEST, _HIGHEST + 1):
        shift = 1200 if power < 0 else 64
        number = (10 ** max(power, 0) << shift) // 10 ** max(-power, 0)
        spare = number.bit_length() - 64
        upper.append(number >> spare)
        exponents.append(spare - shift)
    words = np.array(upper, np.uint64)
    return words >> _HALF, words & _LOWER, np.array(exponents, np.intp)


def nearest(digits: Words, power: Whole, cut: Flags | None = None) -> tuple[Floats, Flags | None]:
    """The doubles nearest to `digits` times 10 to `power`, and which of them are certain; None instead if all are.

    Where `cut` is set more digits follow that are not in `digits`.
    """
    if cut is None and int(digits.max()) <= _EXACT and int(power.min()) >= -_MOST_EXACT and int(power.max()) <= 0:
        return digits.astype(np.float64) / _TENS.take(-power), None  # a quotient of exact doubles is rounded once
    uppers, lowers, exponents = _powers()
    place = power - _LOWEST
    outside = int(place.min()) < 0 or int(place.max()) >= len(uppers)
    if outside:
        place = np.clip(place, 0, len(uppers) - 1)
    shift = (_BIAS + 63) - ((digits | np.uint64(1)).astype(np.float64).view(np.intp) >> _FRACTION)
    aligned = shift.astype(np.uint64)
    upper = digits << aligned
    lower = upper & _LOWER
    upper >>= _HALF
    high = uppers.take(place)
    product = upper * high
    upper *= lowers.take(place)
    upper >>= _HALF
    product += upper
    lower *= high
    lower >>= _HALF
    product += lower
    values = product.astype(np.float64)
    product += _ERROR
    if cut is not None:
        product += np.where(cut, np.uint64(1) << np.minimum(aligned, np.uint64(63)), np.uint64(0))
    sure = values == product.astype(np.float64)
    sure |= digits == 0 if cut is None else (digits == 0) & ~cut
    scale = exponents.take(place)
    scale += 64 + _BIAS
    scale -= shift
    if outside:
        sure &= place == power - _LOWEST
    if int(scale.min()) < 1 or int(scale.max()) > _LARGEST:
        with np.errstate(over="ignore"):
            values = np.ldexp(values, scale - _BIAS)
        sure &= ((values > _NORMAL) | (digits == 0)) & np.isfinite(values)  # a smaller one is rounded again
        return values, sure
    scale <<= _FRACTION
    values *= scale.view(np.float64)
    return values, sure
