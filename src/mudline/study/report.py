"""How a study is run, and what it found: tables, pictures, words; and the files they become.

A study is made of parts. A part declares the columns of its tables once (`Layout`), draws its pictures, and returns
both with its notes and omissions as a `Section`; here they become one report, its CSV, JSON and PNG files. Pictures
have one style: colours that colour-blind readers tell apart, a marker for each line besides.
"""

from __future__ import annotations

import io
import json
import math
import warnings
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from operator import attrgetter
from pathlib import Path
from typing import TYPE_CHECKING, Any, Generic, Literal, NamedTuple, TypeAlias, TypeVar, get_type_hints

from mudline.files import write_atomically
from mudline.quantities import csv_lines, labelled
from mudline.short_repr import cut
from mudline.study.timing import machine

if TYPE_CHECKING:  # only who draws loads matplotlib
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Row = TypeVar("Row")
Key = TypeVar("Key", bound=Hashable)
Cell: TypeAlias = str | bool | int | float | None

# ------------------------------------------------------------------------------------------------------------- running


class StudyError(Exception):
    """The scene has nothing that this study could measure, or something that it cannot; the message says what."""


def silent(message: str) -> None:
    """Report nothing."""
    del message


@dataclass(frozen=True, slots=True)
class StudyOptions:
    """What the user chose.

    Attributes:
        full: a longer run, with finer ladders and more repeats.
        progress: is called with a few words on what is done next.
    """

    full: bool = False
    progress: Callable[[str], None] = silent


# -------------------------------------------------------------------------------------------------------------- tables


class Column(NamedTuple):
    """A column of a table; the unit is empty for texts and pure numbers."""

    name: str
    unit: str = ""


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
        return csv_lines([tuple(labelled(*column) for column in self.columns), *rows])

    def as_json(self) -> dict[str, Any]:
        """The table as it stands in the JSON of a report; what is not finite is null."""
        return {
            "name": self.name,
            "title": self.title,
            "columns": [column._asdict() for column in self.columns],
            "rows": [[_finite(cell) for cell in row] for row in self.rows],
        }


_UNITS = {"metric": ("N", "m", "kg"), "imperial": ("lbf", "ft", "slug")}


@dataclass(frozen=True)
class Layout(Generic[Row]):
    """A table before it has rows: the one place to add a column.

    Attributes:
        name: a word for its file.
        title: what it shows, for people; may have words in braces, which the study fills in.
        columns: what fills each column, by its heading, the name with the unit in brackets: "step [s]". In a heading
            {force}, {length} and {mass} are the units of the deck. `columns_of` has those that are fields of a row.
        brief: see `StudyTable`.
    """

    name: str
    title: str
    columns: Mapping[str, Callable[[Row], Cell]]
    brief: bool = True

    def table(self, rows: Iterable[Row], units: str = "", **words: object) -> StudyTable:
        """The table of these rows, in the "metric" or other units of a deck; `words` are those in braces."""
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


# ------------------------------------------------------------------------------------------------------------ pictures

_COLORS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#000000", "#e69f00", "#56b4e9", "#8c6d31", "#7a7a7a", "#b2182b")
_MARKERS = ("o", "s", "^", "D", "v", "P", "X", "<", ">", "*")
_LINES = ("-", "--", "-.", ":")
_LONGEST = 34

Points = Sequence[tuple[float, float]]


@dataclass(frozen=True, slots=True)
class Picture:
    """A picture that is drawn when it is wanted.

    Attributes:
        name: a word for its file.
        caption: what it shows.
        draw: draws it on an empty figure.
        size: width and height in inches; 100 points to the inch.
    """

    name: str
    caption: str
    draw: Callable[[Figure], None]
    size: tuple[float, float] = (9.0, 6.0)

    def png(self) -> bytes:
        """The picture as PNG; raises ImportError without matplotlib."""
        from matplotlib.figure import Figure  # noqa: PLC0415 - a study without pictures does without it

        figure = Figure(figsize=self.size, layout="constrained", dpi=100)
        self.draw(figure)
        stream = io.BytesIO()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # a letter that the font lacks becomes a box
            figure.savefig(stream, format="png", metadata={"Software": None})
        return stream.getvalue()


def style(index: int) -> dict[str, Any]:
    """Colour, marker and dash of the line of this number, from 0; so many lines as these differ."""
    return {
        "color": _COLORS[index % len(_COLORS)],
        "marker": _MARKERS[(index + index // len(_COLORS)) % len(_MARKERS)],
        "linestyle": _LINES[index // len(_COLORS) % len(_LINES)],
        "markersize": 5,
        "linewidth": 1.4,
    }


def draw_lines(
    axes: Axes,
    lines: Mapping[str, Points],
    title: str,
    x: str,
    y: str,
    scale: Literal["loglog", "semilogx"] = "loglog",
) -> None:
    """A line through points for each name of the legend, in the styles from the first on; the rest as in `label`."""
    draw = getattr(axes, scale)
    for index, (name, points) in enumerate(lines.items()):
        draw([point[0] for point in points], [point[1] for point in points], label=name, **style(index))
    label(axes, title, x, y)


def panels(figure: Figure, count: int, across: int, *, sharey: bool = False) -> list[Axes]:
    """So many axes, `across` of them in a row."""
    found: list[Axes] = list(figure.subplots(-(-count // across), across, squeeze=False, sharey=sharey).flat)
    for axes in found[count:]:
        axes.remove()
    return found[:count]


def drawn(name: str) -> str:
    """A name of the deck as plain text of a picture, where $ would begin a formula, and _ hide it from a legend."""
    text = "".join(char if char.isprintable() else "\ufffd" for char in name).replace("$", r"\$")
    return f" {text}" if text.startswith("_") else text


def shortened(name: str) -> str:
    """A name of the deck that fits above a panel, as it is drawn."""
    return drawn(cut(name, _LONGEST))


def label(axes: Axes, title: str, x: str, y: str) -> None:
    """Title, axes with their units, and a grid."""
    axes.set_title(title, fontsize="medium")
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    axes.grid(visible=True, which="major", alpha=0.35)


def legend_below(figure: Figure, axes: Axes, columns: int = 4) -> None:
    """One legend for all axes, below them, where it covers nothing."""
    handles, names = axes.get_legend_handles_labels()
    figure.legend(handles, names, loc="outside lower center", ncols=columns, fontsize="small")


# -------------------------------------------------------------------------------------------------------------- report


class Omission(NamedTuple):
    """Something that a study tried, or would have tried, and has no result for."""

    what: str
    reason: str


class Section(NamedTuple):
    """What one part of a study found; the fields are those of `StudyReport`."""

    tables: Sequence[StudyTable] = ()
    pictures: Sequence[Picture] = ()
    notes: Sequence[str] = ()
    omissions: Sequence[Omission] = ()


def paragraphs(text: str) -> list[str]:
    """The notes of a text, one from each paragraph, without its line breaks."""
    return [" ".join(paragraph.split()) for paragraph in text.strip().split("\n\n")]


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
        """Everything but the pictures as JSON; what is not finite is null."""
        whole: dict[str, Any] = {
            "study": self.name,
            "title": self.title,
            "machine": self.machine,
            "tables": [table.as_json() for table in self.tables],
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
        files = [*pictures, *((path, text.encode("utf-8", "backslashreplace")) for path, text in texts)]
        for path, data in files:
            write_atomically(path, data)
        return [path for path, _ in files]


def _finite(cell: Cell) -> Cell:
    return None if isinstance(cell, float) and not math.isfinite(cell) else cell
