"""The fields of a keyword as tables, and what of them is inferred."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from mudline.basics.units import UNITS
from mudline.language.keywords.fields import FieldInfo
from mudline.language.keywords.format import TAKES, range_text, usual_text
from mudline.language.keywords.model import Block, FieldSpec, ListRow, Part, Row, Rows, record_schema
from tests.docs.marking import marked


def tables(block: type[Block]) -> Iterator[tuple[str, list[str]]]:
    """A table of the fields, then those of what is inside them, each with a caption."""
    yield from _tables([block], "")


def inferences(block: type[Block]) -> list[str]:
    """What is inferred of a keyword: each statement once, behind the fields that it holds for."""
    found: dict[str, list[str]] = {}
    for label, slot in _all_slots(block, ""):
        if slot.about.inferred and label not in found.setdefault(slot.about.inferred, []):
            found[slot.about.inferred].append(label)
    return [f"{', '.join(labels)}: {marked(text)}" for text, labels in found.items()]


def _all_slots(part: type[Part], holder: str) -> Iterator[tuple[str, FieldSpec]]:
    """Every field with its name; one of the values of a setting says of which."""
    for slot in record_schema(part).slots:
        yield f"`{slot.label}`{holder}", slot
        if row := _row_of(slot):
            yield from _all_slots(row, f" of `{slot.label}`" if slot.key else "")
        for record in slot.record.values():
            yield from _all_slots(record, "")


def _row_of(slot: FieldSpec) -> type[Row] | None:
    return slot.about.row if isinstance(slot.about, Rows) else slot.row


def _tables(parts: Sequence[type[Part]], path: str) -> Iterator[tuple[str, list[str]]]:
    slots = [slot for part in parts for slot in record_schema(part).slots]
    caption = f"In each of `{path}`{', one of' if len(parts) > 1 else ''}:" if path else ""
    if own := [slot for slot in slots if not slot.record]:
        yield caption, list(_fields(own))
    for slot in own:
        name = f"{slot.key}=" if slot.key else slot.json
        row = _row_of(slot)
        if row and isinstance(slot.about, Rows):
            yield f"A row of `{name}`, a list in JSON:", list(_fields(record_schema(row).slots, named=False))
        elif row and issubclass(row, ListRow):
            yield f"The values of `{name}`, a list in JSON:", list(_fields(record_schema(row).slots, named=False))
        elif row:
            yield f"The values of `{name}`:", list(_fields(record_schema(row).slots))
    for slot in slots:
        if slot.record:
            yield from _tables(list(slot.record.values()), slot.json)


def _fields(slots: Iterable[FieldSpec], *, named: bool = True) -> Iterator[str]:
    columns = ("field", *(("in JSON",) if named else ()), "takes", "unit", "default", "range", "usual", "meaning")
    yield f"| {' | '.join(columns)} |"
    yield "|" + " --- |" * len(columns)
    for slot in slots:
        names = (f"`{slot.label}`", f"`{slot.json}`") if named else (f"`{slot.label}`",)
        default = "mandatory" if slot.required else slot.about.default
        ranges = range_text(slot.about), usual_text(slot.about)
        cells = (*names, _takes(slot), _unit(slot.about), default, *ranges, _meaning(slot.about))
        yield f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in cells)} |"


def _takes(slot: FieldSpec) -> str:
    if isinstance(slot.about, Rows):
        return "rows, below"
    taken = [*([TAKES[slot.kind]] if slot.kind else []), *slot.choices, *(["values, below"] if slot.row else [])]
    return ("one or more of " if slot.many else "") + ", ".join(taken)


def _meaning(about: FieldInfo) -> str:
    return marked(about.meaning) + (" ([inferred](#certain-and-inferred))" if about.inferred else "")


def _unit(about: FieldInfo) -> str:
    """F/L2 as `N/m2 / lbf/ft2`; what is no dimension as it is; a unit of translations before that of rotations."""
    return " or ".join(map(_system_units, about.written_in or (about.unit,)))


def _system_units(unit: str) -> str:
    found = [system.text(unit) for system in UNITS.values() if system.known]
    return unit if found[0] == unit else " / ".join(found)
