"""Findings as JUnit XML: a test suite for each file, a failed test case for each finding.

A file without findings has one passed test case. The text of a failure is written twice, as attribute and as element
content, since readers show one of the two.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from xml.sax.saxutils import escape, quoteattr

from mudline.checks.output import visible
from mudline.language.diagnostics import Diagnostic

SUMMARY = (
    "JUnit XML: a test suite for each file, a failed test case for each finding "
    "or one passed case for a file without findings"
)


def write(diagnostics: Iterable[Diagnostic], files: Sequence[str]) -> Iterator[str]:
    """Yield the pieces of the document; all linted files are in it, in their order."""
    by_file: dict[str, list[Diagnostic]] = {name: [] for name in files}
    for findings in diagnostics:
        by_file.setdefault(findings.file, []).append(findings)
    cases = sum(len(findings) or 1 for findings in by_file.values())
    failures = sum(len(findings) for findings in by_file.values())
    yield '<?xml version="1.0" encoding="UTF-8"?>\n'
    yield f'<testsuites name="mudline" tests="{cases}" failures="{failures}" errors="0">\n'
    for name, listed in by_file.items():
        yield from _suite(name, listed)
    yield "</testsuites>\n"


def _suite(name: str, listed: list[Diagnostic]) -> Iterator[str]:
    counts = f'tests="{len(listed) or 1}" failures="{len(listed)}" errors="0" skipped="0"'
    yield f"  <testsuite name={_value(name)} {counts}>\n"
    if not listed:
        yield f'    <testcase name="mudline" classname={_value(name)} time="0"/>\n'
    for finding in listed:
        case = f"{finding.code} {finding.slug} {finding.line}:{finding.column}"
        place = f"{finding.file}:{finding.line}:{finding.column}"
        yield f'    <testcase name={_value(case)} classname={_value(name)} time="0">\n'
        text = visible(f"{place}: {finding.message}")
        yield f'      <failure type="{finding.severity.value}" message={quoteattr(text)}>{escape(text)}</failure>\n'
        yield "    </testcase>\n"
    yield "  </testsuite>\n"


def _value(text: str) -> str:
    """Return an attribute in quotes, with characters that XML forbids replaced."""
    return quoteattr(visible(text))
