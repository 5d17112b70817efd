"""Findings as JSON objects, one a line."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Sequence

from mudline.checks.output.json import as_object
from mudline.language.diagnostics import Diagnostic

SUMMARY = "the same objects, one a line"


def write(diagnostics: Iterable[Diagnostic], files: Sequence[str]) -> Iterator[str]:  # noqa: ARG001 - the same for every form
    """Yield an object a line."""
    for finding in diagnostics:
        yield f"{json.dumps(as_object(finding), ensure_ascii=False)}\n"
