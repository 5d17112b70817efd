"""Findings as one array of JSON objects."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from mudline.checks.pages import page
from mudline.language.diagnostics import Diagnostic

SUMMARY = "an [array of objects](json.md#findings)"


def write(diagnostics: Iterable[Diagnostic], files: Sequence[str]) -> Iterator[str]:  # noqa: ARG001 - the same for every form
    """Return one array, an object a line; `[]` without findings."""
    return array(map(as_object, diagnostics))


def array(objects: Iterable[dict[str, Any]]) -> Iterator[str]:
    """Yield the text of an array, in pieces."""
    mark = "["
    for item in objects:
        yield f"{mark}\n {json.dumps(item, ensure_ascii=False)}"
        mark = ","
    yield "[]\n" if mark == "[" else "\n]\n"


def as_object(finding: Diagnostic) -> dict[str, Any]:
    """Return a finding as a dict."""
    fix = finding.fix
    return {
        "file": finding.file,
        "code": finding.code,
        "slug": finding.slug,
        "severity": finding.severity.value,
        "message": finding.message,
        "line": finding.line,
        "column": finding.column,
        "end_line": finding.end_line,
        "end_column": finding.end_column,
        "fix": fix and fix._asdict() | {"edits": [edit._asdict() for edit in fix.edits]},
        "url": page(finding.code),
    }
