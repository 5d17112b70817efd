"""Findings as one array of JSON objects."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator

from mudline.diagnostics import Diagnostic
from mudline.linting.output.finding_fields import as_object
from mudline.linting.output.forms import LintRun

SUMMARY = "an [array of objects](json.md#findings)"


def write(diagnostics: Iterable[Diagnostic], run: LintRun) -> Iterator[str]:  # noqa: ARG001 - the same for every form
    """One array, an object a line; `[]` when there is nothing."""
    mark = "["
    for found in diagnostics:
        yield f"{mark}\n {json.dumps(as_object(found), ensure_ascii=False)}"
        mark = ","
    yield "[]\n" if mark == "[" else "\n]\n"
