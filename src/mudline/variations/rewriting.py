"""The text of each new deck: that of the source with other values of parameters, and with blocks that come and go."""

from __future__ import annotations

from dataclasses import replace
from typing import cast

from mudline.deck.keyword_form import to_keyword
from mudline.deck.loading import dump, form_of
from mudline.deck.model import Deck
from mudline.deck.reading import TextOrigin, read_source
from mudline.diagnostics import Span
from mudline.keywords import catalogue
from mudline.keywords.reader import all_keys
from mudline.syntax.edits import TextEdit, edited_bytes
from mudline.syntax.fields import first_key
from mudline.syntax.source import Source
from mudline.syntax.tree import Kind, Leaf, RawBlock
from mudline.variations.model import PlannedDeck, Removal
from mudline.variations.targets import Targets


def as_text(deck: Deck) -> Deck:
    """The deck as read from keyword text. Raises DeckError for a JSON or YAML deck that cannot be said in it."""
    if isinstance(deck.origin, TextOrigin):
        return deck
    source = Source.from_bytes(to_keyword(deck).encode(), deck.file)
    return replace(read_source(source, units=deck.units), source=deck.source, folder=deck.folder).require()


class Rewriter:
    """Makes the decks of a source that was read from text."""

    def __init__(self, deck: Deck, targets: Targets) -> None:
        self.deck = deck
        self.targets = targets
        origin = cast("TextOrigin", deck.origin)
        self.source = origin.source
        self.tree = origin.tree
        self._left_out = frozenset(
            (index, number)
            for index, section in enumerate(self.tree.sections)
            if section.name == "PREPROCESSOR"
            for number, block in enumerate(section.blocks)
            if (declared := catalogue.block_class(section.name, block.name)) and declared.facts.plans_decks
        )

    def content(self, planned: PlannedDeck) -> bytes:
        """A new deck, in the form that the suffix of its path tells."""
        content = edited_bytes(self.source, self.edits(planned))
        form = form_of(planned.path)
        if form == "keyword":
            return content
        read = read_source(Source.from_bytes(content, self.deck.file), units=self.deck.units)
        return dump(replace(read, source=planned.path.rpartition("/")[2]), form).encode()

    def edits(self, planned: PlannedDeck) -> list[TextEdit]:
        """What is changed in the text of the source."""
        edits: list[TextEdit] = []
        for name, text in planned.values.items():
            target = self.targets.target(name)
            if text != target.text:
                edits.append(TextEdit(target.span, text))
        gone = set(self._left_out)
        for action in planned.actions:
            if isinstance(action, Removal):
                gone |= action.blocks
            else:
                edits.append(self._insertion(action.section, action.text))
        edits += (TextEdit(self._lines_of(*place), "") for place in sorted(gone))
        return edits

    def _lines_of(self, section: int, number: int) -> Span:
        """A block without the comments and blank lines behind it, which belong to what follows."""
        block = self.tree.sections[section].blocks[number]
        return Span(block.head.span.start, self._end(section, block))

    def _insertion(self, section: int, text: str) -> TextEdit:
        """Lines behind the last ones of a section that are no comment."""
        raw = self.tree.sections[section]
        head = cast("Leaf", raw.head)
        at = self._end(section, raw.blocks[-1]) if raw.blocks else max(leaf.span.end for leaf in (head, *raw.leaves))
        lacks_end = not self.source.unified.endswith("\n", 0, at)
        return TextEdit(Span(at, at), f"\n{text}" if lacks_end else text)

    def _end(self, section: int, block: RawBlock) -> int:
        declared = catalogue.block_class(self.tree.sections[section].name, block.name)

        def is_data(leaf: Leaf) -> bool:
            if leaf.kind is Kind.UNDECIDED:
                return declared is None or first_key(self.source.unified, leaf.span) in all_keys(declared)
            return leaf.kind not in (Kind.COMMENT, Kind.BLANK)

        return max(leaf.span.end for leaf in (block.head, *block.leaves) if leaf is block.head or is_data(leaf))
