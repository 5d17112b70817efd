"""A deck being damaged: its lines by keyword, changes of them, and where an engineer would look for the fault."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from tests.faults.legal import LegalDeck

_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[Ee][-+]?\d+)?")
_COMMENT = re.compile(r"C(?:[\s\W]|$)")


class NotHere(Exception):  # noqa: N818 - it reports that a deck offers no place for a fault, which is no error
    """The deck has nothing that the fault could damage."""


@dataclass(eq=False)
class Row:
    """A line; `expected` marks a place where the finding may point."""

    text: str
    expected: bool = False


class Draft:
    """The lines of a legal deck, to be changed in place. What is changed is marked as the place of the finding."""

    def __init__(self, deck: LegalDeck) -> None:
        self.units = deck.units
        self.name = deck.name
        self.rows = [Row(line) for line in deck.text.replace("\r\n", "\n").split("\n")]
        self.curve_decks = "*SEABED STIFFNESS" in deck.text or "*EMBEDMENT" in deck.text

    @property
    def text(self) -> str:
        return "\n".join(row.text for row in self.rows)

    @property
    def expected(self) -> frozenset[int]:
        """The numbers of the marked lines."""
        return frozenset(i for i, row in enumerate(self.rows, 1) if row.expected)

    def needs(self, condition: object) -> None:
        """Leave a deck out to which the fault could not happen."""
        if not condition:
            raise NotHere

    # ------------------------------------------------------------------------------------------------------- finding

    def first(self, rows: Iterable[Row]) -> Row:
        """The first of some lines, if any."""
        row = next(iter(rows), None)
        if row is None:
            raise NotHere
        return row

    def block(self, keyword: str, which: int = 0) -> list[Row]:
        """Keyword line and data lines of a block."""
        heads = [i for i, row in enumerate(self.rows) if row.text == keyword]
        self.needs(-len(heads) <= which < len(heads))
        start = heads[which]
        ends = (i for i, row in enumerate(self.rows) if i > start and row.text[:1] in ("*", "$"))
        return self.rows[start : next(ends, len(self.rows))]

    def data(self, keyword: str) -> list[Row]:
        """Data lines of the first block of a keyword."""
        rows = [row for row in self.block(keyword)[1:] if row.text.strip() and not _COMMENT.match(row.text)]
        self.needs(rows)
        return rows

    def numbers(self, keyword: str) -> list[Row]:
        """Lines of the first block of a keyword that hold only numbers."""
        rows = [row for row in self.data(keyword) if "=" not in row.text]
        self.needs(rows)
        return rows

    def settings(self, keyword: str, key: str) -> list[Row]:
        """Lines of the first block of a keyword that begin with `key=`."""
        rows = [row for row in self.data(keyword) if row.text.strip().startswith(f"{key}=")]
        self.needs(rows)
        return rows

    def setting(self, keyword: str, key: str) -> Row:
        """The first of `settings`."""
        return self.settings(keyword, key)[0]

    def sections(self, *options: str) -> list[Row]:
        """The property lines of `*GEOMETRIC SETS` under some options, of any without one."""
        found: list[Row] = []
        option = "FLEXIBLE"
        for row in self.data("*GEOMETRIC SETS"):
            if row.text.strip().startswith("OPTION="):
                option = row.text.partition("=")[2].strip()
            elif "=" not in row.text and (not options or option in options):
                found.append(row)
        self.needs(found)
        return found

    def curve(self, least: int = 4) -> list[Row]:
        """The points of the first curve that the deck uses; that of the last set where several are given."""
        used = {row.text.partition("=")[2] for row in self._optional("*SEABED PROPERTIES", "STIFFNESS")}
        for keyword, key in (("*SEABED STIFFNESS", "CURVE"), ("*EMBEDMENT", "SET")):
            if not any(row.text == keyword for row in self.rows):
                continue
            points: list[Row] = []
            inside = False
            for row in self.data(keyword):
                if row.text.strip().startswith(f"{key}="):
                    if len(points) >= least:
                        return points
                    inside, points = key == "SET" or row.text.partition("=")[2] in used, []
                elif inside:
                    points.append(row)
            if len(points) >= least:
                return points
        raise NotHere

    def _optional(self, keyword: str, key: str) -> list[Row]:
        try:
            return self.settings(keyword, key)
        except NotHere:
            return []

    def previous(self, row: Row) -> Row:
        """The line above."""
        return self.rows[self.rows.index(row) - 1]

    def keyed_above(self, row: Row) -> Row:
        """The nearest `KEY=` line above a row."""
        at = self.rows.index(row)
        return next(each for each in reversed(self.rows[:at]) if "=" in each.text)

    # ------------------------------------------------------------------------------------------------------- changing

    def mark(self, *rows: Row) -> None:
        """Mark lines as places where the finding may point."""
        for row in rows:
            row.expected = True

    def write(self, row: Row, text: str) -> None:
        """Give a line another text, keep its indentation, and mark it."""
        self.needs(row.text.strip() != text)
        row.text = row.text[: len(row.text) - len(row.text.lstrip())] + text
        self.mark(row)

    def swap(self, row: Row, old: str, new: str) -> None:
        """Replace the first `old` of a line, and mark the line."""
        self.needs(old in row.text)
        row.text = row.text.replace(old, new, 1)
        self.mark(row)

    def insert(self, behind: Row, *texts: str, mark: bool = True) -> list[Row]:
        """Put lines behind one."""
        at = self.rows.index(behind) + 1
        new = [Row(text, mark) for text in texts]
        self.rows[at:at] = new
        return new

    def remove(self, rows: Iterable[Row]) -> None:
        """Delete lines."""
        gone = set(map(id, rows))
        self.rows = [row for row in self.rows if id(row) not in gone]

    def fields(self, row: Row) -> list[str]:
        """The fields of a line, as they are written between its commas."""
        self.needs("," in row.text or len(row.text.split()) == 1)
        return [field.strip() for field in row.text.split(",")]

    def field(self, row: Row, column: int) -> str:
        """The field in a column."""
        fields = self.fields(row)
        self.needs(column < len(fields))
        return fields[column]

    def value(self, row: Row, column: int) -> float:
        """The number in a column."""
        return typed(self.field(row, column))

    def put(self, row: Row, column: int, text: str) -> None:
        """Write another field in a column that holds a number."""
        self.value(row, column)
        fields = self.fields(row)
        fields[column] = text
        self.write(row, ", ".join(fields))

    def scale(self, row: Row, column: int, factor: float) -> None:
        """Multiply the number in a column."""
        self.put(row, column, plain(self.value(row, column) * factor))

    def retyped(self, row: Row, column: int, change: Callable[[str], str]) -> None:
        """Type the number in a column otherwise."""
        self.value(row, column)
        self.put(row, column, change(self.fields(row)[column]))

    def exchange(self, row: Row, one: int, other: int) -> None:
        """Exchange two columns."""
        fields = self.fields(row)
        self.needs(max(one, other) < len(fields) and fields[one] != fields[other])
        fields[one], fields[other] = fields[other], fields[one]
        self.write(row, ", ".join(fields))


def typed(text: str) -> float:
    """The number that a field holds; NotHere where it holds none, or an equation."""
    if not _NUMBER.fullmatch(text.strip()):
        raise NotHere
    return float(text)


def plain(value: float) -> str:
    """A number as it is typed: six digits, no exponent below a million."""
    text = f"{value:.6g}".upper().replace("E+0", "E").replace("E+", "E")
    return text if any(mark in text for mark in ".E") else f"{text}.0"
