"""The tables docs/studies/benchmark-*.csv: where they are, and writing and reading them."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from mudline.study.report import Cell, Column, StudyTable
from tests.benchmarks.runner import ROOT

FOLDER = ROOT / "docs" / "studies"

Row = Mapping[str, str]
"""The cells of a row by the heading of their column, with its unit: "step [s]"."""


def path_of(name: str, folder: Path = FOLDER) -> Path:
    """The file of a table."""
    return folder / f"benchmark-{name}.csv"


def save(name: str, headings: Sequence[str], rows: Iterable[Sequence[Cell]], folder: Path = FOLDER) -> None:
    """Write a table; a heading is a name with its unit in brackets, if it has one."""
    parts = (heading.removesuffix("]").partition(" [") for heading in headings)
    columns = tuple(Column(title, unit) for title, _, unit in parts)
    lines = StudyTable(name, name, columns, [tuple(map(_rounded, row)) for row in rows]).csv()
    path_of(name, folder).write_text("".join(lines), encoding="utf-8", newline="\n")


def load(name: str, folder: Path = FOLDER) -> list[Row]:
    """The rows of a table; none if it is not there yet."""
    path = path_of(name, folder)
    if not path.exists():
        return []
    with path.open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def column(rows: Iterable[Row], heading: str) -> list[float]:
    """A column of numbers; NaN where there is none."""
    return [float(row[heading] or "nan") for row in rows]


def _rounded(cell: Cell) -> Cell:
    return float(f"{cell:.12g}") if isinstance(cell, float) else cell
