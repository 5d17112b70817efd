"""Rows of plain numbers to an array, some thousand at once: every character is accounted for, or the row is odd."""

from __future__ import annotations

from typing import cast

import numpy as np

from mudline.syntax.decimals import BEFORE, MOST_DIGITS, Flags, Floats, Whole, nearest, whole_numbers, with_fraction

LONGEST_NUMBER = 400
"""Longer numbers are refused by `read_number`: nobody writes them, and reading one takes time square in its length."""
LONGEST_BLANK_SEPARATED = 10_000
"""The longest line without commas, in characters, that is read as several numbers."""

_TAB, _LINE, _BLANK, _PLUS, _COMMA, _MINUS, _POINT, _ZERO = b"\t\n +,-.0"
_EXPONENT, _ANY_CASE = ord("e"), 0x21  # what makes an e of E, d and D, and of nothing else
_MOST_PLACES = 8
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
            value = whole_numbers(self.words, end, np.minimum(places, _MOST_PLACES)).view(np.intp)
            scale[fields] += np.where(negative, -value, value)
            accounted = digits.copy()
            accounted[fields] += places
            short, empty = np.ones(len(ends), dtype=bool), np.zeros(len(ends), dtype=bool)
            short[fields], empty[fields] = places <= _MOST_PLACES, places < 1
            faults.append(empty)
        faulty = self._faulty(faults, accounted)
        if faulty is not None:
            whole[faulty] = fraction[faulty] = digits[faulty] = 0
        cut = None
        if digits.max() > MOST_DIGITS:
            cut = digits > MOST_DIGITS
            whole = np.minimum(whole, MOST_DIGITS)
            fraction = np.minimum(fraction, MOST_DIGITS - whole)
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
