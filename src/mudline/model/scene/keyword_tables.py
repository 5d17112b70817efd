"""Tables in the form of the manual: sheets whose headings are those of a keyword's page, as lines of a deck.

The rows become lines of the keyword and are read as such, so a sheet cannot hold more than a deck can.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import PurePath
from typing import NamedTuple

import numpy as np

from mudline.basics.short_repr import cut, listed
from mudline.basics.units import UNITS
from mudline.language.deck.model import Deck
from mudline.language.deck.reading import read_source
from mudline.language.diagnostics import Severity
from mudline.language.keywords import catalogue
from mudline.language.keywords.fields import Setting
from mudline.language.keywords.model import Block, FieldSpec, Record, Rows, record_schema
from mudline.language.keywords.table import Table
from mudline.language.keywords.values import Equation, Kind, Names
from mudline.language.syntax.rows import read_number
from mudline.language.syntax.source import Source
from mudline.model.curves import CurveError, ForceCurve
from mudline.model.scene.csv_file import data_error
from mudline.model.scene.sets import ALL
from mudline.model.scene.workbook import Cell, WorkbookSheet


@dataclass(frozen=True, eq=False)
class TableColumn:
    """Column of a form, and the headings by which it is known, without spaces and case."""

    spec: FieldSpec
    headings: frozenset[str]

    @classmethod
    def of(cls, spec: FieldSpec, *headings: str) -> TableColumn:
        """Return the column of a field that is known by some headings."""
        return cls(spec, frozenset(map(plain, headings)) - {""})

    @property
    def label(self) -> str:
        """Name of the column in a message."""
        return self.spec.about.heading or self.spec.label.removesuffix("=")


@dataclass(frozen=True, eq=False)
class TableForm:
    """Rows of a keyword as a table.

    declared: the keyword.
    name: column that names their set, curve or object, if they have one.
    values: columns of their values.
    opening: the line that selects one of several kinds of rows.
    curve: declaration of the rows, if they are a curve.
    """

    declared: type[Block]
    name: TableColumn | None
    values: tuple[TableColumn, ...]
    opening: str
    curve: Rows | None

    @property
    def keyword(self) -> str:
        """Name of the keyword."""
        return str(self.declared.model_fields["keyword"].default)

    @property
    def section(self) -> str:
        """Section in which its lines are written."""
        return self.declared.sections[0]

    @property
    def columns(self) -> tuple[TableColumn, ...]:
        """All columns, that of the name first."""
        return ((self.name,) if self.name else ()) + self.values

    @property
    def required(self) -> list[TableColumn]:
        """Columns of values that a table must have."""
        return [column for column in self.values if column.spec.required]


@cache
def table_forms() -> tuple[TableForm, ...]:
    """Return the tables of all keywords."""
    classes = catalogue.block_classes()
    records = ((cls, record) for cls in classes for slot in record_schema(cls).slots for record in slot.record.values())
    return tuple(form for declared, record in records for form in _of_record(declared, record))


def _of_record(declared: type[Block], record: type[Record]) -> Iterator[TableForm]:
    schema = record_schema(record)
    named = (spec for spec in schema.keys.values() if spec.kind is Kind.NAME and not spec.many)
    named = (spec for spec in named if not (isinstance(spec.about, Setting) and spec.about.inline))
    name = next((spec for spec in named if spec.about.names is Names.SET or spec.about.defines), None)
    if any(spec.required and spec is not name for spec in schema.keys.values()):
        return
    rows = [spec for spec in schema.slots if spec.row is not None and not spec.key]
    for spec in rows:
        values = record_schema(spec.row).slots if spec.row else []
        if not values or any(value.key or value.row or value.record for value in values):
            continue
        opening = f"{record.sticky.upper()}={spec.json.upper()}" if record.sticky and len(rows) > 1 else ""
        yield TableForm(
            declared,
            None if name is None else TableColumn.of(name, name.key, f"{name.key} name", name.about.heading),
            tuple(TableColumn.of(value, value.json, value.label, value.about.heading) for value in values),
            opening,
            curve=spec.about if isinstance(spec.about, Rows) and spec.about.curve else None,
        )


def plain(text: str) -> str:
    """Return a heading in the form in which headings are compared."""
    return re.sub(r"[\W_]+", "", text).casefold()


_HEADING = re.compile(r"\s*(?P<name>.*?)\s*(?:[\[(]\s*(?P<unit>[^\[(]*?)\s*[\])])?\s*", re.DOTALL)


class TableDeck(NamedTuple):
    """Deck of some tables, and the sheets that are not tables of a keyword."""

    deck: Deck
    left_out: Sequence[str]


def read_tables(sheets: Sequence[WorkbookSheet], file: str, units: str | None = None) -> TableDeck:
    """Return the deck that some sheets describe, with a block for each keyword in the order of its first sheet.

    * The first row of a sheet has the headings, in any order and case, with or without a unit in brackets. The keyword
      is the one whose page has them.
    * A sheet without a column for the name of its curve is a curve with the sheet's name.
    * A blank name continues the one above. In the first row it stands for all elements, if the keyword allows that.
    * Rows without a value are skipped, and so are sheets without a heading of a keyword.
    * The units are those given, else those in brackets, else metric.

    Raises DeckError if something cannot be a line of the keyword; the message names the cell.
    """
    entries_by_form: dict[TableForm, list[_NamedRows]] = {}
    left_out: list[str] = []
    systems: dict[str, str] = {}
    for sheet in sheets:
        head = _head(sheet)
        if head is None:
            left_out.append(sheet.title)
            continue
        systems |= dict.fromkeys(head.systems, sheet.title)
        _add(entries_by_form.setdefault(head.form, []), _entries(sheet, head), head.form)
    if not entries_by_form:
        raise data_error(file, "no table of a keyword: expected the headings of its page in the first row")
    if len(systems) > 1:
        what = " and ".join(f"{system} on {listed([sheet])}" for system, sheet in systems.items())
        raise data_error(file, f"the headings have different units: {what}; a deck has one unit system")
    return TableDeck(_deck(entries_by_form, file, units or next(iter(systems), "metric")), left_out)


# --------------------------------------------------------------------------------------------------- headings


@dataclass(frozen=True)
class _Head:
    """Columns of a sheet by the headings in its first row, and the unit systems of the units in these."""

    form: TableForm
    places: Mapping[TableColumn, int]
    systems: Sequence[str]


def _head(sheet: WorkbookSheet) -> _Head | None:
    """Return the keyword and columns of a sheet; None if it is not a table of a keyword.

    Raises DeckError if it has most of the headings of a keyword, or a heading that the keyword does not have.
    """
    cells: dict[str, tuple[Cell, str]] = {}
    for cell in sheet.rows[0] if sheet.rows else ():
        match = _HEADING.fullmatch(str(cell.value))
        name, unit = (match["name"], match["unit"] or "") if match else ("", "")
        word = plain(name)
        if word in cells:
            what = f"a second column {name.strip().lower()}: give each curve a sheet of its own, or name it in a column"
            raise sheet.fault(cell.row, cell.column, what)
        cells[word] = cell, unit
    forms = [form for form in table_forms() if any(column.headings & cells.keys() for column in form.columns)]
    titled = [form for form in forms if plain(form.keyword) == plain(sheet.title)]
    fitting = [form for form in titled or forms if all(column.headings & cells.keys() for column in form.required)]
    fitting = [form for form in fitting if form.name is None or form.curve or form.name.headings & cells.keys()]
    if not fitting:
        _refuse(sheet, cells, titled or forms)
        return None
    known = {form: sum(bool(column.headings & cells.keys()) for column in form.columns) for form in fitting}
    best = [form for form in fitting if known[form] == max(known.values())]
    best = [form for form in best if not catalogue.is_superseded(form.keyword)] or best
    if len(best) > 1:
        what = f"the headings are those of {' and '.join(f'*{form.keyword}' for form in best)}"
        cell = sheet.rows[0][0]
        raise sheet.fault(cell.row, cell.column, f"{what}: give the sheet the name of one of them")
    return _placed(sheet, best[0], cells)


def _refuse(sheet: WorkbookSheet, cells: Mapping[str, tuple[Cell, str]], forms: Sequence[TableForm]) -> None:
    """Raise DeckError for a sheet that has most of the headings of a keyword, or half of those of a curve."""
    titled = [form for form in forms if plain(form.keyword) == plain(sheet.title)]
    newer = [form for form in forms if not catalogue.is_superseded(form.keyword)]
    for form in titled or sorted(newer, key=lambda form: form.declared.subject != "seabed"):
        there = [column for column in form.required if column.headings & cells.keys()]
        lacks = [column.spec.label for column in form.required if column not in there]
        if lacks and len(there) >= len(lacks) + (form.curve is None):
            cell = next(cells[heading][0] for heading in there[0].headings if heading in cells)
            what = f"a column {there[0].spec.label} and none headed {' or '.join(lacks)}"
            raise sheet.fault(cell.row, cell.column, f"{what}: *{form.keyword} needs both, in the first row")


def _placed(sheet: WorkbookSheet, form: TableForm, cells: Mapping[str, tuple[Cell, str]]) -> _Head:
    places: dict[TableColumn, int] = {}
    systems: list[str] = []
    for word, (cell, unit) in cells.items():
        column = next((known_column for known_column in form.columns if word in known_column.headings), None)
        if column is None or column in places:
            known = ", ".join(known_column.label for known_column in form.columns)
            what = f"*{form.keyword} has no column {cut(str(cell.value), 40)!r}: it has {known}; leave others out"
            raise sheet.fault(cell.row, cell.column, what)
        places[column] = cell.column
        systems += _systems(sheet, cell, column.spec.about.unit, unit)
    return _Head(form, places, systems)


def _systems(sheet: WorkbookSheet, cell: Cell, dimension: str, unit: str) -> list[str]:
    """Return the unit system of a unit in a heading, if it shows one. Raises DeckError for a unit of no system."""
    if not unit or dimension in {"", "-", "deg"}:
        return []
    texts = {name: system.text(dimension.replace(" ", "")) for name, system in UNITS.items() if system.known}
    names = {system: text.replace(" ", "") for system, text in texts.items()}
    written = unit.replace("^", "").replace("²", "2").replace("³", "3").replace(" ", "")
    fitting = [system for system, name in names.items() if name == written]
    if not fitting:
        what = f"expected the unit {' or '.join(dict.fromkeys(names.values()))}, found {cut(unit, 40)!r}"
        raise sheet.fault(cell.row, cell.column, what)
    return fitting if len(fitting) == 1 else []


# ------------------------------------------------------------------------------------------------------- rows


@dataclass
class _NamedRows:
    """Rows that belong together: their name, its cell, each row with its line, and the first column of values."""

    sheet: WorkbookSheet
    name: str
    cell: tuple[int, int]
    lines: list[tuple[int, str]] = field(default_factory=list)
    first: int = 1


def _entries(sheet: WorkbookSheet, head: _Head) -> list[_NamedRows]:
    """Return the rows of a sheet by their names, in the order of their first rows."""
    form = head.form
    entries: dict[str, _NamedRows] = {}
    named = form.name if form.name in head.places else None
    first = min(head.places[column] for column in form.values if column in head.places)
    name = None if named or form.name is None else sheet.title
    if name is not None:
        entries[name.casefold()] = _NamedRows(sheet, name, (1, first), first=first)
    for cells in sheet.rows[1:]:
        cells_by_column = {cell.column: cell for cell in cells}
        for cell in cells:
            if cell.column not in head.places.values():
                what = "a value in a column without a heading: give it one, or remove it"
                raise sheet.fault(cell.row, cell.column, what)
        if not cells_by_column:
            continue
        row = cells[0].row
        if named:
            name = _name(sheet, head.places[named], named, cells_by_column, row, name)
        place = row, head.places[named] if named else first
        entry = entries.setdefault((name or "").casefold(), _NamedRows(sheet, name or "", place, first=first))
        entry.lines.append((row, _line(sheet, head, cells_by_column, row)))
    return list(entries.values())


def _name(
    sheet: WorkbookSheet, place: int, column: TableColumn, cells: Mapping[int, Cell], row: int, above: str | None
) -> str:
    """Return the name of a row; a blank name is that of the row above, in the first row that of all elements."""
    cell = cells.get(place)
    if cell is not None:
        return str(_value(sheet, cell, "a name")).strip()
    if above is None and column.spec.required:
        raise sheet.fault(row, place, f"expected the name of a {column.spec.key.lower()}, found nothing")
    return ALL.upper() if above is None else above


def _line(sheet: WorkbookSheet, head: _Head, cells: Mapping[int, Cell], row: int) -> str:
    """Return the fields of a row; empty fields at the end are left out."""
    fields: list[str] = []
    for column in head.form.values:
        place = head.places.get(column, 0)
        cell = cells.get(place)
        if cell is None and column.spec.required:
            raise sheet.fault(row, place, f"expected {_expected(column)}, found nothing")
        fields.append("" if cell is None else _field(sheet, column, cell))
    while fields and not fields[-1]:
        fields.pop()
    return ", ".join(fields)


def _expected(column: TableColumn) -> str:
    return "a name" if column.spec.kind is Kind.NAME else "a number"


def _field(sheet: WorkbookSheet, column: TableColumn, cell: Cell) -> str:
    value = _value(sheet, cell, _expected(column))
    if isinstance(value, int | float) and not isinstance(value, bool):
        whole = column.spec.kind in (Kind.WHOLE, Kind.IDENT) and float(value).is_integer()
        return str(int(value)) if whole else repr(float(value))
    if isinstance(value, str) and column.spec.kind not in (Kind.REAL, Kind.WHOLE):
        return value.strip()
    if isinstance(value, str) and (Equation.match(value) or (not sheet.is_workbook and read_number(value) is not None)):
        return value
    text = cut(repr(value), 40) if isinstance(value, str | bool) else cut(str(value), 40)
    is_text = isinstance(value, str) and read_number(value.replace(",", ".")) is not None
    advice = "; it is a text, format the cell as a number" if is_text else ""
    if is_text and not sheet.is_workbook:
        advice = "; write a decimal point"
    raise sheet.fault(cell.row, cell.column, f"expected a number, found {text}{advice}")


def _value(sheet: WorkbookSheet, cell: Cell, expected: str) -> object:
    if cell.uncalculated:
        what = "a formula that was never calculated: open the workbook in a spreadsheet program and save it"
        raise sheet.fault(cell.row, cell.column, f"expected {expected}, found {what}")
    return cell.value


def _add(known: list[_NamedRows], more: Sequence[_NamedRows], form: TableForm) -> None:
    """Add the rows of one more sheet to those of its keyword; a name may be on one sheet only."""
    for entry in more:
        same = next((each for each in known if each.name.casefold() == entry.name.casefold() and form.name), None)
        if same is not None:
            key = form.name.spec.key.lower() if form.name else ""
            what = f"the {key} {cut(entry.name, 40)!r} is also on the sheet {same.sheet.title}: rename one"
            raise entry.sheet.fault(*entry.cell, what)
        known.append(entry)


# ------------------------------------------------------------------------------------------------------- deck


@dataclass
class _DeckText:
    """Lines of a deck, and the cell of each line that comes from a table."""

    lines: list[str] = field(default_factory=list)
    places: dict[int, tuple[WorkbookSheet, int, int]] = field(default_factory=dict)

    def add(self, line: str, entry: _NamedRows, place: tuple[int, int]) -> None:
        if "\n" in line or "\r" in line:
            raise entry.sheet.fault(*place, "a line end in a cell: a name is on one line")
        self.lines.append(f" {line}")
        self.places[len(self.lines)] = entry.sheet, *place


def _deck(tables: Mapping[TableForm, Sequence[_NamedRows]], file: str, units: str) -> Deck:
    """Return the deck with the lines of all tables; raises DeckError at cells that a deck cannot hold."""
    text = _DeckText()
    section = ""
    for form, entries in sorted(tables.items(), key=lambda item: catalogue.SECTIONS.index(item[0].section)):
        if form.section != section:
            section = form.section
            text.lines.append(f"${section}")
        text.lines += [f"*{form.keyword}", *([f" {form.opening}"] if form.opening else [])]
        for entry in entries:
            if form.name:
                text.add(f"{form.name.spec.key}={entry.name}", entry, entry.cell)
            for row, line in entry.lines:
                text.add(line, entry, (row, entry.first))
    deck = read_source(Source(file, "\n".join([*text.lines, ""])), units=units)
    deck.source = PurePath(file).name
    for problem in deck.problems:
        if problem.weight is Severity.ERROR:
            place = text.places.get(deck.place(problem).line, next(iter(text.places.values())))
            raise place[0].fault(*place[1:], problem.message)
    _check(deck, tables)
    return deck


def _check(deck: Deck, tables: Mapping[TableForm, Sequence[_NamedRows]]) -> None:
    """Raise DeckError for a name that reads otherwise in a deck, and for points that do not form a curve."""
    for form, entries in tables.items():
        block = next(block for _, block in deck.blocks(form.keyword, form.section))
        slot = next(slot for slot in record_schema(form.declared).slots if slot.record)
        for entry, record in zip(entries, getattr(block, slot.name), strict=True):
            named = getattr(record, form.name.spec.name) if form.name else entry.name
            if named != entry.name:
                what = f"{cut(entry.name, 40)!r} cannot be a name in a deck: it reads as {cut(str(named), 40)!r}"
                raise entry.sheet.fault(*entry.cell, what)
            if form.curve and isinstance(table := getattr(record, "points", None), Table):
                points = np.column_stack([table.column(index) for index in form.curve.axes])
                if np.isnan(points).any():  # an equation: the deck's own checks see its value
                    continue
                try:
                    ForceCurve(points)
                except CurveError as error:
                    row = entry.lines[error.index][0] if 0 <= error.index < len(entry.lines) else entry.cell[0]
                    raise entry.sheet.fault(row, entry.first, str(error)) from error
