"""Values and files that fields give: ranges that their declarations give, files that are not there."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import TYPE_CHECKING, Any

from mudline.codes.references import REF015
from mudline.deck.model import Deck
from mudline.deck.parameters import Parameters
from mudline.diagnostics import Blocks, Code, Problem, Severity, Where
from mudline.keywords.model import Block, ListRow, Part, Rows, Slot, layout, names_given
from mudline.keywords.table import Table
from mudline.keywords.text import shown
from mudline.keywords.values import Names
from mudline.scene.checks.declaring import check
from mudline.scene.deck_values import file_name, find_file

if TYPE_CHECKING:
    from mudline.scene.resolved import ResolvedDeck


SBD010 = Code("SBD010", "negative-property", Severity.ERROR)

_GEOMETRY = "geometry"
"""A setting of `*SEABED TRENCH`, the third step of a path to its values; EXT003 says what is wrong with them."""


@check(SBD010)
def negative_property(scene: ResolvedDeck) -> Iterator[Problem]:
    """A stiffness, a friction coefficient, a length or a diameter is negative, or zero where it divides.

    Such a value has no physical meaning: a sign was typed by mistake, or the value is in the wrong field. The same
    holds for a share above 1, as the floor of CYCLIC= in *SEABED SUCTION. Correct it. Values of equations and of tables
    are looked at too. The geometry of a trench and the stiffness of unloading have rules of their own, EXT003 and
    EXT009.

    Example:
         $MODEL
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=50000.0
        - FRICTION=-0.3, 0.6
        + FRICTION=0.3, 0.6

    Finds: 6:11
    """
    for i, section in enumerate(scene.deck.sections):
        if section.name != "MODEL":
            continue
        for j, block in enumerate(section.blocks):
            if isinstance(block, Block):
                for path, message in _faults(block):
                    if _GEOMETRY not in path[2:3] or block.keyword != "SEABED TRENCH":
                        yield Problem(SBD010, message, where=Where(i, j, path))


@cache
def _checked_slots(part: type[Part]) -> tuple[Slot, ...]:
    """The fields with a range, and those with parts that have one."""
    return tuple(slot for slot in layout(part).slots if _ranged(slot))


def _ranged(slot: Slot) -> bool:
    about = slot.about
    if any(limit is not None for limit in (about.at_least, about.above, about.at_most)):
        return True
    parts = [slot.row, *slot.record.values()]
    return any(_checked_slots(part) for part in parts if part and not issubclass(part, ListRow))


def _faults(part: Part) -> Iterator[tuple[tuple[str | int, ...], str]]:
    """Path and message of each value that is out of range."""
    for slot in _checked_slots(type(part)):
        value: Any = getattr(part, slot.name)
        if isinstance(value, float | int):
            if fault := _fault(value, slot):
                yield (slot.json,), fault
        elif isinstance(value, Part):
            yield from (((slot.json, *path), fault) for path, fault in _faults(value))
        elif isinstance(value, Table):
            yield from (((slot.json, *path), fault) for path, fault in _table_faults(value, slot))
        elif isinstance(value, list):
            for index, item in enumerate(value):
                if isinstance(item, Part):
                    yield from (((slot.json, index, *path), fault) for path, fault in _faults(item))


def _table_faults(table: Table, slot: Slot) -> Iterator[tuple[tuple[int, int], str]]:
    """Row, column and message of each value of a table that is out of range."""
    columns = layout(slot.row).columns if isinstance(slot.about, Rows) and slot.row else []
    for index, column in enumerate(columns):
        if not _ranged(column):
            continue
        for row, value in enumerate(table.column(index).tolist()):
            if fault := _fault(value, column):
                yield (row, index), fault


def _fault(value: float, slot: Slot) -> str:
    """What is wrong with a number, or nothing; NaN stands for one that could not be read."""
    low, above, most = slot.about.at_least, slot.about.above, slot.about.at_most
    if low is not None and value < low:
        return f"{_name(slot)} is {value!r}: it must not be less than {low:g}"
    if above is not None and value <= above:
        return f"{_name(slot)} is {value!r}: it must be greater than {above:g}"
    if most is not None and value > most:
        return f"{_name(slot)} is {value!r}: it must not be more than {most:g}"
    return ""


def _name(slot: Slot) -> str:
    """The field in words: `FRICTION=`, `water depth`, `external diameter Do`, `area of the section (A)`."""
    meaning = slot.about.meaning.partition(";")[0]
    if slot.key:
        return slot.label
    if slot.label.islower():  # words of the meaning; a symbol has capitals
        return meaning
    return f"{meaning} ({slot.label})" if " of " in meaning else f"{meaning} {slot.label}"


@check(REF015)
def missing_file(scene: ResolvedDeck) -> Iterator[Problem]:
    """Every FILE= of the deck itself that names no file, if it is known where files could be.

    Without the file of its profile the seabed is not known.
    """
    deck = scene.context.written
    if deck.folder is None:
        return
    files = list(_files(deck))
    parameters = Parameters(deck) if files else None
    for where, written in files:
        name = parameters.filled(written) if parameters else written
        name = file_name(name)
        if "%" not in name and find_file(deck.folder, name) is None:
            folder = deck.folder.as_posix()
            message = (
                f"the file {shown(name)} is not there (looked in {folder}): correct the name, or put the file there"
            )
            profile = bool(scene.seabed.missing) and where == scene.seabed.where.inside("file")
            yield Problem(REF015, message, where=where, blocks=Blocks.ALWAYS if profile else Blocks.NEVER)


def _files(deck: Deck) -> Iterator[tuple[Where, str]]:
    """Every field of a keyword with a model that names a file."""
    for i, section in enumerate(deck.own_sections):
        for j, block in enumerate(section.blocks):
            if isinstance(block, Block):
                yield from ((Where(i, j, path), name) for path, name in names_given(block, Names.FILE) if name)
