"""Recovery from faults, for findings alone: all checks see the corrected deck.

A fault of reading has corrections. A correction is accepted if the block around it then reads better, which a trial
with the lines of that block shows. The deck with all accepted corrections is read, resolved and checked once, in place
of the deck as written. Its findings are reported at their lines in the file.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import chain
from typing import NamedTuple

from mudline.checks.context import LintContext, also_in, read_deck, read_once
from mudline.checks.recovery import lines, values
from mudline.checks.recovery.lines import Blocks, Correction, start_of
from mudline.checks.rules.keywords import LEG001
from mudline.checks.suppression import suppressions
from mudline.language.codes.fields import SYN002, SYN003, SYN015, SYN016
from mudline.language.codes.lines import SYN001, SYN004, SYN005, SYN007, SYN008, SYN009, SYN010, SYN011, SYN013
from mudline.language.deck.forms import KEYWORD
from mudline.language.deck.reading import TextOrigin, read_source, units_of
from mudline.language.diagnostics import Code, Problem, Repair, Severity, Span
from mudline.language.keywords import catalogue
from mudline.language.syntax.edits import OverlapError, TextEdit, Undoing, apply_edits, edited_bytes, with_line_ends
from mudline.language.syntax.fields import trimmed
from mudline.language.syntax.source import Source

MOST_ROUNDS = 4
"""Number of times that the corrected lines are searched for faults that earlier faults hid."""

MOST_TRIALS, OF_A_TRIAL = 200, 2000
"""Limits of trials: a file of another kind would need as many corrections as it has lines.

MOST_TRIALS: number of corrections of a deck that are tried.
OF_A_TRIAL: characters that are read for one trial; a longer block counts as several.
"""

LONGEST_LINE, LONGEST_TRIED = 4096, 50_000
"""Limits of length in characters.

LONGEST_LINE: line that is corrected.
LONGEST_TRIED: block that is read again to see if it is better.
"""

_OF_KEYWORDS = (SYN008, SYN009)
"""Faults whose correction gives a block its keyword; the block must then read without a fault."""
_OF_SECTIONS = (SYN007, SYN010)
"""Faults whose correction moves blocks to another section, and does not change how they read."""


Corrector = Callable[[Blocks, Sequence[Problem]], Iterator[Correction]]
"""Function that yields corrections of a deck from the problems under its codes."""


class Recovery(NamedTuple):
    """Corrector with the codes that it recovers from; with `always` it is called for decks without these codes too."""

    corrector: Corrector
    codes: tuple[Code, ...]
    always: bool = False


@dataclass
class Recovered:
    """Deck with its faults corrected.

    units: the units of the deck, None if its text tells them.
    causes: the findings of the corrected faults, at their places in the file.
    steps: the edits, by which places lead back to the file.
    """

    context: LintContext
    units: str | None
    causes: list[Problem] = field(default_factory=list)
    steps: list[Undoing] = field(default_factory=list)

    def take(self, corrections: Sequence[Correction]) -> bool:
        """Read the deck with some corrections; return True if these could be made."""
        if (text := self.context.text) is None or not corrections:
            return False
        ready = [replace(item, edits=tuple(with_line_ends(text.source, item.edits))) for item in corrections]
        edits = [edit for item in ready for edit in item.edits]
        after = self._edited(self.context, text.source, edits)
        if after is None:
            return False
        self.causes += self.as_written(map(_cause, ready))
        self.steps.append(Undoing(edits))
        self.context = after
        return True

    def _edited(self, context: LintContext, source: Source, edits: Sequence[TextEdit]) -> LintContext | None:
        """Return the deck of a context with edits made; None if they cannot be made."""
        deck = context.deck
        try:
            data = edited_bytes(source, edits)
        except (OverlapError, UnicodeEncodeError):  # of a character that the encoding lacks
            return None
        edited = read_deck(data, deck.file, form=KEYWORD, units=self.units, folder=deck.folder)
        return LintContext(edited, context.dialect, context.fixing)

    def without_errors(self, written: LintContext) -> LintContext | None:
        """Return the deck as written with only those causes corrected that are errors; None if one cannot be."""
        repairs = [cause.repair for cause in self.causes if cause.weight is Severity.ERROR]
        if not repairs:
            return written
        edits = [TextEdit(*edit) for repair in repairs if repair for edit in repair.edits]
        return self._edited(written, written.text.source, edits) if written.text and all(repairs) else None

    def as_written(self, problems: Iterable[Problem]) -> Iterator[Problem]:
        """Yield problems of the corrected deck at their places in the file, except in lines that corrections added.

        A repair that a correction touches is left out.
        """
        origin = self.context.deck.origin
        for problem in problems:
            span = origin.span_of(problem) if isinstance(origin, TextOrigin) else problem.span
            # A deck is migrated as it is written, or not at all.
            repair = None if problem.code is LEG001 else problem.repair
            for step in reversed(self.steps):
                if span is not None and step.is_in_new_lines(span):
                    break
                span = span and step.before(span)
                if repair is not None and any(step.touches(place) for place, _ in repair.edits):
                    repair = None
                if repair is not None:
                    repair = replace(repair, edits=tuple((step.before(place), text) for place, text in repair.edits))
            else:
                yield replace(problem, span=span, where=problem.where if span else None, repair=repair)


def recovered(context: LintContext, codes: Collection[str], *, suppress: bool) -> Recovered | None:
    """Return the corrected deck; None if nothing was corrected.

    `codes` are those of the findings that the caller wants. With `suppress`, faults that comments of the deck suppress
    are left alone: recovery from them would go unnoticed.
    """
    deck = context.deck
    of_text = deck.origin.takes_edits and units_of(deck) == deck.units  # else corrections do not change the units
    found = Recovered(context, None if of_text else deck.units)
    hiding = context.once(suppressions) if suppress else None
    reported = [one for one in deck.problems if one.code.code in codes]
    reported = hiding.reported(reported) if hiding else reported
    trials = MOST_TRIALS
    while len(found.steps) < MOST_ROUNDS and (text := found.context.text) is not None:
        round_ = _Round(Blocks(found.context, text), codes, trials)
        if not found.take(round_.taken(reported)):
            break
        trials = round_.trials
        reported = [one for one in found.context.deck.problems if one.code.code in codes]
    if found.context.scene.lacks:
        late = values.scene_corrections(found.context)
        wanted = [one for one in late if one.cause.code.code in codes]
        if hiding:
            wanted = [one for one in wanted if hiding.reported(found.as_written([one.cause]))]
        found.take(wanted)
    return found if found.steps else None


def _cause(correction: Correction) -> Problem:
    cause = correction.cause
    repair = Repair("unsafe", correction.does, correction.edits) if correction.does else cause.repair
    return replace(cause, message=correction.message or cause.message, repair=repair)


class _Round:
    """Corrections of a text that are accepted, no two of which change the same lines."""

    def __init__(self, blocks: Blocks, codes: Collection[str], trials: int) -> None:
        self.blocks = blocks
        self.text = blocks.text
        self.codes = codes
        self.trials = trials
        self.errors: dict[Span, Counter[tuple[Code, str]]] = {}

    def taken(self, problems: Sequence[Problem]) -> list[Correction]:
        """Return the first correction of each fault that makes its block better."""
        taken: list[Correction] = []
        for recoveries in RECOVERIES:
            proposed: list[Correction] = []
            for corrector, codes, always in recoveries:
                asked = [one for one in problems if one.code in codes]
                if asked or always:
                    proposed += corrector(self.blocks, asked)
            proposed.sort(key=lambda each: (each.edits[0].span.start, each.cause.code is SYN002))
            for one in proposed:
                start, end = one.region
                line = self.text.source.line_around(one.edits[0].span.start)
                apart = all(end <= other.region.start or other.region.end <= start for other in taken)
                wanted = one.cause.code.code in self.codes and line.end - line.start <= LONGEST_LINE
                if apart and wanted and self._is_better(one):
                    taken.append(one)
            explained = {id(one.cause) for one in taken}
            problems = [one for one in problems if one.repair is None and id(one) not in explained]
        return taken

    def _is_better(self, correction: Correction) -> bool:
        """Return True if a correction removes its fault and leaves fewer faults in the blocks around it."""
        if correction.certain or correction.cause.code in _OF_SECTIONS:
            return True
        edits = correction.edits
        first = self.blocks.at(max(edits[0].span.start - correction.joins, 0))
        last = self.blocks.at(edits[-1].span.end - (edits[-1].span.end > edits[0].span.start))
        section = first.section.name
        region = Span(first.span.start, max(last.span.end, edits[-1].span.end))
        if not section or region.end - region.start > LONGEST_TRIED or self.trials <= 0:
            return False
        self.trials -= 1 + (region.end - region.start) // OF_A_TRIAL
        if region not in self.errors:
            self.errors[region] = Counter(self._faults(section, region, ()))
        before = self.errors[region]
        try:
            after = Counter(self._faults(section, region, edits))
        except ValueError:  # of edits that overlap
            return False
        cause = (correction.cause.code, correction.cause.message)
        if after[cause] >= max(before[cause], 1):
            return False
        return after <= before or (cause[0] not in _OF_KEYWORDS and after.total() < before.total())

    def _faults(self, section: str, region: Span, edits: Sequence[TextEdit]) -> Iterator[tuple[Code, str]]:
        """Yield the faults in some lines of a section with edits of the whole text made."""
        text = self.text.source.unified[slice(*region)]
        moved = [TextEdit(edit.span.moved(-region.start), edit.text) for edit in edits]
        head = "" if text.startswith("$") else f"${section}\n"
        edited = apply_edits(text, moved)
        behind = ("" if edited.endswith("\n") else "\n") + "$MODEL\n"  # so that no block is the last one
        source = Source(self.text.source.name, f"{head}{edited}{behind}", clean=self.text.source.clean)
        for problem in read_source(source, units="user", read=read_once).problems:
            if problem.weight is Severity.ERROR or problem.code in (SYN009, SYN013):
                yield problem.code, problem.message


_DIGITS = re.compile(r"[0-9]+")


def misspelt(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Yield corrections of misspelt names; a name that is misspelt several times is corrected everywhere."""
    alike: dict[tuple[str, str], list[tuple[Problem, Repair]]] = {}
    for problem in problems:
        if problem.repair is not None:
            alike.setdefault((problem.code.code, problem.message), []).append((problem, problem.repair))
    text = blocks.text
    for uses in alike.values():
        problem, repair = min(uses, key=lambda use: start_of(text, use[0]))
        edits = tuple(TextEdit(*edit) for edit in sorted(chain.from_iterable(each.edits for _, each in uses)))
        start = edits[0].span.start
        spot = blocks.at(start)
        region = spot.section.span if problem.code is SYN010 else spot.span
        others = [use for use, _ in uses if use is not problem]
        message = f"{problem.message}; {also_in(text, others)}" if others else ""
        if all(_differs(text.source.unified[slice(*edit.span)], edit.text) for edit in edits):
            yield Correction(problem, edits, region, message, repair.message, joins=edits[0].text.startswith("C "))


def _differs(written: str, corrected: str) -> bool:
    """Return True if two names differ in more than their digits, which distinguish objects of a kind."""
    return _DIGITS.sub("", corrected).casefold() != _DIGITS.sub("", written).casefold()


def before_sections(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Yield a `$SECTION` line for blocks before any section."""
    text = blocks.text
    tree = text.tree
    outside = {start_of(text, problem): problem for problem in problems}
    heads = (trimmed(text.source.unified, *block.head.span) for block in tree.preamble.blocks)
    run = [(head.start, block.name) for head, block in zip(heads, tree.preamble.blocks, strict=True)]
    if not run or any(head not in outside for head, _ in run):  # a deck of another program is reported once
        return
    end = tree.preamble.span.end
    start, name = run[0]
    if name in catalogue.SECTIONS:
        message = f"*{name} is no keyword: write ${name}"
        yield Correction(
            outside[start], (TextEdit(Span(start, start + 1), "$"),), Span(start, end), message, certain=True
        )
        return
    edits, current, message = list[TextEdit](), "", ""
    for head, keyword in run:  # a line for each keyword that does not belong to the section before
        sections = catalogue.sections_of(keyword) or (current or "MODEL",)
        if current not in sections:
            current = sections[0]
            edits.append(TextEdit(Span(head, head), f"${current}\n"))
    if len(run) > 1:
        words = edits[0].text.strip()
        message = f"the line {words} is missing above this one: *{name} stands before any $SECTION"
    yield Correction(outside[start], tuple(edits), Span(start, end), message, certain=True)


_OF_FOREIGN_LINES = (SYN001, SYN002, SYN003, SYN004)
"""Faults of lines that belong to another keyword."""

_FIRST = (
    Recovery(misspelt, (SYN004, SYN005, SYN008, SYN009, SYN010)),
    Recovery(before_sections, (SYN007,)),
    Recovery(lines.stars, (*_OF_FOREIGN_LINES, SYN011, SYN013, SYN016), always=True),
    Recovery(lines.legal_lines, (*_OF_FOREIGN_LINES, SYN005), always=True),
    Recovery(values.numbers, (SYN002,)),
    Recovery(values.rows, (SYN001, SYN003)),
    Recovery(values.indented_comments, (SYN001, SYN002, SYN003)),
    Recovery(values.decimal_commas, (SYN015,)),
)
RECOVERIES = (_FIRST, (Recovery(lines.keyword_lines, _OF_FOREIGN_LINES),))
"""All correctors in the order in which they are called; the last one gets problems without a correction."""
