"""The text of each new deck: that of the source with other parameter values, and blocks added or removed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, cast

from mudline.deck.loading import dump, form_of
from mudline.deck.model import Deck
from mudline.deck.parameters import Parameters, folded, list_items
from mudline.deck.reading import TextOrigin, read_source
from mudline.diagnostics import Problem, Span, Where
from mudline.keywords import catalogue
from mudline.keywords.model import Block
from mudline.keywords.reader import all_keys
from mudline.keywords.values import Equation
from mudline.short_repr import short_repr
from mudline.spelling import Effort
from mudline.syntax.edits import TextEdit, edited_bytes
from mudline.syntax.fields import first_key, split
from mudline.syntax.rows import read_number
from mudline.syntax.source import Source
from mudline.syntax.tree import Kind, Leaf, RawBlock
from mudline.variations.names import undefined_parameter, unquoted

if TYPE_CHECKING:
    from mudline.keywords.library.parameters import Parameters as Block_

MOST_DECKS = 100_000
"""Decks that one deck may describe; more are refused, as they are a mistake."""


@dataclass(frozen=True, slots=True)
class Removal:
    """Blocks to leave out, by section and block."""

    blocks: frozenset[tuple[int, int]]


@dataclass(frozen=True, slots=True)
class Addition:
    """Lines to put at the end of a section, each with a LF."""

    section: int
    text: str


Action = Removal | Addition


@dataclass(frozen=True, slots=True)
class PlannedDeck:
    """A deck to write: its path with `/` in the output folder, and its description.

    `variations` are the names of those combined in it, `values` its varied parameters as they will be written.
    """

    path: str
    description: str
    variations: Sequence[str]
    values: Mapping[str, str]
    actions: Sequence[Action] = field(default=(), repr=False)

    __repr__ = short_repr


Values = Mapping[str, str]
"""Values as they are written in `*PARAMETERS`, by the name of the parameter there."""


@dataclass(frozen=True, slots=True)
class Target:
    """A parameter: its name and the text of its value, both as written, and the place of the value."""

    name: str
    text: str
    span: Span
    in_list: bool = False

    def field(self, value: str) -> str | None:
        """A value as it is written in the place of the old one, or None when it cannot be written there."""
        field = parameter_field(value)
        bare = field is not None and field == unquoted(field) and Equation.match(field) is None
        if not self.in_list or not bare or read_number(value) is not None:
            return field
        return f'"{field}"'  # a colon or a slash would mean something else in a list


class Targets:
    """The parameters of a deck that was read from text; of several with one name the last, which holds."""

    def __init__(self, deck: Deck) -> None:
        self.deck = deck
        self.parameters = Parameters(deck)
        self._targets: dict[str, Target] = {}
        self._effort = Effort()
        for where, block in deck.blocks("PARAMETERS", "PREPROCESSOR"):
            for index, parameter in enumerate(cast("Block_", block).parameters):
                place = where._replace(path=("parameters", index, "value"))
                self._targets |= {folded(target.name): target for target in self._written(parameter.name, place)}

    def _written(self, name: str, where: Where) -> Iterator[Target]:
        """The parameters that a line of `*PARAMETERS` defines."""
        origin = cast("TextOrigin", self.deck.origin)
        span = origin.read[where.section, where.block].places.find(where.path)
        text = origin.source.text[slice(*span)]
        if not text.startswith("/"):
            yield Target(name, text, span)
            return
        for item in list_items(name, text)[0]:
            start = span.start + item.start
            yield Target(item.name, item.value, Span(start, start + len(item.value)), in_list=True)

    def target(self, name: str) -> Target:
        """A parameter that is known to exist."""
        return self._targets[folded(name)]

    def undefined(self, name: str, where: Where) -> Problem | None:
        """The problem of a name that is not a parameter, else None."""
        if folded(name) in self._targets:
            return None
        return undefined_parameter(name, (target.name for target in self._targets.values()), self._effort, where)

    def in_a_name(self, name: str, values: Values) -> str | None:
        """A parameter's value for the name of a file: as written, without quotes; None where an equation has none."""
        key = folded(name)
        given = next((text for other, text in values.items() if folded(other) == key), self._targets[key].text)
        if Equation.match(given) is None:
            return unquoted(given)
        found = Parameters(with_values(self.deck, values)).values.get(key)
        if isinstance(found, float) and found.is_integer() and abs(found) < 1e15:
            return str(int(found))
        return None if found is None else str(found)


def with_values(deck: Deck, values: Values) -> Deck:
    """The deck with other parameter values, for its equations only: its text is not that of the new one.

    They are defined again after all others, as the last definition of a parameter applies.
    """
    where, block = [found for found in deck.blocks("PARAMETERS", "PREPROCESSOR") if found[1].parameters][-1]
    known = cast("Block_", block).parameters
    more = [known[-1].model_copy(update={"name": name, "value": text}) for name, text in values.items()]
    sections = list(deck.sections)
    blocks = list(sections[where.section].blocks)
    blocks[where.block] = cast("Block", block).model_copy(update={"parameters": [*known, *more]})
    sections[where.section] = replace(sections[where.section], blocks=blocks)
    return replace(deck, sections=sections)


def parameter_field(text: str) -> str | None:
    """A value as a field of `*PARAMETERS`, a text with blanks or commas in quotes; None when it cannot be written."""
    if read_number(text) is not None or Equation.match(text):
        return text
    if not text:
        return None
    fields, problems = split(text, Span(0, len(text)))
    alone = len(fields) == 1 and not problems and fields[0].text == text
    if alone and (unquoted(text) != text or not (set(text) & set(' \t"') or text[0] in "/=")):
        return text
    return None if '"' in text else f'"{text}"'


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
        """A new deck, in the form of its path's suffix."""
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
        """Lines inserted after the last ones of a section that are not a comment."""
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


@dataclass(frozen=True, slots=True)
class ExpansionPlan:
    """The decks in the order of `*COMBINATIONS`, and the rewriter that makes their texts.

    `source` is the name of the file that they come from, `notes` are remarks for a reader. `companions` are files
    beside the source that the new decks name too.
    """

    source: str
    decks: Sequence[PlannedDeck]
    rewriter: Rewriter
    notes: Sequence[str] = ()
    companions: Sequence[str] = ()

    __repr__ = short_repr

    def content(self, planned: PlannedDeck) -> bytes:
        """The content of a planned deck."""
        return self.rewriter.content(planned)
