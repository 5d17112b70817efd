"""One file linted and fixed: a pure function of its content and its settings, which may run in another process.

The repairs of findings are made in passes, each of which is read again and dropped if the deck got worse.
"""

from __future__ import annotations

from bisect import bisect_left, insort
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import islice
from pathlib import Path
from typing import NamedTuple

from mudline.basics.files import recording_looks
from mudline.basics.limits import MOST_PASSES, MOST_TRIES
from mudline.basics.outside import refusing_outside
from mudline.checks.context import LintContext
from mudline.checks.engine import Fixing, LintSettings, covered_findings, joined_problems
from mudline.checks.recovery.blocks import start_of
from mudline.checks.suppression import MARK
from mudline.language.deck.forms import form_of
from mudline.language.deck.model import Deck
from mudline.language.deck.reading import read_source
from mudline.language.diagnostics import Coverage, Diagnostic, Problem, Repair, Severity, Span
from mudline.language.syntax.edits import TextEdit, Undoing, edited_bytes, with_line_ends
from mudline.language.syntax.source import Source
from mudline.language.syntax.tree import Kind, SyntaxTree, parse


@dataclass(frozen=True, slots=True)
class FileReport:
    """What came out for one file.

    `found` are the findings in the content as it is after fixing, in their order; `fixed` those that are gone.
    `changed` is the new content, or None where it is the old one. `note` says why fixes were not made, or "";
    a deck in JSON or YAML has none. `looked_at` are the paths on which the findings depend besides the content.
    `coverage` says how many keywords were read.
    """

    file: str
    found: tuple[Diagnostic, ...]
    fixed: tuple[Diagnostic, ...] = ()
    changed: bytes | None = None
    note: str = ""
    looked_at: tuple[str, ...] = ()
    coverage: Coverage = field(default_factory=Coverage)


def lint_one(name: str, data: bytes, settings: LintSettings, folder: Path | None = None) -> FileReport:
    """Lint the content of a file, and fix it if the settings ask for it; writes nothing and never raises for content.

    `folder` is where files that the deck names are; without it none of them is looked for.
    """
    with refusing_outside(lambda _folder: settings.no_outside):
        return _lint_one(name, data, settings, folder)


def _lint_one(name: str, data: bytes, settings: LintSettings, folder: Path | None) -> FileReport:
    result = Fixed(None, (), "")
    if settings.fixing is not Fixing.NONE and form_of(name) == "keyword":
        result = fix_bytes(data, name, settings, folder)
    content = data if result.changed is None else result.changed
    with recording_looks() as paths:
        found, coverage = covered_findings(
            content, name, settings.rules, units=settings.units, folder=folder, dialect=settings.dialect
        )
    fixed = with_severities(result.fixed, settings)
    return FileReport(
        name, with_severities(found, settings), fixed, result.changed, result.note, tuple(paths), coverage
    )


def with_severities(found: Iterable[Diagnostic], settings: LintSettings) -> tuple[Diagnostic, ...]:
    """The findings with the severities that the settings give them."""
    return tuple(_with_severity(one, settings.severities) for one in found)


def _with_severity(found: Diagnostic, given: Mapping[str, Severity]) -> Diagnostic:
    """A finding with its severity, which is never below that of what follows from it and is left out."""
    severity = given.get(found.code, found.severity)
    following = tuple(_with_severity(one, given) for one in found.following)
    worst = max((severity, *(one.severity for one in following)), key=lambda one: one.rank)
    changed = worst is not found.severity or following != found.following
    return replace(found, severity=worst, following=following) if changed else found


# -------------------------------------------------------------------------------------------------------------- fixes


class Fixed(NamedTuple):
    """The new content (None: nothing was changed), the findings that are fixed, and why others are not, or ""."""

    changed: bytes | None
    fixed: tuple[Diagnostic, ...]
    note: str


def fix_bytes(data: bytes, name: str, settings: LintSettings, folder: Path | None = None) -> Fixed:
    """The content of a keyword deck with the fixes that the settings ask for; never raises for content.

    A deck that cannot be read as it should (errors SYN...) stays as it is, unless fixes clear all of them.
    """
    run = _Run(Reader(name, settings, folder), settings)
    first = run.reader.read(data)
    last = run.fix(first)
    if last.unreadable:
        fault = last.deck.diagnose(last.unreadable)[0]
        note = f"not fixed: correct what cannot be read first, {fault.code} in line {fault.line}"
        return Fixed(None, (), note if run.wanted(first) else "")
    changed = last.data if last.data != data else None
    return Fixed(changed, tuple(run.fixed), run.note())


class _Run:
    """The passes over one deck."""

    def __init__(self, reader: Reader, settings: LintSettings) -> None:
        self.reader = reader
        self.settings = settings
        self.fixed: list[Diagnostic] = []
        self.refused: set[tuple[str, str, str]] = set()
        self.left = 0
        self.tries = MOST_TRIES
        self.stopped = False

    def fix(self, state: FixState) -> FixState:
        """The deck when nothing is left to repair."""
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
            made, after = self._accepted(state, problems)
            done = {id(one) for one in made} if after else set()
            self.refused |= {_key(state, one) for one in problems if id(one) not in done}
            if after is not None:
                self.fixed += state.deck.diagnose(made)
                passes += 1
                changed, state = True, after
        self.left = sum(_key(state, one) in self.refused for one in self.wanted(state))
        return state

    def note(self) -> str:
        """What could not be fixed, or ""."""
        if self.stopped:
            end = f"{MOST_PASSES} passes" if self.tries > 0 else f"{MOST_TRIES} tries"
            return f"fixing was stopped after {end}: run it again to see what is left"
        count = self.left
        if not count:
            return ""
        return f"{count} fix{'es' * (count != 1)} not made: the deck would have had a new error or lost something"

    def wanted(self, state: FixState) -> list[Problem]:
        """The findings that the settings want fixed."""
        return [
            problem
            for problem in state.findings
            if problem.repair is not None
            and any(state.source.text[slice(*span)] != text for span, text in problem.repair.edits)
            and self.settings.fixing.takes(problem.repair.applicability)
            and problem.code.code not in self.settings.unfixable
        ]

    def _next(self, state: FixState) -> list[Problem]:
        """Findings whose repairs do not overlap: errors of reading first, then safe ones, then the others."""
        wanted = [problem for problem in self.wanted(state) if _key(state, problem) not in self.refused]
        if state.unreadable:
            codes = {error.code.code for error in state.unreadable}
            cleared = [one for one in wanted if one.code.code in codes and one.weight is Severity.ERROR]
            return _disjoint(cleared)
        return _disjoint([problem for problem in wanted if _repair(problem).applicability == "safe"] or wanted)

    def _accepted(self, state: FixState, problems: list[Problem]) -> tuple[list[Problem], FixState | None]:
        """Those of the problems whose repairs make nothing worse, and the deck after them; None if there are none."""
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
    """The repair of a problem that has one."""
    if problem.repair is None:
        raise ValueError(f"{problem.code.code} has no repair here")
    return problem.repair


def _key(state: FixState, problem: Problem) -> tuple[str, str, str]:
    """What is said of which line: the same after others are longer or shorter."""
    line = state.source.position(_repair(problem).edits[0][0].start)[0]
    return problem.code.code, problem.message, state.source.line(line)


def _disjoint(problems: list[Problem]) -> list[Problem]:
    """As many of the problems, in the order of the text, as want different characters."""
    taken: list[Span] = []
    chosen: list[Problem] = []
    for problem in sorted(problems, key=lambda problem: _repair(problem).edits[0][0]):
        spans = [span for span, _ in _repair(problem).edits]
        if all(_free(span, taken) for span in spans):
            chosen.append(problem)
            for span in spans:
                insort(taken, span)
    return chosen


def _free(span: Span, taken: list[Span]) -> bool:
    at = bisect_left(taken, span)
    return not any(_overlap(span, other) for other in islice(taken, max(at - 1, 0), at + 1))


def _overlap(one: Span, other: Span) -> bool:
    """Whether two edits want the same characters; an insertion meets what begins or ends at its place."""
    if one.start == one.end or other.start == other.end:
        return one.start <= other.end and other.start <= one.end
    return one.start < other.end and other.start < one.end


@dataclass(eq=False)
class FixState:
    """One stage of a deck, and what lint reports of it, with what follows from its findings."""

    data: bytes
    source: Source
    context: LintContext
    findings: list[Problem]

    @property
    def deck(self) -> Deck:
        """The deck."""
        return self.context.deck

    def errors(self, edits: Sequence[TextEdit] = (), source: Source | None = None) -> Counter[tuple[str, int]]:
        """Return code and line of each error of the deck as it is written or as it was meant.

        After some edits of a source: the lines that they had there, 0 for those that the edits brought.
        """
        text, undoing, written = self.context.text, Undoing(edits), source or self.source

        def place(error: Problem) -> tuple[str, int]:
            start = start_of(text, error) if text else -1
            span = Span(start, start + 1)
            new = start < 0 or undoing.is_in_new_lines(span)
            return error.code.code, 0 if new else written.position(undoing.before(span).start)[0]

        sources = ((*self.deck.problems, *self.context.scene.problems), self.findings)
        as_written, as_meant = (Counter(place(one) for one in each if one.weight is Severity.ERROR) for each in sources)
        return as_written | as_meant

    @property
    def unreadable(self) -> list[Problem]:
        """What could not be read as it should."""
        return [
            problem
            for problem in self.deck.problems
            if problem.weight is Severity.ERROR and problem.code.code.startswith("SYN")
        ]

    @cached_property
    def tree(self) -> SyntaxTree:
        """The lines of the text."""
        return parse(self.source)

    @cached_property
    def comments(self) -> Counter[str]:
        """Comments without their layout and how often each occurs; those for this linter are left out."""
        text = self.source.unified
        comments = (text[slice(*leaf.span)] for leaf in self.tree.leaves() if leaf.kind is Kind.COMMENT)
        return Counter(" ".join(comment[1:].split()) for comment in comments if not MARK.match(comment))

    def untouched(self, edits: Sequence[Span]) -> Iterator[tuple[int, int]]:
        """Section and block of every block that no edit touches."""
        for index, section in enumerate(self.tree.sections):
            for number, block in enumerate(section.blocks):
                start, end = block.head.span.start, (block.leaves or [block.head])[-1].span.end
                if not any(edit.start <= end and start <= edit.end for edit in edits):
                    yield index, number


class Reader(NamedTuple):
    """Reads and lints the stages of one file."""

    name: str
    settings: LintSettings
    folder: Path | None

    def read(self, data: bytes) -> FixState:
        """A stage."""
        source = Source.from_bytes(data, self.name)
        deck = read_source(source, units=self.settings.units)
        deck.folder = self.folder
        context = LintContext(deck, dialect=self.settings.dialect, fixing=True)
        found = joined_problems(context, self.settings.rules)
        return FixState(data, source, context, [each for one in found for each in (one, *one.following)])

    def after(self, before: FixState, repairs: Sequence[Repair]) -> FixState | None:
        """The stage after some repairs; None if they cannot be made, change nothing, or make the deck worse."""
        made = (TextEdit(span, text) for repair in repairs for span, text in repair.edits)
        edits = with_line_ends(before.source, made)
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
    """Whether both have the same blocks, with equal models where nothing was edited."""
    if _outline(before.deck) != _outline(after.deck):
        return False
    one, other = before.deck.sections, after.deck.sections
    places = before.untouched([edit.span for edit in edits])
    return all(one[index].blocks[number] == other[index].blocks[number] for index, number in places)


def _outline(deck: Deck) -> list[tuple[str, list[str]]]:
    return [(section.name, [block.keyword for block in section.blocks]) for section in deck.sections]
