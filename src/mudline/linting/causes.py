"""One cause, one finding: what follows from a fault is put under the finding that names it.

Whether a finding follows is tried out, not guessed: the fault is corrected, the deck is checked again, and what is then
gone follows from it. Nothing of this runs for a deck in which no finding has a correction. Findings that repeat
themselves, row after row, are one.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

from mudline.codes.fields import SYN002, SYN003, SYN015
from mudline.codes.lines import SYN001, SYN004, SYN014
from mudline.codes.references import REF007
from mudline.deck.reading import TextOrigin
from mudline.diagnostics import MORE, Problem, Severity, Span
from mudline.diagnostics import Blocks as Blocking
from mudline.linting.corrections import Blocks, Correction, line_at, missing_sections, misspelt, value_corrections
from mudline.linting.line_corrections import line_corrections
from mudline.linting.rule import LintContext
from mudline.short_repr import counted
from mudline.syntax.edits import OverlapError, TextEdit, edited_bytes, with_line_ends

MOST_TRIALS = 24
"""Times that a deck is checked again: causes behind them keep what follows from them beside them."""

FEWEST_TRIALS, MOST_WORK = 2, 20_000
"""Times that any deck is checked again; the findings, blocks and thousands of characters that all trials look at."""

LONGEST_LINE = 4096
"""Characters of a line in which a correction is tried: what is longer was not typed."""

MOST_ALTERNATIVES = 4
"""Corrections of one finding that are tried."""

Check = Callable[[bytes], tuple[LintContext, list[Problem]]]
"""Reads a text and gives its findings, those that comments suppress left out."""

_Key = tuple[str, int]
"""Code of a finding and where it begins in the text as it is, -1 without a place."""

_KINDS = ("SYN", "REF", "CRV", "UNT", "EXT", "SBD006")
"""How the codes of causes begin."""


def under_causes(context: LintContext, problems: list[Problem], check: Check) -> list[Problem]:
    """Return the findings with those that follow from another one under it (`Problem.following`).

    A cause says how many findings follow from it, is as severe as the worst of them, and an error that keeps the deck
    from being evaluated if one of them does. A finding that is still there when the cause is corrected stays beside it.
    """
    if context.text is None or not any(one.code.code.startswith(_KINDS) for one in problems):
        return problems
    text = context.text
    blocks = Blocks(text)
    made = [
        *misspelt(blocks, problems),
        *missing_sections(blocks, problems),
        *line_corrections(blocks, problems),
        *value_corrections(blocks, problems),
    ]
    made = [one for one in made if _typed(line_at(text, one.edits[0].span.start))]
    if not made:
        return by_row(text, problems)
    by_cause: dict[int, list[Correction]] = {}
    for correction in sorted(made, key=lambda one: one.edits[0].span):
        by_cause.setdefault(id(correction.cause), []).append(correction)
    tried = [alternatives[:MOST_ALTERNATIVES] for alternatives in by_cause.values()]
    size = len(problems) + len(blocks.blocks) + blocks.end // 1000
    trials = min(MOST_TRIALS, max(FEWEST_TRIALS, MOST_WORK // size))
    return by_row(text, _Trials(context, text, problems, check, trials).grouped(tried))


def _typed(line: Span) -> bool:
    return line.end - line.start <= LONGEST_LINE


@dataclass(frozen=True, slots=True)
class _Outcome:
    """What a correction does: the findings that are gone, the new ones, and all that there are now."""

    correction: Correction
    gone: list[Problem]
    fresh: list[tuple[_Key, Problem]]
    found: Counter[_Key]

    @property
    def gain(self) -> int:
        """By how many findings the deck got better; below 1 the correction is taken for a wrong one."""
        misread = sum(one.code.code.startswith("SYN") and one.weight is Severity.ERROR for _, one in self.fresh)
        return len(self.gone) - misread - (len(self.fresh) if self.correction.guessed else 0)


class _Trials:
    """The corrections of a deck, made one after the other; each is kept if it explains something."""

    def __init__(
        self, context: LintContext, text: TextOrigin, problems: list[Problem], check: Check, trials: int
    ) -> None:
        self.context = context
        self.text = text
        self.check = check
        self.problems = problems
        self.made: list[TextEdit] = []
        self.left = [(_key(context, problem, ()), problem) for problem in problems]
        self.known = Counter(key for key, _ in self.left)
        self.under: dict[int, Problem] = {}
        self.trials = trials

    def grouped(self, tried: Sequence[Sequence[Correction]]) -> list[Problem]:
        """Return the findings by cause; `tried` has for each cause the corrections that it may need."""
        hidden: set[int] = set()
        for alternatives in tried:
            cause = alternatives[0].cause
            if self.trials <= 0:
                break
            if id(cause) in hidden:
                continue
            if len(self.left) == 1 and all(one.guessed or not one.message for one in alternatives):
                continue  # nothing else is left that could follow
            outcomes = [outcome for one in alternatives if (outcome := self._outcome(one)) is not None]
            best = max(outcomes, key=lambda outcome: outcome.gain, default=None)
            if best is None or best.gain < 1:
                continue
            following = self._following(best)
            if following or (best.correction.message and not best.correction.guessed):
                self.made += best.correction.edits
                self.known = best.found
                self.under[id(cause)] = _cause(self.text, best.correction, following)
                hidden.update(map(id, following))
                gone = hidden | {id(cause)}
                self.left = [(key, one) for key, one in self.left if id(one) not in gone]
        return [self.under.get(id(one), one) for one in self.problems if id(one) not in hidden]

    def _outcome(self, correction: Correction) -> _Outcome | None:
        """What a correction does; None where it cannot be made, leaves its own finding, or too much was tried."""
        if self.trials <= 0:
            return None
        self.trials -= 1
        text = self.text
        edits = with_line_ends(text.source, [*self.made, *correction.edits])
        try:
            context, problems = self.check(edited_bytes(text.source, edits))
        except (OverlapError, UnicodeEncodeError):  # of a character that the encoding lacks
            return None
        now = [(_key(context, problem, edits), problem) for problem in problems]
        found = Counter(key for key, _ in now)
        remaining = found.copy()
        gone: list[Problem] = []
        for key, problem in self.left:
            if remaining[key]:
                remaining[key] -= 1
            else:
                gone.append(problem)
        if all(one is not correction.cause for one in gone):
            return None
        old = self.known.copy()
        fresh: list[tuple[_Key, Problem]] = []
        for key, problem in now:
            if old[key]:
                old[key] -= 1
            else:
                fresh.append((key, problem))
        code, region = correction.cause.code.code, correction.region
        if any(key[0] == code and region.start <= key[1] < region.end for key, _ in fresh):
            return None  # it is still there, a few letters further
        return _Outcome(correction, gone, fresh, found)

    def _following(self, outcome: _Outcome) -> list[Problem]:
        """Those of the findings that are gone which follow from the cause.

        Where the corrected deck has a new finding of the same code elsewhere, as the one that sums up fewer elements,
        the old one holds more than what follows, and stays.
        """
        region = outcome.correction.region
        elsewhere = Counter(key[0] for key, _ in outcome.fresh if not region.start <= key[1] < region.end)
        following: list[Problem] = []
        for problem in outcome.gone:
            if problem is outcome.correction.cause:
                continue
            if elsewhere[problem.code.code]:
                elsewhere[problem.code.code] -= 1
            else:
                following.append(problem)
        return following


def _cause(text: TextOrigin, correction: Correction, following: Sequence[Problem]) -> Problem:
    """The finding of a cause with those that follow from it."""
    cause = correction.cause
    cause = replace(cause, message=correction.message or cause.message, span=correction.place or cause.span)
    same: list[Problem] = []
    if not correction.message:
        same = [one for one in following if (one.code, one.message) == (cause.code, cause.message)]
    if same:
        cause = joined(cause, same, also_in(text, same))
    others = [one for one in following if not any(one is each for each in same)]
    return joined(cause, others, left_out(len(others))) if others else cause


def _key(context: LintContext, problem: Problem, edits: Iterable[TextEdit]) -> _Key:
    """What tells a finding from others, in the text before the edits."""
    text = context.text
    span = problem.span
    if span is None and problem.where is not None and text is not None:
        span = text.span(problem.where)
    return problem.code.code, -1 if span is None else _before(span, edits)


def _before(span: Span, edits: Iterable[TextEdit]) -> int:
    """The beginning of a span of an edited text in the text as it was."""
    at = span.start
    for edit in sorted(edits, key=lambda edit: edit.span):
        if edit.span.start >= at:
            break
        grown = len(edit.text) - (edit.span.end - edit.span.start)
        at = max(at - grown, edit.span.start)
    return at


# -------------------------------------------------------------------------------------- findings that repeat themselves

FEWEST = 3
"""Rows below each other, or fields of a row, that have one fault; two may each have a fault of their own."""

_OF_ROWS = frozenset({SYN001, SYN002, SYN003, SYN004, SYN014, SYN015, REF007})
"""Codes of faults of a row, which one slip gives to many rows."""
_MISREAD = frozenset({SYN001, SYN002, SYN003})
"""Codes of rows whose values may not be what was meant."""
_OF_VALUES = ("UNT", "GEO")
"""How the codes of rules begin that judge the values of a row."""

_DIGITS = re.compile(r"-?[0-9]+")
_STRENGTH = (Blocking.NEVER, Blocking.WITH_TENSION, Blocking.ALWAYS)

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
        severity=Severity.ERROR if blocks is Blocking.ALWAYS else severity,
        blocks=blocks,
        following=(*cause.following, *below),
    )
