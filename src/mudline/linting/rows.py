"""Findings that repeat themselves: about a row that was misread, row after row, and about one missing name."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace

from mudline.codes.fields import SYN002, SYN003, SYN015
from mudline.codes.lines import SYN001, SYN004, SYN014
from mudline.codes.references import REF007
from mudline.deck.reading import TextOrigin
from mudline.diagnostics import MORE, Blocks, Problem, Severity
from mudline.short_repr import counted

FEWEST = 3
"""Rows below each other, or fields of a row, that have one fault; two may each have a fault of their own."""

_OF_ROWS = frozenset({SYN001, SYN002, SYN003, SYN004, SYN014, SYN015, REF007})
"""Codes of faults of a row, which one slip gives to many rows."""
_MISREAD = frozenset({SYN001, SYN002, SYN003})
"""Codes of rows whose values may not be what was meant."""
_OF_VALUES = ("UNT", "GEO")
"""How the codes of rules begin that judge the values of a row."""

_DIGITS = re.compile(r"-?[0-9]+")
_STRENGTH = (Blocks.NEVER, Blocks.WITH_TENSION, Blocks.ALWAYS)

_Rows = dict[tuple[str, int], list[Problem]]
"""Findings by code and line."""


def by_row(text: TextOrigin, problems: list[Problem]) -> list[Problem]:
    """Return the findings with those under another one that say no more (`Problem.following`).

    These are what is said of the values of a row that was misread; further fields of a row with the same fault; rows,
    each directly below the one before, of which the same is said but for the digits; and further lines that use a name
    or a number which is not defined.
    """
    rows: _Rows = {}
    for problem in problems:
        if problem.code in _OF_ROWS and problem.message != MORE:
            rows.setdefault((problem.code.code, text.place(problem).line), []).append(problem)
    groups = [*_judged(text, problems, rows), *_repeated(rows), *_lacking(text, problems)]
    under: dict[int, Problem] = {}
    hidden: set[int] = set()
    for cause, others, words in groups:
        if id(cause) not in hidden:
            under[id(cause)] = joined(under.get(id(cause), cause), [under.get(id(one), one) for one in others], words)
            hidden.update(map(id, others))
    return [under.get(id(one), one) for one in problems if id(one) not in hidden]


def _judged(text: TextOrigin, problems: list[Problem], rows: _Rows) -> Iterator[tuple[Problem, list[Problem], str]]:
    """What is said of the values of rows that were misread, by the first error of each row."""
    misread: dict[int, Problem] = {}
    for (_, line), found in rows.items():
        if found[0].code in _MISREAD and found[0].weight is Severity.ERROR:
            misread.setdefault(line, found[0])
    about: dict[int, list[Problem]] = {}
    for problem in problems if misread else ():
        if problem.code.code.startswith(_OF_VALUES) and (line := text.place(problem).line) in misread:
            about.setdefault(line, []).append(problem)
    for line, found in about.items():
        yield misread[line], found, left_out(len(found))


def _repeated(rows: _Rows) -> Iterator[tuple[Problem, list[Problem], str]]:
    """Further fields of the same row, and the rows below."""
    seen: set[tuple[str, int]] = set()
    for (code, line), found in sorted(rows.items()):
        if (code, line) in seen:
            continue
        run = [found]
        while (more := rows.get((code, line + len(run)))) and _said(more[0]) == _said(found[0]):
            run.append(more)
        below = run[1:] if len(run) >= FEWEST else []
        seen.update((code, line + number) for number in range(1, len(below) + 1))
        same = found[1:] if len(found) >= FEWEST or found[0].code is SYN014 else []
        fields = f"{counted(len(same), 'more field')} of this row" if same else ""
        lines = f"{len(below)} more rows of this block, the last in line {line + len(below)}" if below else ""
        if others := [*same, *(one for row in below for one in row)]:
            yield found[0], others, f"and {' and '.join(filter(None, (fields, lines)))}"


def _lacking(text: TextOrigin, problems: list[Problem]) -> Iterator[tuple[Problem, list[Problem], str]]:
    """Further lines that use a name or a number of a kind which is not defined."""
    lacking: dict[tuple[str, str], list[Problem]] = {}
    for problem in problems:
        if problem.lacks and problem.message != MORE:
            lacking.setdefault((problem.code.code, problem.lacks.casefold()), []).append(problem)
    for found in lacking.values():
        if len(found) > 1:
            first, *others = sorted(found, key=lambda one: text.place(one).line)
            yield first, others, also_in(text, others)


def also_in(text: TextOrigin, others: Sequence[Problem]) -> str:
    """Where else the same is found, in words."""
    *lines, last = sorted({text.place(one).line for one in others})
    if not lines:
        return f"the same in line {last}"
    return f"the same in {len(lines) + 1} more lines, the last of them line {last}"


def _said(problem: Problem) -> str:
    return _DIGITS.sub("0", problem.message)


def left_out(count: int) -> str:
    """How many findings follow from one, in words."""
    return f"{counted(count, 'finding')} that {'follows' if count == 1 else 'follow'} from it {_are(count)} left out"


def _are(count: int) -> str:
    return "is" if count == 1 else "are"


def joined(cause: Problem, others: Sequence[Problem], words: str) -> Problem:
    """A finding with others under it: as severe as the worst of them, and an error if one keeps from evaluation."""
    everything = (cause, *others)
    blocks = max((one.blocking for one in everything), key=_STRENGTH.index)
    severity = max((one.weight for one in everything), key=lambda severity: severity.rank)
    below = tuple(each for one in others for each in (replace(one, following=()), *one.following))
    return replace(
        cause,
        message=f"{cause.message}; {words}",
        severity=Severity.ERROR if blocks is Blocks.ALWAYS else severity,
        blocks=blocks,
        following=(*cause.following, *below),
    )
