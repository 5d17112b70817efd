"""What a study found: tables, pictures, words; and the files they become."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

from mudline.files import write_atomically
from mudline.results.csv_lines import csv_lines
from mudline.study.machine import machine
from mudline.study.picture import Picture

Cell: TypeAlias = str | bool | int | float | None


class Column(NamedTuple):
    """A column of a table; the unit is empty for texts and pure numbers."""

    name: str
    unit: str = ""

    @property
    def heading(self) -> str:
        """Name and unit in one."""
        return f"{self.name} [{self.unit}]" if self.unit else self.name


@dataclass(frozen=True, slots=True)
class StudyTable:
    """Rows of numbers and texts.

    Attributes:
        name: a word for its file.
        title: what it shows, for people.
        columns: one for each cell of a row.
        rows: the cells; None where there is no value.
        brief: whether it is short enough to be printed where nobody asked for everything.
    """

    name: str
    title: str
    columns: tuple[Column, ...]
    rows: Sequence[Sequence[Cell]]
    brief: bool = True

    def csv(self) -> Iterator[str]:
        """The lines of the table as CSV, headed by the columns with their units; what is not finite is empty."""
        rows: Iterable[Iterable[Cell]] = (tuple(map(_finite, row)) for row in self.rows)
        return csv_lines([tuple(column.heading for column in self.columns), *rows])


class Omission(NamedTuple):
    """Something that a study tried, or would have tried, and has no result for."""

    what: str
    reason: str


@dataclass(frozen=True, slots=True)
class StudyReport:
    """All that a study found.

    Attributes:
        name: "precision", "stability" or "pruning"; the files begin with it.
        title: what was studied, for people.
        tables: the numbers.
        pictures: drawn when they are written.
        notes: what a reader of the numbers must know.
        omissions: failures and what was left out, each with its reason.
        machine: what the study was run on.
    """

    name: str
    title: str
    tables: tuple[StudyTable, ...]
    pictures: tuple[Picture, ...] = ()
    notes: tuple[str, ...] = ()
    omissions: tuple[Omission, ...] = ()
    machine: dict[str, str] = field(default_factory=machine)

    def json(self) -> str:
        """Everything but the pictures as JSON; what is not finite is null."""
        whole: dict[str, Any] = {
            "study": self.name,
            "title": self.title,
            "machine": self.machine,
            "tables": [_table(table) for table in self.tables],
            "pictures": [{"name": picture.name, "caption": picture.caption} for picture in self.pictures],
            "notes": list(self.notes),
            "omissions": [omission._asdict() for omission in self.omissions],
        }
        return json.dumps(whole, indent=1, ensure_ascii=False, allow_nan=False) + "\n"

    def write(self, folder: Path) -> list[Path]:
        """Write STUDY.json, STUDY-TABLE.csv and STUDY-PICTURE.png into `folder`, which is made if it is not there.

        Returns the files. Raises OSError, and ImportError for pictures without matplotlib.
        """
        pictures = [(folder / f"{self.name}-{picture.name}.png", picture.png()) for picture in self.pictures]
        folder.mkdir(parents=True, exist_ok=True)
        texts = [(folder / f"{self.name}-{table.name}.csv", "".join(table.csv())) for table in self.tables]
        texts.append((folder / f"{self.name}.json", self.json()))
        files = [*pictures, *((path, text.encode()) for path, text in texts)]
        for path, data in files:
            write_atomically(path, data)
        return [path for path, _ in files]


def _finite(cell: Cell) -> Cell:
    return None if isinstance(cell, float) and not math.isfinite(cell) else cell


def _table(table: StudyTable) -> dict[str, Any]:
    return {
        "name": table.name,
        "title": table.title,
        "columns": [column._asdict() for column in table.columns],
        "rows": [[_finite(cell) for cell in row] for row in table.rows],
    }
