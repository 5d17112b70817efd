"""Linting and fixing of one file: a pure function of its content and its settings, which may run in another process.

Repairs of findings are made in passes. After each pass the deck is read again, and the pass is dropped if the deck got
worse.
"""

from __future__ import annotations

from bisect import bisect_left, insort
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import islice
from pathlib import Path
from typing import NamedTuple, cast

from mudline.basics.files import recording_looks
from mudline.basics.limits import MOST_PASSES, MOST_TRIES
from mudline.basics.outside import refusing_outside
from mudline.checks.context import LintContext
from mudline.checks.engine import Fixing, LintSettings, covered_findings, joined_problems
from mudline.checks.recovery.lines import start_of
from mudline.checks.report import FileReport
from mudline.checks.suppression import MARK
from mudline.language.deck.forms import form_of
from mudline.language.deck.keyword_text import meaning
from mudline.language.deck.model import Deck
from mudline.language.deck.reading import TextOrigin, read_source
from mudline.language.diagnostics import Diagnostic, Problem, Repair, Severity, Span
from mudline.language.syntax.edits import TextEdit, Undoing, edited_bytes, with_line_ends
from mudline.language.syntax.source import Source
from mudline.language.syntax.tree import LeafKind


def lint_one(name: str, data: bytes, settings: LintSettings, folder: Path | None = None) -> FileReport:
    """Return the report on the content of a file, fixed if the settings ask for it; never raises for content.

    Nothing is written. `folder` is the folder of files that the deck names; without it they are not searched.
    """
    result = FixResult(None, (), "")
    with refusing_outside(lambda _folder: settings.no_outside):
        if settings.fixing is not Fixing.NONE and form_of(name) == "keyword":
            result = fix_bytes(data, name, settings, folder)
        content = data if result.changed is None else result.changed
        with recording_looks() as paths:
            findings, coverage = covered_findings(content, name, settings, folder)
    found, fixed = (with_severities(each, settings) for each in (findings, result.fixed))
    return FileReport(name, found, fixed, result.changed, result.note, tuple(paths), coverage)


def with_severities(findings: Iterable[Diagnostic], settings: LintSettings) -> tuple[Diagnostic, ...]:
    """Return the findings with the severities that the settings give them."""
    return tuple(_with_severity(finding, settings.severities) for finding in findings)


def _with_severity(diagnostic: Diagnostic, severities: Mapping[str, Severity]) -> Diagnostic:
    """Return a finding with its severity, never below that of the findings joined to it."""
    severity = severities.get(diagnostic.code, diagnostic.severity)
    following = tuple(_with_severity(finding, severities) for finding in diagnostic.following)
    worst = max((severity, *(finding.severity for finding in following)), key=lambda each: each.rank)
    changed = worst is not diagnostic.severity or following != diagnostic.following
    return replace(diagnostic, severity=worst, following=following) if changed else diagnostic


# -------------------------------------------------------------------------------------------------------------- fixes


class FixResult(NamedTuple):
    """Result of fixing: the new content (None if unchanged), the fixed findings, why the others remain, or ""."""

    changed: bytes | None
    fixed: tuple[Diagnostic, ...]
    note: str


def fix_bytes(data: bytes, name: str, settings: LintSettings, folder: Path | None = None) -> FixResult:
    """Return the content of a keyword deck with the fixes that the settings ask for; never raises for content.

    A deck with errors of reading (SYN...) stays as it is, unless fixes clear all of them.
    """
    run = _FixRun(StageReader(name, settings, folder))
    first = run.reader.read(data)
    last = run.fix(first)
    if last.unreadable:
        fault = last.context.deck.diagnose(last.unreadable)[0]
        note = f"not fixed: correct what cannot be read first, {fault.code} in line {fault.line}"
        return FixResult(None, (), note if run.wanted(first) else "")
    changed = last.data if last.data != data else None
    return FixResult(changed, tuple(run.fixed), run.note(last))


class _FixRun:
    """Passes over one deck."""

    def __init__(self, reader: StageReader) -> None:
        self.reader = reader
        self.settings = reader.settings
        self.fixed: list[Diagnostic] = []
        self.refused: set[tuple[str, str, str]] = set()
        self.tries = MOST_TRIES
        self.stopped = False

    def fix(self, state: FixState) -> FixState:
        """Return the deck when nothing is left to repair."""
        passes = 0
        changed = False
        while (problems := self._next(state)) or changed:
            if not problems:
                self.refused.clear()  # what could not be done then may be possible now
                changed = False
                continue
            if passes == MOST_PASSES or self.tries <= 0:
                self.stopped = True
                break
            repaired, after = self._accepted(state, problems)
            done = {id(problem) for problem in repaired} if after else set()
            self.refused |= {_key(state, problem) for problem in problems if id(problem) not in done}
            if after is not None:
                self.fixed += state.context.deck.diagnose(repaired)
                passes += 1
                changed, state = True, after
        return state

    def note(self, last: FixState) -> str:
        """Return a note on findings that could not be fixed, or ""."""
        if self.stopped:
            end = f"{MOST_PASSES} passes" if self.tries > 0 else f"{MOST_TRIES} tries"
            return f"fixing was stopped after {end}: run it again to see what is left"
        count = sum(_key(last, problem) in self.refused for problem in self.wanted(last))
        left = f"{count} fix{'es' * (count != 1)} not made: the deck would have had a new error or lost something"
        return left if count else ""

    def wanted(self, state: FixState) -> list[Problem]:
        """Return the findings that the settings want fixed."""
        return [
            problem
            for problem in state.findings
            if problem.repair is not None
            and any(state.source.text[slice(*span)] != text for span, text in problem.repair.edits)
            and self.settings.fixing.takes(problem.repair.applicability)
            and problem.code.code not in self.settings.unfixable
        ]

    def _next(self, state: FixState) -> list[Problem]:
        """Return findings whose repairs do not overlap: errors of reading first, then safe repairs, then the others."""
        fixable = [problem for problem in self.wanted(state) if _key(state, problem) not in self.refused]
        if state.unreadable:
            codes = {error.code.code for error in state.unreadable}
            return _disjoint([one for one in fixable if one.code.code in codes and one.weight is Severity.ERROR])
        return _disjoint([problem for problem in fixable if _repair(problem).applicability == "safe"] or fixable)

    def _accepted(self, state: FixState, problems: list[Problem]) -> tuple[list[Problem], FixState | None]:
        """Return the problems whose repairs make nothing worse, and the deck after them; None if there are none."""
        after = self._try(state, problems)
        if after is not None or len(problems) == 1:
            return problems, after
        half = len(problems) // 2
        one, first = self._accepted(state, problems[:half])
        two, second = self._accepted(state, problems[half:])
        if first is None or second is None:
            return (two, second) if first is None else (one, first)
        both = self._try(state, one + two)
        return (one, first) if both is None else (one + two, both)

    def _try(self, state: FixState, problems: Sequence[Problem]) -> FixState | None:
        if self.tries <= 0:
            return None
        self.tries -= 1
        return self.reader.after(state, [_repair(problem) for problem in problems])


def _repair(problem: Problem) -> Repair:
    """Return the repair of a problem that has one."""
    if problem.repair is None:
        raise ValueError(f"{problem.code.code} has no repair here")
    return problem.repair


def _key(state: FixState, problem: Problem) -> tuple[str, str, str]:
    """Return code, message and text of the line of a problem: the same after other lines become longer or shorter."""
    line = state.source.position(_repair(problem).edits[0][0].start)[0]
    return problem.code.code, problem.message, state.source.line(line)


def _disjoint(problems: list[Problem]) -> list[Problem]:
    """Return as many of the problems, in the order of the text, as change different characters."""
    taken: list[Span] = []
    chosen: list[Problem] = []
    for problem in sorted(problems, key=lambda problem: _repair(problem).edits[0][0]):
        spans = [span for span, _ in _repair(problem).edits]
        beside = ((span, bisect_left(taken, span)) for span in spans)
        if not any(_overlap(span, edit) for span, at in beside for edit in islice(taken, max(at - 1, 0), at + 1)):
            chosen.append(problem)
            for span in spans:
                insort(taken, span)
    return chosen


def _overlap(first: Span, second: Span) -> bool:
    """Return True if two edits change the same characters; an insertion touches text next to its place."""
    if first.start == first.end or second.start == second.end:
        return first.start <= second.end and second.start <= first.end
    return first.start < second.end and second.start < first.end


@dataclass(eq=False)
class FixState:
    """Stage of a deck, and the findings of lint in it, including joined ones."""

    data: bytes
    text: TextOrigin
    context: LintContext
    findings: list[Problem]

    @property
    def source(self) -> Source:
        """Text of this stage."""
        return self.text.source

    def errors(self, edits: Sequence[TextEdit] = (), source: Source | None = None) -> Counter[tuple[str, int]]:
        """Return code and line of each error, in the deck as it is written or as corrected.

        After edits of a source, lines are those before the edits, and 0 for lines that the edits brought.
        """
        undoing, written = Undoing(edits), source or self.source

        def place(error: Problem) -> tuple[str, int]:
            start = start_of(self.text, error)
            span = Span(start, start + 1)
            new = start < 0 or undoing.is_in_new_lines(span)
            return error.code.code, 0 if new else written.position(undoing.before(span).start)[0]

        sources = ((*self.context.deck.problems, *self.context.scene.problems), self.findings)
        as_written, as_meant = (Counter(place(one) for one in each if one.weight is Severity.ERROR) for each in sources)
        return as_written | as_meant

    @property
    def unreadable(self) -> list[Problem]:
        """Errors of reading."""
        errors = (problem for problem in self.context.deck.problems if problem.weight is Severity.ERROR)
        return [error for error in errors if error.code.code.startswith("SYN")]

    @cached_property
    def comments(self) -> Counter[str]:
        """Comments without their layout and how often each occurs; comments for mudline are left out."""
        text = self.source.unified
        comments = (text[slice(*leaf.span)] for leaf in self.text.tree.leaves() if leaf.kind is LeafKind.COMMENT)
        return Counter(" ".join(comment[1:].split()) for comment in comments if not MARK.match(comment))


class StageReader(NamedTuple):
    """Reader and linter of the stages of one file."""

    name: str
    settings: LintSettings
    folder: Path | None

    def read(self, data: bytes) -> FixState:
        """Return a stage."""
        deck = read_source(Source.from_bytes(data, self.name), units=self.settings.units)
        deck.folder = self.folder
        context = LintContext(deck, dialect=self.settings.dialect, fixing=True)
        problems = joined_problems(context, self.settings.rules)
        findings = [each for problem in problems for each in (problem, *problem.following)]
        return FixState(data, cast("TextOrigin", deck.origin), context, findings)

    def after(self, before: FixState, repairs: Sequence[Repair]) -> FixState | None:
        """Return the stage after some repairs; None if they cannot be made, change nothing, or make the deck worse."""
        new = (TextEdit(span, text) for repair in repairs for span, text in repair.edits)
        edits = with_line_ends(before.source, new)
        try:
            data = edited_bytes(before.source, edits)
        except ValueError:  # edits that overlap or lie outside, a character that the encoding lacks
            return None
        if data == before.data:
            return None
        after = self.read(data)
        worse = bool(after.errors(edits, before.source) - before.errors())
        if all(repair.applicability == "safe" for repair in repairs):
            worse = worse or not _same_elsewhere(before, after, edits)
        return None if worse or before.comments - after.comments else after


def _same_elsewhere(before: FixState, after: FixState, edits: Sequence[TextEdit]) -> bool:
    """Return True if both have the same blocks, which mean the same where nothing was edited."""
    old, new = before.context.deck, after.context.deck
    if _outline(old) != _outline(new):
        return False
    blocks = [spot for spot in before.text.tree.spots if spot.where.section >= 0 and spot.block]
    return all(
        any(edit.span.start <= block.span.end and block.span.start <= edit.span.end for edit in edits)
        or meaning(old.at(block.where), comments=True) == meaning(new.at(block.where), comments=True)
        for block in blocks
    )


def _outline(deck: Deck) -> list[tuple[str, list[str]]]:
    return [(section.name, [block.keyword for block in section.blocks]) for section in deck.sections]
