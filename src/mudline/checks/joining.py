"""One finding for one cause: repeated findings are joined, and so are those that a joint declares.

Nothing is read or checked for this.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import chain

from mudline.basics.short_repr import counted
from mudline.checks.context import JOINTS, Joined, LintContext
from mudline.checks.recovery.blocks import ROW_NUMBER, also_in
from mudline.language.codes.fields import SYN002, SYN003, SYN015
from mudline.language.codes.lines import SYN001, SYN004, SYN014
from mudline.language.codes.references import REF007
from mudline.language.deck.model import Origin
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import MORE, Blocks, Problem, Repair, Severity, strongest

FEWEST = 3
"""Number of consecutive rows, or fields of a row, with the same fault that are joined; two may be separate faults."""

MOST_NAMED = 4
"""Number of rows below the first one whose numbers are named."""

_OF_ROWS = frozenset(code.code for code in (SYN001, SYN002, SYN003, SYN004, SYN014, SYN015, REF007))
"""Codes of faults of a row, which one slip gives to many rows."""
_DIGITS = re.compile(r"-?[0-9]+")


def joined_findings(context: LintContext, problems: list[Problem]) -> list[Problem]:
    """Return the findings, with those that only repeat another one joined to it (`Problem.following`)."""
    text, origin = context.text, context.deck.origin
    if type(origin) is Origin:  # a program made the deck, which has no lines
        return problems
    by_code: dict[str, list[Problem]] = {}
    for problem in problems:
        if problem.message != MORE:
            by_code.setdefault(problem.code.code, []).append(problem)
    declared = (join(context, by_code) for codes, join in JOINTS if not codes.isdisjoint(by_code))
    repeated = _repeated(text, by_code) if text else ()
    under: dict[int, Problem] = {}
    hidden: set[int] = set()
    for joined in chain(*declared, repeated, _alike(origin, by_code)):
        if id(joined.first) not in hidden and (joined.others or joined.message):
            cause = under.get(id(joined.first), joined.first)
            cause = replace(cause, message=joined.message or cause.message, span=joined.place or cause.span)
            others = [under.get(id(each), each) for each in joined.others]
            under[id(joined.first)] = _joined(cause, others, joined.words) if others else cause
            hidden.update(map(id, joined.others))
    return [under.get(id(joined), joined) for joined in problems if id(joined) not in hidden]


def _joined(cause: Problem, others: Sequence[Problem], words: str) -> Problem:
    """Return a finding with others joined to it: as severe as the worst, and an error if one prevents evaluation."""
    everything = (cause, *others)
    blocks = strongest(everything)
    severity = max((item.weight for item in everything), key=lambda severity: severity.rank)
    below = tuple(each for item in others for each in (replace(item, following=()), *item.following))
    return replace(
        cause,
        message=f"{cause.message}; {words or _left_out(len(others))}",
        severity=Severity.ERROR if blocks is Blocks.ALWAYS else severity,
        blocks=blocks,
        repair=cause.repair and _of_all(everything)
        if all(item.code is cause.code for item in others)
        else cause.repair,
        following=(*cause.following, *below),
    )


def _left_out(count: int) -> str:
    """Return in words how many findings were left out as consequences."""
    which = "finding that follows from it is" if count == 1 else "findings that follow from it are"
    return f"{count} {which} left out"


def _of_all(problems: Sequence[Problem]) -> Repair | None:
    """Return the repair of a finding with the edits of equal findings; None if one of them has no repair."""
    repairs = [problem.repair for problem in problems if problem.repair]
    if len(repairs) < len(problems):
        return None
    return replace(repairs[0], edits=tuple(sorted({edit for repair in repairs for edit in repair.edits})))


def _repeated(text: TextOrigin, by_code: dict[str, list[Problem]]) -> Iterator[Joined]:
    """Yield further fields of the same row, and consecutive rows with the same fault."""
    for code in _OF_ROWS & by_code.keys():
        rows: dict[int, list[Problem]] = {}
        for problem in by_code[code]:
            rows.setdefault(text.place(problem).line, []).append(problem)
        after = 0
        for line, row in sorted(rows.items()):
            if line < after:
                continue
            after = line + 1
            while after in rows and _said(rows[after][0]) == _said(row[0]):
                after += 1
            below = [rows[each] for each in range(line + 1, after)] if after - line >= FEWEST else []
            after = after if below else line + 1
            whole_row = len(row) == text.source.line(line).count(",") + 1
            same = row[1:] if len(row) >= FEWEST or whole_row or code == SYN014.code else []
            yield Joined(row[0], [*same, *chain(*below)], f"and {' and '.join(_counts(text, same, below))}")


def _said(problem: Problem) -> str:
    """Return the message of a row without its numbers."""
    return _DIGITS.sub("0", problem.message)


def _counts(text: TextOrigin, same: Sequence[Problem], below: Sequence[Sequence[Problem]]) -> Iterator[str]:
    """Yield in words the number of further fields of a row, and the rows below it, with the same fault."""
    if same:
        yield f"{counted(len(same), 'more field')} of this row"
    if below:
        lines = [text.place(row[0]).line for row in below]
        ids = [number[1] for line in lines if (number := ROW_NUMBER.match(text.source.line(line)))]
        named = f" ({', '.join(ids)})" if len(ids) == len(below) <= MOST_NAMED else ""
        yield f"{len(below)} more rows of this block{named}, the last in line {text.place_in_file(below[-1][0]).line}"


def _lacking(problem: Problem) -> str:
    """Return the name that a deck lacks; for numbers that one unread line may define, return that line."""
    doubt = problem.message.rpartition("; ")[2]
    one_cause = problem.lacks.isdecimal() and doubt.endswith("could not be used may define it")
    return doubt if one_cause else problem.lacks.casefold()


def _alike(origin: Origin, by_code: dict[str, list[Problem]]) -> Iterator[Joined]:
    """Yield further lines that use an undefined name, and further fields of a row with the same message.

    The fields of a row are joined only in a text: a line of JSON may be the whole deck.
    """
    has_rows = isinstance(origin, TextOrigin)
    for code, problems in by_code.items():
        alike: dict[tuple[str, int], list[Problem]] = {}
        for problem in problems if len(problems) > 1 else ():
            if problem.lacks:
                alike.setdefault((_lacking(problem), 0), []).append(problem)
            elif has_rows and code not in _OF_ROWS:
                alike.setdefault((problem.message, origin.place(problem).line), []).append(problem)
        for first, *others in (sorted(same, key=lambda one: origin.place(one).line) for same in alike.values()):
            fields = f"and {counted(len(others), 'more field')} of it"
            yield Joined(first, others, also_in(origin, others) if others and first.lacks else fields)
