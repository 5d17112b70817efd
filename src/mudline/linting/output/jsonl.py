"""Findings as JSON objects, one a line."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator

from mudline.diagnostics import Diagnostic
from mudline.linting.output import LintRun
from mudline.linting.output.json import as_object

SUMMARY = "the same objects, one a line"


def write(diagnostics: Iterable[Diagnostic], run: LintRun) -> Iterator[str]:  # noqa: ARG001 - the same for every form
    """An object a line."""
    for found in diagnostics:
        yield f"{json.dumps(as_object(found), ensure_ascii=False)}\n"
