"""Findings as a code quality report of GitLab."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

from mudline.checks.output import Fingerprints, LintRun, visible
from mudline.checks.output.json import array
from mudline.language.diagnostics import Diagnostic, Severity

SUMMARY = "a code quality report; fingerprints do not depend on line numbers"

_SEVERITIES = {Severity.ERROR: "major", Severity.WARNING: "minor", Severity.INFO: "info"}


def write(diagnostics: Iterable[Diagnostic], run: LintRun) -> Iterator[str]:  # noqa: ARG001 - the same for every form
    """Return one array, an object a line; `[]` without findings."""
    fingerprints = Fingerprints()
    placed = (replace(found, file=_path(found.file)) for found in diagnostics)
    return array(_issue(found, fingerprints.of(found)) for found in placed)


def _issue(found: Diagnostic, fingerprint: str) -> dict[str, Any]:
    return {
        "description": f"{found.code} {visible(found.message)}",
        "check_name": found.slug,
        "fingerprint": fingerprint,
        "severity": _SEVERITIES[found.severity],
        "location": {"path": found.file, "lines": {"begin": found.line, "end": found.end_line}},
    }


def _path(file: str) -> str:
    """Return a path from the top of the repository, as GitLab needs it; its jobs run there."""
    path, top = Path(file), Path.cwd()
    return path.relative_to(top).as_posix() if path.is_relative_to(top) else file.removeprefix("./")
