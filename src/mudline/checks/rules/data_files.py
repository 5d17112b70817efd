"""Data files that a deck names, and the lines that a deck may have in their place."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, cast

from mudline.basics.outside import without_text
from mudline.checks.context import LintContext
from mudline.language.deck.model import Opaque
from mudline.language.deck.parameters import Parameters
from mudline.language.diagnostics import Code, Problem, Severity, Where
from mudline.language.keywords.model import FieldSpec, Part, record_schema
from mudline.language.keywords.text import shown
from mudline.language.keywords.values import DataFile
from mudline.language.rules import rule
from mudline.model.scene.data_files import fault_of, has_uneven_times, operators, unequal_frequencies
from mudline.model.scene.deck_values import file_name, find_file

if TYPE_CHECKING:
    from mudline.language.keywords.library.vessel_motions import Raos

DAT002 = Code("DAT002", "faulty-data", Severity.ERROR)

_OWN_FORMATS = (None, "", "MCS")
"""Values of FORMAT= whose file format is public."""


class _Named(NamedTuple):
    """Data file that a field names, with the part that the field belongs to."""

    where: Where
    part: Part
    slot: FieldSpec
    name: str


@rule(DAT002)
def faulty_data(context: LintContext) -> Iterator[Problem]:
    """A file that the deck names does not hold the data it should, or the lines in its place do not.

    The analysis program stops at such a file, or reads other values than were meant. Checked are operators of a vessel,
    histories of motions and of the sea, coefficients and matrices, as far as their format is public. The message names
    the first faulty line. In files of operators with one line for each frequency, every heading needs the same
    frequencies. Files in the format of another program are not read. Correct the line.

    Example:
         $MODEL
         *VESSEL
          VESSEL=FPSO
          INITIAL POSITION=100.0, 0.0, 0.0
         $LOAD CASE
         *RAO
          VESSEL=FPSO
          LAYOUT=LINE
          0.0, 0.10, 0.9, 10.0, 0.4, 90.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.1, -80.0
        - 90.0, 0.12, 0.8, 12.0, 0.0, 0.0, 0.5, 90.0, 0.0, 0.0, 1.4, 80.0, 0.0, 0.0
        + 90.0, 0.10, 0.8, 12.0, 0.0, 0.0, 0.5, 90.0, 0.0, 0.0, 1.4, 80.0, 0.0, 0.0

    Finds: 9:2
    """
    for where, block in context.blocks("RAO", "LOAD CASE"):
        for index, vessel in enumerate(cast("Raos", block).vessels):
            lines = vessel.lines
            columns = [lines.column(column).tolist() for column in (0, 1)] if lines is not None else []
            rows = zip(*columns, strict=True)  # a heading and a frequency, NaN where it is not known
            if fault := unequal_frequencies([row for row in rows if not any(map(math.isnan, row))]):
                message = f"{fault}: correct the lines"
                yield Problem(DAT002, message, where=where.inside("vessels", index, "lines"))
    for named, path in _there(context):
        if fault := _fault(named, path):
            shown_fault = without_text(fault, path, context.deck.folder)
            yield Problem(DAT002, f"{shown(path.name)} cannot be used: {shown_fault}", where=named.where)


class OperatorRows(NamedTuple):
    """File of the operators of a vessel: its place in the deck, its name, and its rows in the form of LAYOUT=LINE."""

    where: Where
    name: str
    rows: list[list[float]]


def operator_files(context: LintContext) -> list[OperatorRows]:
    """Return the files of operators that a deck names and that can be used."""
    files = []
    for named, path in _there(context):
        if named.slot.about.holds is DataFile.OPERATORS and _is_own(named):
            with suppress(OSError, ValueError):  # DAT002 says why
                files.append(OperatorRows(named.where, path.name, operators(path, _layout(named))))
    return files


def _there(context: LintContext) -> Iterator[tuple[_Named, Path]]:
    """Yield the existing files that a deck names, each with its path."""
    files = list(_files(context)) if context.deck.folder else []
    parameters = Parameters(context.deck) if files else None
    for named in files:
        path = find_file(context.deck.folder, file_name(parameters.filled(named.name) if parameters else named.name))
        if path is not None:
            yield named, path


def _is_own(named: _Named) -> bool:
    return getattr(named.part, "format", None) in _OWN_FORMATS


def _layout(named: _Named) -> str:
    return getattr(named.part, "layout", "") or ""


def _fault(named: _Named, path: Path) -> str:
    contents = cast("DataFile", named.slot.about.holds)
    if contents is DataFile.OPERATORS and not _is_own(named):
        return ""
    if fault := fault_of(path, contents, layout=_layout(named)):
        return fault
    if contents is DataFile.ELEVATIONS and getattr(named.part, "increment", None) is None and has_uneven_times(path):
        return "its times are uneven: give a time step in the deck"
    return ""


def _files(context: LintContext) -> Iterator[_Named]:
    """Yield the files of the deck itself whose contents are known."""
    for i, section in enumerate(context.deck.own_sections):
        for j, block in enumerate(section.blocks):
            if type(block) is not Opaque and _leads_to_files(type(cast("Part", block))):
                yield from _named_in(cast("Part", block), Where(i, j))


def _named_in(part: Part, where: Where) -> Iterator[_Named]:
    for slot in _leads_to_files(type(part)):
        value = getattr(part, slot.name, None)
        if slot.about.holds and isinstance(value, str) and value:
            yield _Named(where.inside(slot.json), part, slot, value)
        elif isinstance(value, list):
            for index, item in enumerate(value):
                if isinstance(item, Part):
                    yield from _named_in(item, where.inside(slot.json, index))


@cache
def _leads_to_files(part: type[Part]) -> tuple[FieldSpec, ...]:
    """Return the fields of a part that name data files, and the fields whose records do."""
    return tuple(
        slot
        for slot in record_schema(part).slots
        if slot.about.holds or any(map(_leads_to_files, slot.record.values()))
    )
