"""One cause, one finding: what follows from a fault is put under the finding that names it.

Whether a finding follows is tried out, not guessed: the fault is corrected, the deck is checked again, and what is then
gone follows from it. Nothing of this runs for a deck in which no finding has a correction.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace

from mudline.deck.reading import TextOrigin
from mudline.diagnostics import Problem, Severity, Span
from mudline.linting.corrections import Blocks, Correction, line_at, missing_sections, misspelt
from mudline.linting.line_corrections import line_corrections
from mudline.linting.rows import also_in, by_row, joined, left_out
from mudline.linting.rule import LintContext
from mudline.linting.value_corrections import value_corrections
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
