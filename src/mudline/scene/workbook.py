"""Workbooks of spreadsheets (XLSX): opened for reading, every fault with its cell; curves from their sheets.

Needs the extra `excel`. Curves become a deck with one `*SEABED STIFFNESS` block.
"""

from __future__ import annotations

import io
import re
import zipfile
import zlib
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import PurePath
from typing import Any, BinaryIO, NamedTuple
from xml.etree.ElementTree import ParseError

import numpy as np
from pydantic import ValidationError

from mudline.curves import CurveError, ForceCurve
from mudline.deck.model import Deck, Section
from mudline.diagnostics import DeckError
from mudline.keywords.library.seabed_stiffness import SeabedStiffness, StiffnessCurve
from mudline.keywords.table import Table
from mudline.quantities import UNIT_SYSTEMS, unit_names
from mudline.scene.csv_file import data_error
from mudline.short_repr import cut, listed

_UNREADABLE = (
    # damaged bytes meet the checks of zipfile, of the parser of XML, and the assumptions of openpyxl
    ArithmeticError,
    AttributeError,
    EOFError,
    LookupError,
    MemoryError,
    NotImplementedError,
    OSError,
    ParseError,
    RuntimeError,
    TypeError,
    ValueError,
    zipfile.BadZipFile,
    zlib.error,
)


@contextmanager
def opened_workbook(stream: BinaryIO, file: str, *, formulas: bool = False) -> Iterator[Any]:
    """The workbook in a stream: the values that formulas had, or with `formulas` their texts.

    Raises DeckError for what is not a workbook, also in the block, where its sheets are read; ImportError without
    openpyxl.
    """
    from openpyxl import load_workbook  # noqa: PLC0415 - only who reads a workbook needs it
    from openpyxl.utils.exceptions import InvalidFileException  # noqa: PLC0415 - as above

    try:
        book = load_workbook(stream, read_only=True, data_only=not formulas)
        yield book
    except DeckError:
        raise
    except (*_UNREADABLE, InvalidFileException) as error:
        raise data_error(file, f"not a workbook that can be read: {cut(str(error), 100)}") from error


def cell_fault(file: str, sheet: str, place: tuple[int, int], message: str) -> DeckError:
    """The error about the cell in a row and a column, from 1."""
    from openpyxl.utils import get_column_letter  # noqa: PLC0415 - as above

    row, column = place
    where = f"sheet {cut(sheet, 40)}, cell {get_column_letter(column)}{row}"
    return data_error(file, f"{where}: {message}", row, column)


# ----------------------------------------------------------------------------------------------- force-embedment curves

RATIO, FORCE, CURVE = "ratio", "force", "curve"
_HEADING = re.compile(r"\s*(?P<name>.*?)\s*(?:[\[(]\s*(?P<unit>.*?)\s*[\])])?\s*", re.DOTALL)


class Cell(NamedTuple):
    """A cell: row and column from 1, its value, and whether a formula in it was never calculated."""

    row: int
    column: int
    value: object
    uncalculated: bool


@dataclass
class SheetCurve:
    """Points of a curve, and the cells of their ratios."""

    name: str
    sheet: str
    first: tuple[int, int]
    points: list[tuple[float, float]] = field(default_factory=list)
    cells: list[tuple[int, int]] = field(default_factory=list)


class CurveSheets(NamedTuple):
    """The deck of a workbook, and the sheets that have no curves."""

    deck: Deck
    left_out: Sequence[str]


def read_curve_sheets(data: bytes, file: str, units: str | None = None) -> CurveSheets:
    """The curves of a workbook: columns headed `ratio` and `force`, maybe with a unit in brackets, in the first row.

    A sheet is a curve of its name; with a column `curve` each row is a point of the curve named there. Rows without any
    value are skipped, and so are sheets with none of these headings. The units are those given, else those of a force
    in brackets, else metric.

    Raises:
        DeckError: it is not a workbook, or something in it cannot be a curve; the message names sheet and cell.
        ImportError: openpyxl is not installed.
    """
    curves: dict[str, SheetCurve] = {}
    left_out: list[str] = []
    systems: dict[str, str] = {}
    with (
        opened_workbook(io.BytesIO(data), file) as book,
        opened_workbook(io.BytesIO(data), file, formulas=True) as written,
    ):
        for sheet, texts in zip(book.worksheets, written.worksheets, strict=True):
            rows = _rows(sheet, texts)
            columns, system = _columns(file, sheet.title, next(rows, []))
            if not columns:
                left_out.append(sheet.title)
                continue
            systems |= {system: sheet.title} if system else {}
            for name, curve in _Reader(file, sheet.title, columns).curves(rows).items():
                if name in curves:
                    what = f"the curve {cut(curve.name, 40)!r} is also on the sheet {curves[name].sheet}: rename one"
                    raise cell_fault(file, sheet.title, curve.first, what)
                curves[name] = curve
    if not curves:
        raise data_error(file, "no curve: expected a sheet with the headings ratio and force in its first row")
    if len(systems) > 1:
        what = " and ".join(f"{system} on {listed([sheet])}" for system, sheet in systems.items())
        raise data_error(file, f"the forces have different units: {what}; a deck has one unit system")
    block = SeabedStiffness(curves=[_checked(file, curve) for curve in curves.values()])
    source = PurePath(file).name
    found = units or next(iter(systems), "metric")
    return CurveSheets(Deck(file, source, found, sections=[Section("MODEL", [block])]), left_out)


def _rows(sheet: Any, texts: Any) -> Iterator[list[Cell]]:  # noqa: ANN401 - openpyxl has no types
    """The rows of a sheet whose cells have a value, or a formula without one."""
    for one in (sheet, texts):
        one.reset_dimensions()
    for number, (values, formulas) in enumerate(zip(sheet.iter_rows(), texts.iter_rows(), strict=True), 1):
        cells = []
        for column, (value, formula) in enumerate(zip(values, formulas, strict=True), 1):
            uncalculated = value.value is None and formula.value is not None
            if uncalculated or (value.value is not None and str(value.value).strip()):
                cells.append(Cell(number, column, value.value, uncalculated))
        yield cells


def _columns(file: str, sheet: str, head: Sequence[Cell]) -> tuple[dict[str, int], str]:
    """The columns by their headings, and the unit system that the force's unit tells; no columns without headings."""
    found: dict[str, int] = {}
    system = ""
    for cell in head:
        match = _HEADING.fullmatch(str(cell.value))
        name, unit = (match["name"].lower(), match["unit"]) if match else ("", None)
        if name not in {RATIO, FORCE, CURVE}:
            continue
        if name in found:
            what = f"a second column {name}: give each curve a sheet of its own, or name it in a column curve"
            raise cell_fault(file, sheet, (1, cell.column), what)
        found[name] = cell.column
        if name == FORCE and unit:
            system = _system(file, sheet, cell, unit)
    numbers = [name for name in (RATIO, FORCE) if name in found]
    if len(numbers) == 1:
        other = FORCE if numbers == [RATIO] else RATIO
        what = f"a column {numbers[0]} and none headed {other}: expected both in the first row"
        raise cell_fault(file, sheet, (1, found[numbers[0]]), what)
    return (found if numbers else {}), system


def _system(file: str, sheet: str, cell: Cell, unit: str) -> str:
    """The unit system of a force per length."""
    known = {unit_names(system).line_force: system for system in UNIT_SYSTEMS if unit_names(system).line_force}
    if unit not in known:
        what = f"expected the unit {' or '.join(known)}, found {cut(unit, 40)!r}"
        raise cell_fault(file, sheet, (1, cell.column), what)
    return known[unit]


class _Reader:
    """Reads the curves of a sheet."""

    def __init__(self, file: str, sheet: str, columns: dict[str, int]) -> None:
        self._file, self._sheet, self._columns = file, sheet, columns

    def curves(self, rows: Iterator[list[Cell]]) -> dict[str, SheetCurve]:
        """The curves by their names without case, in the order of their first points."""
        found: dict[str, SheetCurve] = {}
        if CURVE not in self._columns:
            found[self._sheet.lower()] = SheetCurve(self._sheet, self._sheet, (1, self._columns[RATIO]))
        for number, row in enumerate(rows, 2):
            cells = {cell.column: cell for cell in row if cell.column in self._columns.values()}
            if not cells:
                continue
            name = self._name(number, cells) if CURVE in self._columns else self._sheet
            place = (number, self._columns[CURVE if CURVE in self._columns else RATIO])
            curve = found.setdefault(name.lower(), SheetCurve(name, self._sheet, place))
            curve.points.append((self._number(RATIO, number, cells), self._number(FORCE, number, cells)))
            curve.cells.append((number, self._columns[RATIO]))
        return found

    def _name(self, row: int, cells: dict[int, Cell]) -> str:
        value = self._value(CURVE, "the name of a curve", row, cells)
        return str(value).strip()

    def _number(self, name: str, row: int, cells: dict[int, Cell]) -> float:
        value = self._value(name, "a number", row, cells)
        if isinstance(value, int | float) and not isinstance(value, bool):
            return float(value)
        text = cut(repr(value), 40) if isinstance(value, str | bool) else cut(str(value), 40)
        advice = "; it is a text, format the cell as a number" if isinstance(value, str) and _is_number(value) else ""
        raise self._fault(name, row, f"expected a number, found {text}{advice}")

    def _value(self, name: str, expected: str, row: int, cells: dict[int, Cell]) -> object:
        """The value of a cell that must have one."""
        cell = cells.get(self._columns[name])
        if cell is None:
            raise self._fault(name, row, f"expected {expected}, found nothing")
        if cell.uncalculated:
            what = "a formula that was never calculated: open the workbook in a spreadsheet program and save it"
            raise self._fault(name, row, f"expected {expected}, found {what}")
        return cell.value

    def _fault(self, name: str, row: int, message: str) -> DeckError:
        return cell_fault(self._file, self._sheet, (row, self._columns[name]), message)


def _is_number(text: str) -> bool:
    try:
        float(text.replace(",", "."))
    except ValueError:
        return False
    return True


def _checked(file: str, curve: SheetCurve) -> StiffnessCurve:
    """A curve of the deck; raises DeckError where its points make none, or a deck cannot hold its name."""
    values = np.array(curve.points, np.float64).reshape(-1, 2)
    try:
        ForceCurve(values)
    except CurveError as error:
        place = curve.cells[error.index] if 0 <= error.index < len(curve.cells) else curve.first
        raise cell_fault(file, curve.sheet, place, str(error)) from error
    try:
        return StiffnessCurve(name=curve.name, points=Table(values))
    except ValidationError as error:
        what = f"{cut(curve.name, 40)!r} cannot be the name of a curve: {error.errors()[0]['msg']}"
        raise cell_fault(file, curve.sheet, curve.first, what) from error
