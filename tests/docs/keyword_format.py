"""The lines of a keyword as a user writes them, from its declaration."""

from __future__ import annotations

from mudline.keywords.model import Block, FieldSpec, Part, RecordSchema, Rows, Setting, record_schema, row_format
from mudline.keywords.values import Kind

TAKES = {
    Kind.REAL: "number",
    Kind.WHOLE: "whole number",
    Kind.IDENT: "number or {label}",
    Kind.REAL_OR_NAME: "number or name",
    Kind.NAME: "name",
}


def format_lines(block: type[Block]) -> list[str]:
    """The keyword and the lines below it, deeper ones indented."""
    keyword = block.model_fields["keyword"].default
    return [f"*{keyword}", *_lines(block, 1)]


def _lines(part: type[Part], depth: int) -> list[str]:
    """The lines of a part in the order in which they are written."""
    lines: list[str] = []
    found = record_schema(part)
    for slot in found.slots:
        if isinstance(slot.about, Setting) and slot.about.inline:
            lines[-1] += f", {_setting(slot)}" if slot.required else f" [, {_setting(slot)}]"
        elif slot.record:
            for record in slot.record.values():
                first, *rest = _lines(record, depth)
                lines += [f"{first.removesuffix(' ...')} ...", *(f"  {line}" for line in rest)]
        elif text := _line(slot, found):
            lines.append("  " * depth + text)
    return lines


def _line(slot: FieldSpec, found: RecordSchema) -> str:
    """The line of one field; "" for a field that another one's line holds."""
    if isinstance(slot.about, Rows) and slot.about.row:
        return _optional(slot, record_schema(slot.about.row).wanted) + " ..."
    if slot.key:
        return _optional(slot, _setting(slot))
    if slot.row:
        alternatives = [other for other in found.columns if other.row and not other.required]
        return record_schema(slot.row).wanted + (" |" if slot in alternatives[:-1] else "")
    if slot.many:
        return f"{slot.label} [, ...]"
    plain = [other for other in found.columns if not other.row]
    if len(plain) < len(found.columns):
        return _optional(slot, slot.label)
    whole = row_format([other.label for other in plain], [other.required for other in plain])
    return whole if slot is plain[0] else ""


def _optional(slot: FieldSpec, text: str) -> str:
    return text if slot.required else f"[{text}]"


def _setting(slot: FieldSpec) -> str:
    taken = [
        *([TAKES[slot.kind]] if slot.kind else []),
        *slot.choices,
        *([record_schema(slot.row).wanted] if slot.row else []),
    ]
    value = "|".join(taken)
    return f"{slot.key}={value}" + (" [, ...]" if slot.many else "")
