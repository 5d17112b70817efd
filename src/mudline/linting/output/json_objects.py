"""Findings as JSON objects with the keys of the contract."""

from __future__ import annotations

from typing import Any

from mudline.diagnostics import Diagnostic, Fix
from mudline.linting.output.pages import page


def as_object(found: Diagnostic) -> dict[str, Any]:
    """A finding as a dict."""
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
