"""The results of a study: tables, pictures, notes, and the files that are written of them.

How to write a study, or a part of one:

* A study is a package `mudline.study.NAME` with `STUDY = Study(NAME, title, parts, page, advice)` of
  `mudline.study.running`, and `run = STUDY.run`. A `Part(name, run, weight)` has a function `(scene, options) ->
  Section`; `mudline study NAME --only PART` runs it alone, and `-o DIR` writes its files as soon as it is finished.
* A part declares the columns of its tables once (`Layout`), returns them with pictures, notes and omissions as a
  `Section`, and reports its progress: `for case in options.each(cases, lambda case: case.title): ...`.
* `page(tables) -> str` fills the template `page.md` beside it: `filled(Path(__file__).with_name("page.md"), fields)`.
  All numbers come from `tables` (`mudline.study.pages.Tables`): `tables.rows("steps", scheme="newmark")`,
  `row.number("step [s]")`, `row.text("case")`; they are formatted by `rounded`, `percent`, `time`, `span` and
  `table_of` there, limits rounded `DOWN` and bounds `UP`. A template has digits only in code, names, links and years,
  which a test checks; another test makes the pages of docs/studies from their CSV files. The page is written for any
  deck: what depends on the deck is a field, or is chosen by an `if` of `page.py`.
* `advice(tables) -> str` is the one sentence about the deck: the first line of the printed report, `advice` in JSON,
  and the field {advice} of a page. `row.place()` names a deck line, with the file of a deck that is continued.
* The table `machine` (`what`, `value`) is added to each study: deck, processor, versions, run time of all parts.
* Pictures (`mudline.study.pictures`): `STYLES` of `mudline.study.schemes` has the style of each scheme by its title,
  also for `draw_lines(..., styles=STYLES)`; `zero_place` and `zero_tick` give 0 a tick on a logarithmic axis; an error
  that is divided by something is labelled "relative error of ... [-]".
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from operator import attrgetter
from pathlib import Path
from typing import Any, Generic, NamedTuple, TypeAlias, TypeVar, get_type_hints

from mudline.files import write_atomically
from mudline.quantities import csv_lines, labelled
from mudline.study.pictures import Picture
from mudline.study.timing import machine

Row = TypeVar("Row")
Key = TypeVar("Key", bound=Hashable)
Cell: TypeAlias = str | bool | int | float | None

# ------------------------------------------------------------------------------------------------------------- running


class StudyError(Exception):
    """The scene has nothing that the study can measure, or something that it cannot measure; the message says what."""


def silent(message: str) -> None:
    """Report nothing."""
    del message


def still(share: float) -> None:
    """Show nothing."""
    del share


@dataclass(frozen=True, slots=True)
class StudyOptions:
    """Options of a run.

    Attributes:
        full: a longer run, with finer ladders and more repeats.
        progress: is called with a short text on what is done next.
        advance: is called with the share that is done, 0 to 1; of the part, where a part calls it.
        only: the parts that are run; empty for all.
        folder: where the files of finished parts are written, and from where an interrupted study is resumed; None for
            no files.
    """

    full: bool = False
    progress: Callable[[str], None] = silent
    advance: Callable[[float], None] = still
    only: tuple[str, ...] = ()
    folder: Path | None = None

    def each(self, items: Sequence[Row], words: Callable[[Row], str]) -> Iterator[Row]:
        """Yield the items, and report each and the share of them that is done."""
        for done, item in enumerate(items):
            self.progress(words(item))
            self.advance(done / len(items))
            yield item


# -------------------------------------------------------------------------------------------------------------- tables


class Column(NamedTuple):
    """A column of a table; the unit is empty for texts and pure numbers."""

    name: str
    unit: str = ""


@dataclass(frozen=True, slots=True)
class StudyTable:
    """Rows of numbers and texts.

    Attributes:
        name: of its file.
        title: what it shows, for readers.
        columns: one for each cell of a row.
        rows: the cells; None where there is no value.
        brief: whether it is short enough for the printed report.
    """

    name: str
    title: str
    columns: tuple[Column, ...]
    rows: Sequence[Sequence[Cell]]
    brief: bool = True

    def csv(self) -> Iterator[str]:
        """The lines of the table as CSV, headed by the columns with their units; what is not finite is empty."""
        rows: Iterable[Iterable[Cell]] = (tuple(map(_finite, row)) for row in self.rows)
        return csv_lines([tuple(labelled(*column) for column in self.columns), *rows])

    def as_json(self) -> dict[str, Any]:
        """The table as it stands in the JSON of a report; what is not finite is null."""
        return {
            "name": self.name,
            "title": self.title,
            "brief": self.brief,
            "columns": [column._asdict() for column in self.columns],
            "rows": [[_finite(cell) for cell in row] for row in self.rows],
        }


_UNITS = {"metric": ("N", "m", "kg"), "imperial": ("lbf", "ft", "slug")}


@dataclass(frozen=True)
class Layout(Generic[Row]):
    """A table before it has rows: the one place to add a column.

    Attributes:
        name: of its file.
        title: what it shows, for readers; may have fields in braces, which the study fills in.
        columns: what fills each column, by its heading, the name with the unit in brackets: "step [s]". In a heading
            {force}, {length} and {mass} are the units of the deck. `columns_of` has those that are fields of a row.
        brief: see `StudyTable`.
    """

    name: str
    title: str
    columns: Mapping[str, Callable[[Row], Cell]]
    brief: bool = True

    def table(self, rows: Iterable[Row], units: str = "", **words: object) -> StudyTable:
        """The table of these rows, in the "metric" or other units of a deck; `words` are the fields in braces."""
        names = ("force", "length", "mass")
        words.update(zip(names, _UNITS.get(units, names), strict=True))
        parts = (heading.format(**words).removesuffix("]").partition(" [") for heading in self.columns)
        columns = tuple(Column(name, unit) for name, _, unit in parts)
        cells = [tuple(cell(row) for cell in self.columns.values()) for row in rows]
        return StudyTable(self.name, self.title.format(**words), columns, cells, self.brief)


def columns_of(row: type[Row]) -> dict[str, Callable[[Row], Cell]]:
    """A column for each field of a row that is declared as `Annotated[type, heading]`, in the order of the fields."""
    hints = get_type_hints(row, include_extras=True)
    return {hint.__metadata__[0]: attrgetter(name) for name, hint in hints.items() if hasattr(hint, "__metadata__")}


def grouped(rows: Iterable[Row], key: Callable[[Row], Key]) -> dict[Key, list[Row]]:
    """The rows of each key, in the order in which they come."""
    found: dict[Key, list[Row]] = {}
    for row in rows:
        found.setdefault(key(row), []).append(row)
    return found


# -------------------------------------------------------------------------------------------------------------- report


class Omission(NamedTuple):
    """Something that has no result, and why."""

    what: str
    reason: str


class Section(NamedTuple):
    """The results of one part of a study; the fields are those of `StudyReport`."""

    tables: Sequence[StudyTable] = ()
    pictures: Sequence[Picture] = ()
    notes: Sequence[str] = ()
    omissions: Sequence[Omission] = ()


def paragraphs(text: str) -> list[str]:
    """The notes of a text, one from each paragraph, without its line breaks."""
    return [" ".join(paragraph.split()) for paragraph in text.strip().split("\n\n")]


class Finished(NamedTuple):
    """A part of a study that was run, and the seconds that it took."""

    name: str
    seconds: float
    section: Section


@dataclass(frozen=True, slots=True)
class StudyReport:
    """All results of a study.

    Attributes:
        name: "precision", "stability" or "pruning"; the files begin with it.
        title: what was studied, for readers.
        tables: the numbers.
        pictures: drawn when they are written.
        notes: how the numbers are measured and what follows from them.
        omissions: failures and what was left out, each with its reason.
        machine: processor, system and versions of the run.
        advice: one sentence about the deck; "" for none.
        page: the page in Markdown; "" for none.
        key: a digest of what the numbers depend on.
        parts: those that are finished.
    """

    name: str
    title: str
    tables: tuple[StudyTable, ...]
    pictures: tuple[Picture, ...] = ()
    notes: tuple[str, ...] = ()
    omissions: tuple[Omission, ...] = ()
    machine: dict[str, str] = field(default_factory=machine)
    advice: str = ""
    page: str = ""
    key: str = ""
    parts: tuple[Finished, ...] = ()

    @classmethod
    def of(cls, name: str, title: str, sections: Iterable[Section]) -> StudyReport:
        """Join sections; a note that several of them have stands there once."""
        found = list(sections)
        return cls(
            name,
            title,
            tuple(table for section in found for table in section.tables),
            tuple(picture for section in found for picture in section.pictures),
            tuple(dict.fromkeys(note for section in found for note in section.notes)),
            tuple(omission for section in found for omission in section.omissions),
        )

    def json(self) -> str:
        """Everything but the pictures and the page as JSON; what is not finite is null."""
        whole: dict[str, Any] = {
            "study": self.name,
            "title": self.title,
            "advice": self.advice,
            "machine": self.machine,
            "tables": [table.as_json() for table in self.tables],
            "pictures": [{"name": picture.name, "caption": picture.caption} for picture in self.pictures],
            "notes": list(self.notes),
            "omissions": [omission._asdict() for omission in self.omissions],
            "key": self.key,
            "parts": [
                {
                    "name": part.name,
                    "seconds": round(part.seconds, 3),
                    "tables": [table.name for table in part.section.tables],
                    "pictures": [picture.name for picture in part.section.pictures],
                    "notes": list(part.section.notes),
                    "omissions": [omission._asdict() for omission in part.section.omissions],
                }
                for part in self.parts
            ],
        }
        return json.dumps(whole, indent=1, ensure_ascii=False, allow_nan=False) + "\n"

    def json_file(self) -> File:
        """STUDY.json."""
        return f"{self.name}.json", _encoded(self.json())

    def write(self, folder: Path) -> list[Path]:
        """Write STUDY.md, STUDY.json, STUDY-TABLE.csv and STUDY-PICTURE.png into `folder`.

        The folder is made if it is not there. Returns the files. Raises OSError, and ImportError for pictures without
        matplotlib.
        """
        files = part_files(self.name, Section(self.tables, self.pictures))
        if self.page:
            files.append((f"{self.name}.md", _encoded(self.page)))
        return write_files(folder, [*files, self.json_file()])


File: TypeAlias = tuple[str, bytes]
"""Name and content."""


def part_files(study: str, section: Section) -> list[File]:
    """The pictures and tables of a section as files; raises ImportError for pictures without matplotlib."""
    pictures = [(f"{study}-{picture.name}.png", picture.png()) for picture in section.pictures]
    return pictures + [(f"{study}-{table.name}.csv", _encoded("".join(table.csv()))) for table in section.tables]


def write_files(folder: Path, files: Iterable[File]) -> list[Path]:
    """Write files into a folder, which is made if it is not there; returns their paths. Raises OSError."""
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    for name, data in files:
        write_atomically(folder / name, data)
        written.append(folder / name)
    return written


def _encoded(text: str) -> bytes:
    return text.encode("utf-8", "backslashreplace")


def _finite(cell: Cell) -> Cell:
    return None if isinstance(cell, float) and not math.isfinite(cell) else cell
