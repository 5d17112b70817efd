"""Remarks behind the data of a line, as other programs allow them: here they are data, reported once a line."""

from __future__ import annotations

import re
from dataclasses import replace

from mudline.codes.fields import SYN002, SYN003, SYN015, SYN016
from mudline.codes.words import SYN005
from mudline.diagnostics import Problem, Severity, Span
from mudline.keywords.text import shown

_MARK = re.compile(r"(?<=[ \t])(?:!|(?:[#;]|//|--)[ \t])")
_LETTER = re.compile(r"[^\W\d_]")
_OF_FIELDS = frozenset({SYN002, SYN003, SYN005, SYN015, SYN016})
_NO_LINE = Span(0, 0)
_ADVICE = "no comment stands at the end of a line, put it on a line of its own, behind C and a blank"


def remark_of(line: str) -> str:
    """The remark behind the data of a line or a field, or nothing."""
    mark = _MARK.search(line)
    if mark is None or not line[: mark.start()].strip(" \t") or not _LETTER.search(line, mark.end()):
        return ""
    before = line[: mark.start()]
    inside = before.count('"') % 2 or before.count("[") != before.count("]") or before.count("{") != before.count("}")
    return "" if inside else line[mark.start() :].rstrip(" \t\r\n")


def advice_on(name: str) -> str:
    """What to do about a name that holds a remark, or nothing."""
    return _ADVICE if remark_of(name) else ""


def one_a_line(text: str, problems: list[Problem]) -> list[Problem]:
    """The problems of a text, with one in the place of all those that the fields of a line have by a remark."""
    if not any(problem.code in _OF_FIELDS for problem in problems):
        return problems
    remarks = _remarks(text, problems)
    blamed: dict[Span, Problem] = {}
    ranks: dict[Span, tuple[bool, bool]] = {}
    for problem, remark in zip(problems, remarks, strict=True):
        if remark is None or problem.span is None or problem.span.end <= remark.start:
            continue
        rank = problem.weight is Severity.ERROR, problem.span.start <= remark.start
        if rank >= ranks.get(remark, rank):
            blamed[remark], ranks[remark] = problem, rank
    kept: list[Problem] = []
    told: set[Span] = set()
    for problem, remark in zip(problems, remarks, strict=True):
        if remark is None or remark not in blamed:
            kept.append(problem)
        elif remark not in told:
            told.add(remark)
            message = f"{shown(text[slice(*remark)])} is read as data: {_ADVICE}"
            kept.append(replace(blamed[remark], message=message, span=remark, repair=None))
    return kept


def _remarks(text: str, problems: list[Problem]) -> list[Span | None]:
    """The remark on the line of each problem with a field."""
    found: list[Span | None] = []
    line, remark = _NO_LINE, None
    for problem in problems:
        if problem.span is None or problem.code not in _OF_FIELDS:
            found.append(None)
            continue
        if not line.start <= problem.span.start < line.end:
            end = text.find("\n", problem.span.start)
            line = Span(text.rfind("\n", 0, problem.span.start) + 1, (len(text) if end < 0 else end) + 1)
            words = remark_of(text[slice(*line)])
            start = text.find(words, line.start)
            remark = Span(start, start + len(words)) if words else None
        found.append(remark)
    return found
