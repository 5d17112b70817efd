"""Rows of plain numbers to an array, some thousand at once: every character is accounted for, or the row is odd.

Each number is the nearest double, as `float` gives it, or there is no answer. It is its digits, a whole number w, times
a power of ten. The upper 64 bits of every power of ten are a table; w is shifted to 64 bits, and the upper 64 bits of
the product of the two are too small by less than `_ERROR`. Where the product and the product with that error added
round to one double, it is the nearest double to the number. Elsewhere, about once in two hundred times, there is no
answer. (After D. Lemire, Number parsing at a gigabyte per second, 2021.)

Of long texts pyarrow, an extra, reads what it can in a third of the time. What it refuses, or reads as other than a
finite number, is left to our own reader.
"""

from __future__ import annotations

import re
import sys
from functools import cache
from importlib import import_module
from types import ModuleType
from typing import cast

import numpy as np
from numpy.typing import NDArray

from mudline.limits import LONGEST_BLANK_SEPARATED, LONGEST_NUMBER

# ---------------------------------------------------------------------------------------------------- digits to doubles

Whole = NDArray[np.intp]
Words = NDArray[np.uint64]
Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

DIGITS_OF_64_BITS = 19
"""The longest number whose digits always fit in 64 bits."""

_LOWEST, _HIGHEST = -342, 308
_ERROR = np.uint64(4)  # the power is cut off, so are three of the four partial products: less than one each
_HALF, _LOWER = np.uint64(32), np.uint64(0xFFFFFFFF)
_BIAS, _FRACTION = 1023, 52
_SCALES = 2046 - 64  # with a product below 2^64 no double overflows
_NORMAL = np.finfo(np.float64).tiny
_EXACT, _MOST_EXACT = 2**53, 22
_TENS = 10.0 ** np.arange(_MOST_EXACT + 1)
_PLACES = 10 ** np.arange(DIGITS_OF_64_BITS + 1, dtype=np.uint64)
_UNUSED = 64 - 8 * np.clip(np.arange(DIGITS_OF_64_BITS + 1), 0, 8).astype(np.uint64)
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
    word = words.take(at - 1)
    word >>= right
    word |= words.take(at) << (64 - right)
    most = int(count.max())
    if int(count.min()) < 8:
        unused = _UNUSED.take(count)
        word >>= unused
        word <<= unused
    if most == 1:
        word >>= _LAST
        word &= _DIGIT
    else:
        for mask, factor, shift in _STEPS:  # neighbours are added in pairs, fours and eights
            word &= mask
            word *= factor
            word >>= shift
    if most > 8:
        some = np.flatnonzero(count > 8)
        long = slice(None) if 2 * len(some) > len(count) else some
        word[long] += whole_numbers(words, end[long] - 8, np.maximum(count[long] - 8, 0)) * _PLACES[8]
    return word


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
    if int(scale.min()) < 1 or int(scale.max()) > _SCALES:
        with np.errstate(over="ignore"):
            values = np.ldexp(values, scale - _BIAS)
        sure &= ((values > _NORMAL) | (digits == 0)) & np.isfinite(values)  # a smaller one is rounded again
        return values, sure
    scale <<= _FRACTION
    values *= scale.view(np.float64)
    return values, sure


# ----------------------------------------------------------------------------------------------------------------- rows


_TAB, _LINE, _BLANK, _PLUS, _COMMA, _MINUS, _POINT, _ZERO = b"\t\n +,-.0"
_EXPONENT, _ANY_CASE = ord("e"), 0x21  # what makes an e of E, d and D, and of nothing else
_PLACES_OF_A_WORD = 8
_FEW = 16  # fields to a mark from which on marks are looked up one by one
_D_TO_E = bytes.maketrans(b"dD", b"EE")


class NumberRows:
    """Some lines of text, read as numbers.

    A field is a run of characters other than those below the comma; that they are digits with at most one sign, point
    and exponent follows from counts: every part of a field that must be digits has a length, and where the sum of the
    lengths is the count of digits in the text nothing else can be in them.
    """

    def __init__(self, lines: str) -> None:
        text = b"%*s%b\n" % (BEFORE, b"", lines.encode("latin-1", "replace"))
        text = text.replace(b"\r\n", b"\n") if b"\r" in text else text
        self.text = b"%b%*s" % (text, 16 - len(text) % 8, b"")
        self.letters = np.frombuffer(self.text, np.uint8)
        self.words = np.frombuffer(self.text, "<u8")
        field = self.letters > _COMMA
        field |= self.letters == _PLUS
        edges = np.flatnonzero(field[1:] != field[:-1]).reshape(-1, 2)
        self.starts, self.ends = np.ascontiguousarray(edges.T) + 1
        self.field = field
        self.commas = self.letters == _COMMA
        self.line_ends = self.letters == _LINE
        self.count = int(np.count_nonzero(self.line_ends))

    def read(self) -> tuple[Floats, Flags | None] | None:
        """The numbers (rows, columns), and which rows are odd: what stands there for them means nothing.

        None where the lines do not have one number of fields each, with one comma between two of them or with none.
        """
        width, rest = divmod(len(self.starts), self.count)
        if rest or not width or self._strange():
            return None
        last = self.ends[width - 1 :: width]
        lines = self._found(_LINE, self.line_ends, last)
        if (last > lines).any() or (lines[:-1] > self.starts[width::width]).any():
            return None
        commas = int(np.count_nonzero(self.commas))
        if commas not in (0, self.count * (width - 1)):
            return None
        odd: Flags | None = None
        if commas:
            before = self.ends.reshape(-1, width)[:, :-1]
            places = self._found(_COMMA, self.commas, before.ravel()).reshape(before.shape)
            if (places[:, -1] > lines).any() or (places[1:, 0] < lines[:-1]).any():
                return None
            between = (before <= places) & (places < self.starts.reshape(-1, width)[:, 1:])
            odd = None if between.all() else ~between.all(axis=1)
        elif width > 1 and np.diff(lines, prepend=BEFORE).max() > LONGEST_BLANK_SEPARATED:
            return None
        values, faulty = self._numbers()
        if faulty is not None:
            rows = cast("Flags", faulty.reshape(-1, width).any(axis=1))
            odd = rows if odd is None else odd | rows
        return values.reshape(-1, width), odd

    def odd_lines(self) -> Flags:
        """Which lines have another number of fields or commas than most, or a character that no number has."""
        lines = np.flatnonzero(self.line_ends)
        odd = np.zeros(len(lines), dtype=bool)
        for places in (self.starts, np.flatnonzero(self.commas)):
            counts = np.diff(np.searchsorted(places, lines), prepend=0)
            odd |= counts != np.bincount(counts).argmax()
        strange = ~(self.field | self.commas | self.line_ends | (self.letters == _BLANK) | (self.letters == _TAB))
        odd[np.searchsorted(lines, np.flatnonzero(strange))] = True
        return odd

    def _strange(self) -> bool:
        """Whether anything but blanks, commas and line ends is between the fields."""
        known = int(self.ends.sum() - self.starts.sum()) + self.count
        known += int(np.count_nonzero(self.commas)) + int(np.count_nonzero(self.letters == _BLANK))
        if known < len(self.letters):
            known += int(np.count_nonzero(self.letters == _TAB))
        return known < len(self.letters)

    def _found(self, letter: int, marks: Flags, expected: Whole) -> Whole:
        """Where a character is; `expected` has as many places as there are of it, and mostly is right."""
        return expected if bool((self.letters.take(expected) == letter).all()) else np.flatnonzero(marks)

    def _numbers(self) -> tuple[Floats, Flags | None]:
        """The value of each field, and which fields are not finite numbers; None instead if all are."""
        ends = self.ends
        first = self.letters.take(self.starts)
        minus = first == _MINUS
        begin = self.starts + (minus | (first == _PLUS))
        power = self._marks((self.letters | _ANY_CASE) == _EXPONENT, ends)
        point = self._marks(self.letters == _POINT, power)
        after = point if point is power else np.minimum(point + 1, power)
        whole, fraction = point - begin, power - after
        digits = whole + fraction
        accounted, scale, short = digits, -fraction, None
        faults = [fraction < 0, digits < 1, ends - self.starts > LONGEST_NUMBER]
        if power is not ends:
            fields = np.flatnonzero(power < ends)
            mark, end = power.take(fields), ends.take(fields)
            sign = self.letters.take(mark + 1)
            negative = sign == _MINUS
            places = end - mark - 1 - (negative | (sign == _PLUS))
            value = whole_numbers(self.words, end, np.minimum(places, _PLACES_OF_A_WORD)).view(np.intp)
            scale[fields] += np.where(negative, -value, value)
            accounted = digits.copy()
            accounted[fields] += places
            short, empty = np.ones(len(ends), dtype=bool), np.zeros(len(ends), dtype=bool)
            short[fields], empty[fields] = places <= _PLACES_OF_A_WORD, places < 1
            faults.append(empty)
        faulty = self._faulty(faults, accounted)
        if faulty is not None:
            whole[faulty] = fraction[faulty] = digits[faulty] = 0
        cut = None
        if digits.max() > DIGITS_OF_64_BITS:
            cut = digits > DIGITS_OF_64_BITS
            whole = np.minimum(whole, DIGITS_OF_64_BITS)
            fraction = np.minimum(fraction, DIGITS_OF_64_BITS - whole)
            scale += digits - whole - fraction
        number = whole_numbers(self.words, begin + whole, whole)
        if point is not power:
            number = with_fraction(number, whole_numbers(self.words, after + fraction, fraction), fraction)
        values, sure = nearest(number, scale, cut)
        if minus.any():
            np.negative(values, out=values, where=minus)
        for certain in (sure, short):
            if certain is not None and not certain.all():
                unsure = ~certain if faulty is None else ~(certain | faulty)
                faulty = self._one_by_one(values, np.flatnonzero(unsure), faulty)
        return values, faulty

    def _marks(self, mask: Flags, otherwise: Whole) -> Whole:
        """Where each field has a mark, its last one; `otherwise` for fields that have none."""
        count, fields = int(np.count_nonzero(mask)), len(self.ends)
        if not count:
            return otherwise
        if count * _FEW < fields:
            marks, found = np.flatnonzero(mask), otherwise.copy()
            found[np.searchsorted(self.ends, marks)] = marks
            return found
        width = fields // self.count
        some = slice(int(np.searchsorted(self.ends, mask.argmax())), width)
        if count == (width - some.start) * self.count:  # it may be that the last columns have one in every row
            first, behind, found = (one.reshape(-1, width) for one in (self.starts, self.ends, otherwise.copy()))
            expected = np.flatnonzero(mask).reshape(self.count, -1)
            if (first[:, some] <= expected).all() and (expected < behind[:, some]).all():
                found[:, some] = expected
                return found.ravel()
        places = np.flatnonzero(mask[1:] | (self.field[:-1] > self.field[1:]))
        places += 1
        ends = np.flatnonzero(~self.field.take(places))
        return np.where(np.diff(ends, prepend=-1) > 1, places.take(ends - 1), otherwise)

    def _faulty(self, faults: list[Flags], accounted: Whole) -> Flags | None:
        """Which fields have a fault or hold other than the accounted number of digits; None if there is no such one."""
        digit = (self.letters - np.uint8(_ZERO)) < 10
        if not any(map(np.any, faults)) and int(accounted.sum()) == np.count_nonzero(digit):
            return None
        others = np.flatnonzero(self.field & ~digit)
        held = self.ends - self.starts - np.searchsorted(others, self.ends) + np.searchsorted(others, self.starts)
        return cast("Flags", np.logical_or.reduce([*faults, accounted != held]))

    def _one_by_one(self, values: Floats, fields: Whole, faulty: Flags | None) -> Flags | None:
        """Read some fields as `float` does, and note those that are not finite."""
        text = self.text.translate(_D_TO_E) if b"D" in self.text or b"d" in self.text else self.text
        spans = zip(self.starts[fields].tolist(), self.ends[fields].tolist(), strict=True)
        numbers = np.array([float(text[start:end]) for start, end in spans])
        values[fields] = numbers
        infinite = fields[~np.isfinite(numbers)]
        if len(infinite):
            faulty = np.zeros(len(values), dtype=bool) if faulty is None else faulty
            faulty[infinite] = True
        return faulty


# ----------------------------------------------------------------------------------------------------------- by pyarrow

ARROW_PIECE = 1 << 21
"""Characters that are best read at once: of shorter texts the calls show, of longer ones the memory."""

_PAYS, _PAYS_WITH_IMPORT = 1 << 18, 10_000_000
"""Characters of the shortest texts that are read sooner, and of those that repay the import of 50 milliseconds."""
_LONE_RETURN = re.compile(rb"\r(?!\n|\Z)")
"""What would end a line of pyarrow's."""
_DIGITS = np.uint64(0x1010101010101010)
"""The bit that digits have in a word of eight characters; signs, points, exponents, blanks and commas lack it."""


def arrow_csv(size: int) -> ModuleType | None:
    """Pyarrow with its reader, where it is installed and a text of so many characters is read sooner with it."""
    if size < (_PAYS if sys.modules.get("pyarrow.csv") else _PAYS_WITH_IMPORT):
        return None
    try:
        import_module("pyarrow.csv")
        return import_module("pyarrow")
    except ImportError:
        return None


def read_with_arrow(arrow: ModuleType, lines: str, columns: int) -> Floats | None:
    """The rows of some lines that hold as many numbers each, at most `columns`, between commas; None otherwise.

    The numbers are those that `read_number` gives, to the last bit.
    """
    width = lines.count(",", 0, max(lines.find("\n"), 0)) + 1
    if not 1 < width <= columns or len(lines) > 2 * ARROW_PIECE or not lines.isascii():
        return None
    data = lines.encode("ascii")
    if _may_have_long_number(data) or (b"\r" in data and _LONE_RETURN.search(data)):
        return None
    names = [str(column) for column in range(width)]
    try:
        table = arrow.csv.read_csv(
            arrow.BufferReader(data),
            arrow.csv.ReadOptions(use_threads=False, block_size=len(data) + 1, column_names=names),
            arrow.csv.ParseOptions(quote_char=False, double_quote=False),
            arrow.csv.ConvertOptions(column_types=dict.fromkeys(names, arrow.float64()), null_values=[]),
        )
    except arrow.ArrowInvalid:
        return None
    values = np.empty((table.num_rows, width))
    for column in range(width):
        start = 0
        for chunk in table.column(column).chunks:
            if chunk.null_count:
                return None
            # the numbers themselves: to_numpy would import pandas where that is installed
            found = np.frombuffer(chunk.buffers()[1], np.float64, len(chunk), 8 * chunk.offset)
            values[start : start + len(chunk), column] = found
            start += len(chunk)
    return values if np.isfinite(values).all() else None


def _may_have_long_number(data: bytes) -> bool:
    """Whether some number may be longer than `LONGEST_NUMBER`.

    At most four of its characters are not digits, so it has at least 80 digits in a row, and these hold four blocks of
    16 characters whatever place they begin at; of each block the first half is looked at.
    """
    halves = np.frombuffer(data, np.uint64, len(data) // 16 * 2)[::2]
    full = (halves & _DIGITS) == _DIGITS
    return bool((full[:-3] & full[1:-2] & full[2:-1] & full[3:]).any())
