"""Findings as a code quality report of GitLab."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path

from mudline.checks.output import visible, with_fingerprints
from mudline.checks.output.json import array
from mudline.language.diagnostics import Diagnostic, Severity

SUMMARY = "a code quality report; fingerprints do not depend on line numbers"

_SEVERITIES = {Severity.ERROR: "major", Severity.WARNING: "minor", Severity.INFO: "info"}


def write(diagnostics: Iterable[Diagnostic], files: Sequence[str]) -> Iterator[str]:  # noqa: ARG001 - the same for every form
    """Return one array, an object a line; `[]` without findings."""
    placed = (replace(finding, file=_path(finding.file)) for finding in diagnostics)
    return array(
        {
            "description": f"{finding.code} {visible(finding.message)}",
            "check_name": finding.slug,
            "fingerprint": fingerprint,
            "severity": _SEVERITIES[finding.severity],
            "location": {"path": finding.file, "lines": {"begin": finding.line, "end": finding.end_line}},
        }
        for finding, fingerprint in with_fingerprints(placed)
    )


def _path(file: str) -> str:
    """Return a path from the top of the repository, as GitLab needs it; its jobs run there."""
    path, top = Path(file), Path.cwd()
    return path.relative_to(top).as_posix() if path.is_relative_to(top) else file.removeprefix("./")
