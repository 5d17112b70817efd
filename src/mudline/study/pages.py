"""Pages of studies: Markdown whose numbers come from the tables of the study, as their CSV files have them.

The prose of a page is in `page.md` beside the module of its study, with a field in braces for everything measured;
`page.py` there computes the fields from `Tables` and returns `filled(...)`. The page of a report and the page made from
the CSV files of a folder have the same bytes, because both read the texts of the CSV.
"""

from __future__ import annotations

import csv
import io
import math
import shlex
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from decimal import ROUND_CEILING, ROUND_FLOOR, ROUND_HALF_EVEN, Context, Decimal
from pathlib import Path
from string import Formatter
from typing import TypeAlias

from mudline.study import SAMPLE_NAME

NONE = "none"
"""The text on a page where a table has no number."""
DOWN, UP = ROUND_FLOOR, ROUND_CEILING


class MissingTableError(Exception):
    """A page needs a table that was not measured, or a row that the table does not have; the message says which."""


@dataclass(frozen=True, slots=True)
class Record:
    """A row of a table: texts by heading, "step [s]", as CSV has them."""

    table: str
    cells: Mapping[str, str]

    def text(self, heading: str) -> str:
        """The cell as it is; "" where there is no value. Raises MissingTableError for a heading that is not there."""
        if heading not in self.cells:
            raise MissingTableError(f"table {self.table} has no column {heading!r}: it has {', '.join(self.cells)}")
        return self.cells[heading]

    def number(self, heading: str) -> float:
        """The number in the cell; NaN where there is none."""
        return float(self.text(heading) or math.nan)

    def place(self, prefix: str = "") -> str:
        """Where the deck says it: "deck line 32", or "line 32 of base.keyxm" in a deck that it continues.

        The columns are "deck line" and "deck file", behind the prefix.
        """
        line, file = (self.text(f"{prefix}deck {what}") for what in ("line", "file"))
        return f"line {line} of {file}" if file else f"deck line {line}"

    def flag(self, heading: str) -> bool:
        """Whether the cell says true."""
        return self.text(heading) == "true"


def command_of(study: str, deck: str) -> str:
    """What a reader writes to make the page of a deck: of the built-in one, that of the documentation."""
    if deck == SAMPLE_NAME:
        return f"mudline study {study} -o docs/studies"
    return f"mudline study {study} {shlex.quote(deck)} -o DIR"


class Tables:
    """The tables of one study by name, each from the text of its CSV file."""

    def __init__(self, texts: Mapping[str, str]) -> None:
        self._records: dict[str, list[Record]] = {}
        for name, text in texts.items():
            headings, *rows = csv.reader(io.StringIO(text, newline=""))
            self._records[name] = [Record(name, dict(zip(headings, row, strict=True))) for row in rows]

    @classmethod
    def read(cls, folder: Path, study: str) -> Tables:
        """The tables that `mudline study STUDY -o FOLDER` has written; raises OSError and UnicodeDecodeError."""
        start = f"{study}-"
        files = sorted(folder.glob(f"{start}*.csv"))
        return cls({path.stem.removeprefix(start): path.read_bytes().decode() for path in files})

    def rows(self, table: str, **cells: str) -> list[Record]:
        """The rows of a table in which these columns have these texts; raises MissingTableError without the table.

        A column whose heading is no Python name is given as `**{"in contact [%]": "100"}`.
        """
        if table not in self._records:
            raise MissingTableError(f"table {table} is not there")
        found = self._records[table]
        return [row for row in found if all(row.text(heading) == cell for heading, cell in cells.items())]

    def row(self, table: str, **cells: str) -> Record:
        """The first of these rows; raises MissingTableError where there is none."""
        found = self.rows(table, **cells)
        if not found:
            raise MissingTableError(f"table {table} has no row with {cells}")
        return found[0]


# ------------------------------------------------------------------------------------------------------------- numbers


def rounded(value: float, digits: int = 2, rounding: str = ROUND_HALF_EVEN) -> str:
    """A number with so many significant digits: 0.035, 1.4e-16, 1300, 100 000; "none" for NaN.

    A limit that something has to stay below is rounded `DOWN`, a bound that holds everything found is rounded `UP`.
    """
    if math.isnan(value):
        return NONE
    number = Decimal(f"{value:.12g}")  # what is a round number but for its last bits stays one
    text = f"{float(Context(digits, rounding).plus(number)):.{digits}g}"
    if math.isinf(value) or not 1e-4 <= abs(float(text)) < 1e7:
        mantissa, mark, power = text.partition("e")
        return f"{mantissa}e{int(power)}" if mark else mantissa
    if abs(float(text)) >= 10.0 ** (digits - 1):
        return grouped_digits(round(float(text)))
    return text


def grouped_digits(value: float) -> str:
    """A whole number, from five digits on in groups of three: 4096, 100 000."""
    return f"{value:.0f}" if abs(value) < 10_000 else f"{value:,.0f}".replace(",", " ")


def percent(share: float, digits: int = 2, rounding: str = ROUND_HALF_EVEN) -> str:
    """A share in percent, rounded as in `rounded`: "0.7 %"; "none" for NaN."""
    return NONE if math.isnan(share) else f"{rounded(100.0 * share, digits, rounding)} %"


def time(seconds: float, digits: int = 2, rounding: str = ROUND_HALF_EVEN) -> str:
    """A time in s, ms, us or ns, rounded as in `rounded`: "74 s", "0.3 ms" is "300 us"; "none" for NaN."""
    if math.isnan(seconds):
        return NONE
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("us", 1e-6)):
        if abs(seconds) >= size:
            return f"{rounded(seconds / size, digits, rounding)} {unit}"
    return f"{rounded(seconds / 1e-9, digits, rounding)} ns"


def span(values: Iterable[float], digits: int = 2, unit: str = "", rounding: str = ROUND_HALF_EVEN) -> str:
    """From the least to the largest, "1.7 to 3.4 ns"; one number where both read alike; NaN is left out."""
    known = [value for value in values if not math.isnan(value)]
    ends = [rounded(end, digits, rounding) for end in (min(known), max(known))] if known else [NONE]
    return " to ".join(dict.fromkeys(ends)) + (f" {unit}" if unit else "")


def listed(words: Iterable[str], last: str = "and") -> str:
    """Return "a, b and c"; "none" without words."""
    *first, end = list(words) or [NONE]
    return f"{', '.join(first)} {last} {end}" if first else end


def line_cell(row: Record) -> str:
    """The cell of a page's column "deck line": 32, or "32 of base.keyxm" in a deck that is continued."""
    return row.place().removeprefix("deck ").removeprefix("line ")


# ------------------------------------------------------------------------------------------------------------ Markdown


def markdown_table(headings: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A Markdown table without a final line end; cells are escaped."""
    lines = [headings, ["---"] * len(headings), *rows]
    return "\n".join(f"| {' | '.join(map(_cell, line))} |".replace("|  |", "| |") for line in lines)


Columns: TypeAlias = Mapping[str, str | Callable[[Record], str]]
"""By heading of a table on the page: the heading of the records whose text fills its cells, or what computes them."""


def table_of(rows: Iterable[Record], columns: Columns) -> str:
    """A Markdown table with a line for each record; raises MissingTableError for a heading that is not there."""
    return markdown_table(list(columns), ([_filling(row, cell) for cell in columns.values()] for row in rows))


def _filling(row: Record, cell: str | Callable[[Record], str]) -> str:
    return row.text(cell) if isinstance(cell, str) else cell(row)


def bullets(sentences: Iterable[str]) -> str:
    """A list, one sentence or more to an item; line breaks within an item are joined."""
    return "\n".join(f"* {' '.join(sentence.split())}" for sentence in sentences)


def _cell(text: str) -> str:
    return " ".join(text.split()).replace("|", r"\|")


def filled(template: Path, fields: Mapping[str, str]) -> str:
    """The text of a template with its fields; raises ValueError for fields that are missing or not used."""
    text = template.read_text(encoding="utf-8")
    wanted = {name for _, name, _, _ in Formatter().parse(text) if name is not None}
    if wanted != set(fields):
        wrong = ", ".join(sorted(wanted ^ set(fields)))
        raise ValueError(f"{template.name} and its fields differ: {wrong}")
    return text.format_map(fields)
