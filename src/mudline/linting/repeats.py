"""The same fault in row after row of a block: one finding at the first row, which says how many more there are."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import replace

from mudline.codes.fields import SYN002, SYN003, SYN015
from mudline.codes.lines import SYN001, SYN004, SYN014
from mudline.codes.references import REF007
from mudline.deck.reading import TextOrigin
from mudline.diagnostics import MORE, Blocks, Problem, Severity
from mudline.short_repr import counted

FEWEST_ROWS = 3
"""Rows in a run; two rows may each have a fault of their own."""

_BY_ROW = (SYN001, SYN002, SYN003, SYN004, SYN014, SYN015, REF007)
"""Codes of faults of a row, which one slip gives to many rows."""

_GIVEN = re.compile(r"'[^']*'|[-+.,]*[0-9][-+.,0-9]*")
_STRENGTH = (Blocks.NEVER, Blocks.WITH_TENSION, Blocks.ALWAYS)


def without_repeats(text: TextOrigin, problems: list[Problem]) -> list[Problem]:
    """Return the findings with those that repeat one in the same row, or in the rows above, under it.

    Rows repeat a fault where they follow each other without another row between them, and the findings say the same
    but for what is quoted from the deck.
    """
    at: dict[tuple[str, int], list[Problem]] = {}
    for problem in problems:
        if problem.code in _BY_ROW and problem.message != MORE:
            at.setdefault((problem.code.code, text.place(problem).line), []).append(problem)
    if len(at) < FEWEST_ROWS and all(len(found) == 1 for found in at.values()):
        return problems
    under: dict[int, Problem] = {}
    hidden: set[int] = set()
    for (code, line), found in sorted(at.items()):
        if id(found[0]) in hidden:
            continue
        run = [found]
        while (more := at.get((code, line + len(run)))) and _said(more[0]) == _said(found[0]):
            run.append(more)
        repeated = [one for row in run[1:] for one in row] if len(run) >= FEWEST_ROWS else []
        others = [*found[1:], *repeated]
        if others:
            rows = f"{len(run) - 1} more rows of this block, the last in line {line + len(run) - 1}" if repeated else ""
            fields = f"{counted(len(found) - 1, 'more field')} of this row" if len(found) > 1 else ""
            under[id(found[0])] = joined(found[0], others, f"and {' and '.join(filter(None, (fields, rows)))}")
            hidden.update(map(id, others))
    return [under.get(id(one), one) for one in problems if id(one) not in hidden]


def _said(problem: Problem) -> str:
    """What a finding says without what it quotes from the deck."""
    return _GIVEN.sub("", problem.message)


def joined(cause: Problem, others: Sequence[Problem], words: str) -> Problem:
    """A finding with others under it: as severe as the worst of them, and an error if one keeps from evaluation."""
    everything = (cause, *others)
    blocks = max((one.blocking for one in everything), key=_STRENGTH.index)
    severity = max((one.weight for one in everything), key=lambda severity: severity.rank)
    return replace(
        cause,
        message=f"{cause.message}; {words}",
        severity=Severity.ERROR if blocks is Blocks.ALWAYS else severity,
        blocks=blocks,
        following=(*cause.following, *_flat(others)),
    )


def _flat(problems: Iterable[Problem]) -> Iterable[Problem]:
    """Findings, and what is under each of them behind it."""
    for problem in problems:
        yield replace(problem, following=())
        yield from problem.following
