"""A deck while it is fixed: what it holds, and whether it is worse after some repairs."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from mudline.deck.model import Deck
from mudline.deck.reading import read_source
from mudline.diagnostics import Problem, Repair, Severity, Span
from mudline.linting.context import LintContext
from mudline.linting.engine import problems_in, told
from mudline.linting.settings import LintSettings
from mudline.linting.suppression import MARK
from mudline.syntax.edits import TextEdit, edited_bytes
from mudline.syntax.source import Source
from mudline.syntax.tree import Kind, SyntaxTree, parse


@dataclass
class FixState:
    """One stage of a deck. `told` are its findings without those that its comments suppress."""

    data: bytes
    source: Source
    deck: Deck
    told: list[Problem]
    errors: Counter[str]

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
        """Comments without their layout, and how often each stands there; those for this linter do not count."""
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


@dataclass(frozen=True, slots=True)
class Reader:
    """Reads and lints the stages of one file."""

    name: str
    settings: LintSettings
    folder: Path | None

    def read(self, data: bytes) -> FixState:
        """A stage."""
        source = Source.from_bytes(data, self.name)
        deck = read_source(source, units=self.settings.units)
        deck.folder = self.folder
        context = LintContext(deck, dialect=self.settings.dialect)
        problems = problems_in(context, self.settings.rules)
        everything = [*deck.problems, *context.scene.problems, *problems]
        errors = Counter(problem.code.code for problem in everything if problem.weight is Severity.ERROR)
        return FixState(data, source, deck, told(context, problems, self.settings.rules), errors)

    def after(self, before: FixState, repairs: Sequence[Repair]) -> FixState | None:
        """The stage after some repairs; None if they cannot be made, change nothing, or make the deck worse."""
        edits = [TextEdit(span, text) for repair in repairs for span, text in repair.edits]
        try:
            data = edited_bytes(before.source, edits)
        except ValueError:  # edits that overlap or lie outside, a character that the encoding lacks
            return None
        if data == before.data:
            return None
        after = self.read(data)
        if any(repair.applicability != "safe" for repair in repairs):
            worse = after.errors.total() > before.errors.total()
        else:
            worse = bool(after.errors - before.errors) or not _same_elsewhere(before, after, edits)
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
