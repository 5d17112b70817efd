"""Findings as a code quality report of GitLab."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from typing import Any

from mudline.diagnostics import Diagnostic, Severity
from mudline.linting.output.fingerprints import Fingerprints
from mudline.linting.output.visible import visible

_SEVERITIES = {Severity.ERROR: "major", Severity.WARNING: "minor", Severity.INFO: "info"}


def gitlab(diagnostics: Iterable[Diagnostic]) -> Iterator[str]:
    """One array, an object a line; `[]` when there is nothing."""
    fingerprints = Fingerprints()
    mark = "["
    for found in diagnostics:
        yield f"{mark}\n {json.dumps(_issue(found, fingerprints.of(found)), ensure_ascii=False)}"
        mark = ","
    yield "[]\n" if mark == "[" else "\n]\n"


def _issue(found: Diagnostic, fingerprint: str) -> dict[str, Any]:
    return {
        "description": f"{found.code} {visible(found.message)}",
        "check_name": found.slug,
        "fingerprint": fingerprint,
        "severity": _SEVERITIES[found.severity],
        "location": {"path": found.file.removeprefix("./"), "lines": {"begin": found.line, "end": found.end_line}},
    }
