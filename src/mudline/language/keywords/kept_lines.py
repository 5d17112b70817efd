"""Which lines of an open block have a form that is not known."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import replace

from mudline.language.codes.fields import SYN002, SYN003, SYN015
from mudline.language.codes.lines import SYN001, SYN004, SYN005
from mudline.language.diagnostics import Problem, Severity
from mudline.language.keywords.grammar import ROW, Content
from mudline.language.keywords.text import reads_as_name

_OF_OTHER_FORMS = frozenset({SYN001, SYN002, SYN003, SYN004, SYN005})
"""Faults of a line that an unknown form may have."""
_KEPT = "; the line is passed through unchanged"


def of_other_form(
    text: str, problems: Sequence[Problem], contents: Sequence[Content], *, tabular: bool
) -> set[Content]:
    """The lines of an open block that have a form which is not known; what is certainly a fault is none.

    That is a number with a wrong letter, too few or too many numbers, an empty value, and anything in a table.
    """
    starts = [content.span.start for content in contents]
    found: set[Content] = set()
    certain: set[Content] = set()
    for problem in problems:
        at = bisect_right(starts, problem.span.start) - 1 if problem.span else -1
        if at < 0 or (tabular and contents[at].type == ROW):
            continue
        if problem.code is SYN015:
            certain.add(contents[at])
        elif problem.weight is Severity.ERROR and _may_be(problem, text, contents[at]):
            found.add(contents[at])
    return found - certain


def _may_be(problem: Problem, text: str, content: Content) -> bool:
    span = problem.span
    if problem.code not in _OF_OTHER_FORMS or span is None or span.start >= content.span.end:
        return False
    written = text[slice(*span)]
    if problem.code is SYN002:
        return written[:1].isalpha() and reads_as_name(written)
    if problem.code is SYN003 and content.type == ROW:
        return any(reads_as_name(field.strip()) for field in written.split(","))
    return problem.code is not SYN003 or bool(written.partition("=")[2].strip()) or "=" not in written


def doubtful(problems: Sequence[Problem]) -> list[Problem]:
    """The words that may be misspelt in lines which are kept, as warnings."""
    near = [problem for problem in problems if problem.code in (SYN004, SYN005) and problem.repair]
    return [
        problem
        if problem.weight is not Severity.ERROR
        else replace(problem, message=problem.message + _KEPT, severity=Severity.WARNING)
        for problem in near
    ]
