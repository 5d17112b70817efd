"""Findings of a file as a line of the cache, and back."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

from mudline.diagnostics import Diagnostic, Edit, Fix, Severity


def packed(found: Sequence[Diagnostic]) -> str:
    """The findings of one file in ASCII without a line end; "" for none. The file's name is left out."""
    if not found:
        return ""
    return json.dumps([_row(one) for one in found], separators=(",", ":"))


def unpacked(text: str, file: str) -> tuple[Diagnostic, ...]:
    """The findings that `packed` wrote, for a file of that name; raises ValueError for anything else."""
    if not text:
        return ()
    try:
        rows = json.loads(text)
    except RecursionError as error:
        raise ValueError("lists in lists without end") from error
    if not isinstance(rows, list):
        raise ValueError("no list of findings")  # noqa: TRY004 - one kind of error for whatever a file holds
    return tuple(_finding(row, file) for row in rows)


def _row(one: Diagnostic) -> list[object]:
    fix = one.fix and [
        one.fix.applicability,
        one.fix.message,
        [[*edit.start, *edit.end, edit.text] for edit in one.fix.edits],
    ]
    place = (one.line, one.column, one.end_line, one.end_column)
    return [one.code, one.slug, one.severity.value, one.message, *place, fix, one.blocks]


def _finding(row: object, file: str) -> Diagnostic:
    code, slug, severity, message, line, column, end_line, end_column, fix, blocks = _shaped(row, "ssssiiii*b")
    place = (line, column, end_line, end_column)
    repair = None if fix is None else _fix(fix)
    return Diagnostic(file, code, slug, Severity(severity), message, *place, repair, blocks)


def _fix(value: object) -> Fix:
    applicability, message, edits = _shaped(value, "ss*")
    if applicability not in ("safe", "unsafe") or not isinstance(edits, list):
        raise ValueError("no fix")
    rows = (_shaped(edit, "iiiis") for edit in edits)
    return Fix(applicability, message, tuple(Edit((a, b), (c, d), text) for a, b, c, d, text in rows))


def _shaped(value: object, kinds: str) -> list[Any]:
    """The list, if its items are texts (s), numbers from 1 (i), true or false (b), or anything (*) as wanted."""
    if not isinstance(value, list) or len(value) != len(kinds):
        raise ValueError("a row of another length")
    for item, kind in zip(value, kinds, strict=True):
        if (kind == "s" and not isinstance(item, str)) or (kind == "i" and not (type(item) is int and item > 0)):
            raise ValueError("an item of another kind")
        if kind == "b" and not isinstance(item, bool):
            raise ValueError("neither true nor false")
    return value
