"""Files that were cut off: a fault in the very last token is no slip of the pen."""

from __future__ import annotations

from dataclasses import replace

from mudline.codes import SYN002, SYN003, SYN006, SYN014
from mudline.diagnostics import Problem
from mudline.keywords.text import shown
from mudline.syntax.rows import read_number

_OPEN_ENDS = "+-.eEdD"


def told_as_cut(problems: list[Problem], text: str) -> list[Problem]:
    """The problems, with those of a last token that has no end told as a cut-off file."""
    end = len(text.rstrip(" \t"))
    if not end or text[end - 1] == "\n":
        return problems
    last_line = text.rfind("\n") + 1
    return [_told(problem, text, last_line, end) for problem in problems]


def _told(problem: Problem, text: str, last_line: int, end: int) -> Problem:
    span = problem.span
    if span is None or span.start < last_line:
        return problem
    piece = text[span.start : end]
    unclosed = problem.code is SYN006
    breaks_off = span.end == end and _breaks_off(problem, piece, text[end - 1])
    if not unclosed and not breaks_off:
        return problem
    return replace(problem, code=SYN014, message=f"the file ends inside {shown(piece)}: it seems to be cut off")


def _breaks_off(problem: Problem, piece: str, last: str) -> bool:
    """Whether a token is the beginning of a longer one."""
    if problem.code is SYN003:
        return last in ",="
    number = piece.rstrip(_OPEN_ENDS)
    return problem.code is SYN002 and (
        piece == "=" or (last in _OPEN_ENDS and (not number or read_number(number) is not None))
    )
