"""Lines of a keyword as a user writes them; units and ranges of its fields, from its declaration."""

from __future__ import annotations

from collections.abc import Iterable

from mudline.basics.units import UNITS
from mudline.language.keywords.fields import FieldInfo, Setting
from mudline.language.keywords.model import Block, FieldSpec, Part, RecordSchema, Rows, record_schema
from mudline.language.keywords.table import row_format
from mudline.language.keywords.values import Kind

TAKES = {
    Kind.REAL: "number",
    Kind.WHOLE: "whole number",
    Kind.IDENT: "number or {label}",
    Kind.WHOLE_OR_LABEL: "whole number or {label}",
    Kind.REAL_OR_NAME: "number or name",
    Kind.NAME: "name",
    Kind.TITLE: "text",
    Kind.OTHER: "...",
}


def format_lines(block: type[Block]) -> list[str]:
    """Return the keyword and the lines below it, indented by depth."""
    keyword = block.model_fields["keyword"].default
    return [f"*{keyword}", *_lines(block, 1)]


def _lines(part: type[Part], depth: int) -> list[str]:
    """Return the lines of a part in the order in which they are written."""
    lines: list[str] = []
    schema = record_schema(part)
    for slot in schema.slots:
        if isinstance(slot.about, Setting) and slot.about.inline:
            lines[-1] += f", {_setting(slot)}" if slot.required else f" [, {_setting(slot)}]"
        elif slot.record:
            for record in slot.record.values():
                first, *rest = _lines(record, depth)
                lines += [f"{first.removesuffix(' ...')} ...", *(f"  {line}" for line in rest)]
        elif text := _line(slot, schema):
            lines.append("  " * depth + text)
    return lines


def _line(slot: FieldSpec, schema: RecordSchema) -> str:
    """Return the line of one field; "" for a field on the line of another field."""
    if isinstance(slot.about, Rows):
        return _optional(slot, record_schema(slot.about.row).layout) + " ..."
    if slot.key:
        return _optional(slot, _setting(slot))
    if slot.row:
        alternatives = [column for column in schema.columns if column.row and not column.required]
        return record_schema(slot.row).layout + (" |" if slot in alternatives[:-1] else "")
    if slot.many:
        return f"{slot.label} [, ...]"
    plain = [column for column in schema.columns if not column.row]
    if len(plain) < len(schema.columns):
        return _optional(slot, slot.label)
    whole = row_format([column.label for column in plain], [column.required for column in plain])
    return whole if slot is plain[0] else ""


def _optional(slot: FieldSpec, text: str) -> str:
    return text if slot.required else f"[{text}]"


def _setting(slot: FieldSpec) -> str:
    kind = [TAKES[slot.kind]] if slot.kind else []
    taken = [*slot.choices, *kind] if slot.kind is Kind.OTHER else [*kind, *slot.choices]
    taken += [record_schema(slot.row).layout] if slot.row else []
    return f"{slot.key}={'|'.join(taken)}" + (" [, ...]" if slot.many else "")


def row_formats(schemas: Iterable[RecordSchema]) -> list[str]:
    """Return the formats of the rows of records."""
    shapes: list[str] = []
    for schema in schemas:
        lines = [slot.row for slot in schema.columns if slot.row]
        shapes += [record_schema(row).layout for row in (*lines, *(table.row for table in schema.tables)) if row]
        if schema.layout and not lines:
            shapes.append(schema.layout)
    return shapes


# --------------------------------------------------------------------------------------------------- units and ranges


def range_text(about: FieldInfo) -> str:
    """Return the range of a field's values, or ""."""
    if about.above is not None:
        return f"> {about.above:g}"
    if about.at_most is not None:
        return f"{about.at_least:g} to {about.at_most:g}"
    return f">= {about.at_least:g}" if about.at_least is not None else ""


_SYMBOLS = {"gj": "GJ", "eiyy": "EIyy", "do": "Do", "di": "Di", "db": "Db", "do_end": "Doe", "first": "N1"}


def _symbol(name: str) -> str:
    """Return the symbol of a field, or its name in words."""
    return _SYMBOLS.get(name, name.replace("_", " "))


def field_lines(part: type[Part], depth: int = 0) -> list[str]:
    """Return a line for each field of a part: name, meaning, unit, range, default; fields of inner parts below it."""
    lines: list[str] = []
    for slot in record_schema(part).slots:
        about = slot.about
        facts = [
            f"[{UNITS['user'].text(about.unit)}]" if about.unit else "",
            range_text(about),
            f"one of {', '.join(slot.choices)}" if slot.choices else "",
            f"default {about.default}" if about.default else "",
            "mandatory" if slot.required else "",
        ]
        lines.append("    " * depth + "; ".join(filter(None, [f"{slot.name}: {about.meaning}".rstrip(": "), *facts])))
        lines += [line for inner in slot.parts for line in field_lines(inner, depth + 1)]
    return lines


def usual_text(about: FieldInfo) -> str:
    """Return the usual values of a field, in metric units, with the reason for each range; "" if none are declared."""
    unit = UNITS["metric"].behind(about.unit).lstrip()
    texts: list[str] = []
    for usual in about.usuals:
        if not usual.explained:
            measure = f"times {_symbol(usual.of[1:])}" if usual.of.startswith("/") else usual.of or unit
            when, why = f"of {usual.when}" if usual.when else "", f"({usual.why})" if usual.why else ""
            texts.append(" ".join(filter(None, [usual.span(), measure, when, why])))
    return "; ".join(texts)
