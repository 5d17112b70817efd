"""Text files of numbers that decks name: operators of vessels, histories of motions and elevations, coefficients.

Their public rules: a line with an upper-case C in column 1 is a comment, values are separated by commas or spaces, and
    TABs are not allowed. The fault of a file is the first line that breaks these rules, or the format of the file.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import chain, pairwise
from pathlib import Path
from typing import NamedTuple

from mudline.basics.limits import LARGEST_FILE
from mudline.basics.short_repr import counted
from mudline.language.keywords.text import shown
from mudline.language.keywords.values import DataFile
from mudline.language.syntax.rows import read_number
from mudline.language.syntax.source import Source

_PARTS = re.compile(r"[ ,]+")
_HEADING = re.compile(r"[ ]*HEADING[ ]*=(.*)", re.IGNORECASE)
_WIDTH = {DataFile.MOTIONS: 7, DataFile.ELEVATIONS: 2}
_SIX = 6
_PER_LINE = 14
_HALF_TURN = 180.0
_UNEVEN = 1e-6


class DataLine(NamedTuple):
    """Line that is not a comment, and its number."""

    number: int
    text: str

    def values(self) -> list[float]:
        """Return its numbers; raises ValueError for words that are not numbers."""
        return [number_of(word, self.number) for word in _PARTS.split(self.text.strip(" ,"))]


def fault_of(path: Path, contents: DataFile, *, layout: str = "") -> str:
    """Return the first fault of a file, with its line, or ""; `layout` is MCS or LINE if the deck gives it."""
    try:
        if contents is DataFile.OPERATORS:
            operators(path, layout)
            return ""
        lines = list(_lines(path))
        if contents in _WIDTH:
            times = [row[0] for row in _table(lines, _WIDTH[contents])]
            after = next((at for at in range(1, len(times)) if times[at] <= times[at - 1]), 0)
            if after:
                what = f"the time {times[after]:g} does not come after {times[after - 1]:g}"
                return f"line {lines[after].number}: {what}"
        else:
            for line in lines:
                if "=" not in line.text:
                    line.values()
    except (ValueError, OSError) as error:
        return str(getattr(error, "strerror", None) or error)
    return ""


def has_uneven_times(path: Path) -> bool:
    """Return True if the times of a file without a fault do not have a constant interval."""
    times = [row[0] for row in _table(list(_lines(path)), _WIDTH[DataFile.ELEVATIONS])]
    steps = [after - before for before, after in pairwise(times)]
    return bool(steps) and max(steps) - min(steps) > _UNEVEN * max(steps)


def unequal_frequencies(rows: Sequence[Sequence[float]]) -> str:
    """Return the fault in the headings and frequencies of operators, the first two values of each row, or ""."""
    by_heading: dict[float, set[float]] = {}
    for heading, frequency in (row[:2] for row in rows):
        if frequency in by_heading.setdefault(heading, set()):
            return f"the heading {heading:g} has the frequency {frequency:g} twice"
        by_heading[heading].add(frequency)
    first, *others = by_heading or [0.0]
    for heading in others:
        if differing := by_heading[first] ^ by_heading[heading]:
            return (
                f"the headings {first:g} and {heading:g} need the same frequencies: {min(differing):g} is in one only"
            )
    return ""


def _lines(path: Path) -> Iterator[DataLine]:
    if path.stat().st_size > LARGEST_FILE:
        raise ValueError(f"the file has more than {LARGEST_FILE // 10**6} million bytes")
    for line in lines_of(path.read_bytes(), path.name):
        if "\t" in line.text:
            raise ValueError(f"line {line.number}: a TAB is not allowed here: write spaces or commas")
        yield line


def lines_of(data: bytes, name: str) -> Iterator[DataLine]:
    """Yield the lines of a file's content that are neither blank nor comments; raises ValueError if it is not text."""
    source = Source.from_bytes(data, name)
    if not source.readable:
        raise ValueError(source.problems[0].message)
    for number, text in enumerate(source.unified.split("\n"), 1):
        if text.strip() and not text.startswith("C"):
            yield DataLine(number, text)


def number_of(word: str, line: int) -> float:
    """Return the number that a word of a line is; raises ValueError if it is not a number."""
    value = read_number(word)
    if value is None:
        raise ValueError(f"line {line}: {shown(word)} is not a number")
    return value


def _table(lines: Sequence[DataLine], width: int) -> list[list[float]]:
    if not lines:
        raise ValueError("the file has no line of numbers")
    return [_row(line, width) for line in lines]


def _row(line: DataLine, width: int) -> list[float]:
    values = line.values()
    if len(values) != width:
        raise ValueError(f"line {line.number}: expected {counted(width, 'number')}, found {len(values)}")
    return values


def operators(path: Path, layout: str = "") -> list[list[float]]:
    """Return heading, frequency, then amplitude and phase of heave, surge, sway, yaw, roll and pitch, row by row.

    `layout` is MCS or LINE if the deck gives it, else it is that of the first line. Raises OSError, or ValueError for
    the first fault of the file.
    """
    lines = list(_lines(path))
    if not lines:
        raise ValueError("the file has no operators")
    by_heading = bool(_HEADING.fullmatch(lines[0].text))
    if layout == "LINE" or (not layout and not by_heading):
        rows = _table(lines, _PER_LINE)
        for row, line in zip(rows, lines, strict=True):
            _heading(row[0], line.number)
        if fault := unequal_frequencies(rows):
            raise ValueError(fault)
        return rows
    if not by_heading:
        raise ValueError(f"line {lines[0].number}: expected HEADING=angle before the first frequency")
    return _groups(lines)


def _groups(lines: Sequence[DataLine]) -> list[list[float]]:
    """Return operators with three lines a frequency below each heading: frequency, six amplitudes, six phases."""
    widths = (1, _SIX, _SIX)
    angle, group, rows = 0.0, list[list[float]](), list[list[float]]()
    for line in lines:
        heading = _HEADING.fullmatch(line.text)
        if heading and group:
            raise ValueError(f"line {line.number}: a frequency above it lacks its amplitudes or phases")
        if heading:
            angle = number_of(heading[1].strip(" ,"), line.number)
            _heading(angle, line.number)
            continue
        group.append(_row(line, widths[len(group)]))
        if len(group) == len(widths):
            (frequency,), amplitudes, phases = group
            rows.append([angle, frequency, *chain.from_iterable(zip(amplitudes, phases, strict=True))])
            group = []
    if group:
        raise ValueError(f"line {lines[-1].number}: the last frequency lacks its amplitudes or phases")
    return rows


def _heading(value: float, line: int) -> None:
    if abs(value) > _HALF_TURN:
        raise ValueError(f"line {line}: the heading {value:g} must lie between -180 and 180 degrees")
