"""Findings as one array of JSON objects."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from typing import Any

from mudline.checks.output import LintRun
from mudline.checks.pages import page
from mudline.language.diagnostics import Diagnostic, Fix

SUMMARY = "an [array of objects](json.md#findings)"


def write(diagnostics: Iterable[Diagnostic], run: LintRun) -> Iterator[str]:  # noqa: ARG001 - the same for every form
    """Return one array, an object a line; `[]` without findings."""
    return array(map(as_object, diagnostics))


def array(objects: Iterable[dict[str, Any]]) -> Iterator[str]:
    """Yield the text of an array, in pieces."""
    mark = "["
    for found in objects:
        yield f"{mark}\n {json.dumps(found, ensure_ascii=False)}"
        mark = ","
    yield "[]\n" if mark == "[" else "\n]\n"


def as_object(found: Diagnostic) -> dict[str, Any]:
    """Return a finding as a dict."""
    return {
        "file": found.file,
        "code": found.code,
        "slug": found.slug,
        "severity": found.severity.value,
        "message": found.message,
        "line": found.line,
        "column": found.column,
        "end_line": found.end_line,
        "end_column": found.end_column,
        "fix": None if found.fix is None else _fix(found.fix),
        "url": page(found.code),
    }


def _fix(fix: Fix) -> dict[str, Any]:
    edits = [{"start": list(edit.start), "end": list(edit.end), "text": edit.text} for edit in fix.edits]
    return {"applicability": fix.applicability, "message": fix.message, "edits": edits}
