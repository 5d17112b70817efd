"""Tables of figures: kept as CSV, and put into a page, which is written by hand, between its marks."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path

from tests.benchmarks.runner import ROOT

FOLDER = ROOT / "docs" / "studies"

Cell = str | int | float | bool | None
Row = Mapping[str, str]
"""The cells of a row by the heading of their column, with its unit: "step [s]"."""

_MARKED = re.compile(r"(<!-- table ([a-z-]+) -->\n).*?(<!-- end -->)", re.DOTALL)


def save(name: str, headings: Sequence[str], rows: Iterable[Sequence[Cell]], folder: Path = FOLDER) -> None:
    """Write NAME.csv, numbers with twelve digits."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(headings)
    writer.writerows([_text(cell) for cell in row] for row in rows)
    (folder / f"{name}.csv").write_text(stream.getvalue(), encoding="utf-8", newline="\n")


def _text(cell: Cell) -> str:
    if isinstance(cell, bool):
        return "true" if cell else "false"
    if isinstance(cell, float):
        return repr(float(f"{cell:.12g}")) if cell == cell else ""  # noqa: PLR0124 - NaN is an empty cell
    return "" if cell is None else str(cell)


def load(name: str, folder: Path = FOLDER) -> list[Row]:
    """The rows of NAME.csv; none if it is not there yet."""
    path = folder / f"{name}.csv"
    if not path.exists():
        return []
    with path.open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def column(rows: Iterable[Row], heading: str) -> list[float]:
    """A column of numbers; NaN where there is none."""
    return [float(row[heading] or "nan") for row in rows]


def inserted(page: str, tables: Mapping[str, Callable[[], str]]) -> str:
    """A page with its tables made again; each stands between `<!-- table NAME -->` and `<!-- end -->`.

    Raises KeyError for a mark that has no table.
    """
    return _MARKED.sub(lambda found: f"{found[1]}\n{tables[found[2]]()}\n{found[3]}", page)


def rewrite(path: Path, tables: Mapping[str, Callable[[], str]]) -> None:
    """Put the tables into the page of a file."""
    path.write_text(inserted(path.read_text(encoding="utf-8"), tables), encoding="utf-8", newline="\n")


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table as Markdown."""
    lines = [head, ["---"] * len(head), *rows]
    return "".join(f"| {' | '.join(cells)} |\n" for cells in lines)


def digits(value: str | float | None, most: int = 3) -> str:
    """A number with this many digits, in thousands by blanks; empty for none, "-" for an infinite one."""
    if value in {"", None}:
        return ""
    number = float(value or 0.0)
    if number != number or abs(number) == float("inf"):  # noqa: PLR0124 - NaN
        return "-"
    text = f"{number:.{most}g}"
    if "e" in text and 1.0 <= abs(number) < 1e12:
        text = f"{number:.0f}"
    if "e" in text:
        power = text.partition("e")
        return f"{power[0]}e{int(power[2])}"
    whole, point, rest = text.partition(".")
    return (f"{int(whole):,}".replace(",", " ") if len(whole) > 4 else whole) + point + rest
