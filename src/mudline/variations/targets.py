"""The parameters of a deck as a variation sees them: how their values are written, and where."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, cast

from mudline.codes.references import REF013
from mudline.deck.model import Deck
from mudline.deck.parameters import Parameters, folded, list_items
from mudline.deck.reading import TextOrigin
from mudline.diagnostics import Problem, Span, Where
from mudline.keywords.model import Block
from mudline.keywords.text import shown, suggestion
from mudline.keywords.values import Equation
from mudline.spelling import Effort
from mudline.syntax.fields import split
from mudline.syntax.rows import read_number
from mudline.variations.names import unquoted

if TYPE_CHECKING:
    from mudline.keywords.library.parameters import Parameters as Block_

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
        """A value as it is written in the place of the old one, or None when it cannot stand there."""
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
        """A parameter that is known to be there."""
        return self._targets[folded(name)]

    def undefined(self, name: str, where: Where) -> Problem | None:
        """That a parameter is not there."""
        if folded(name) in self._targets:
            return None
        hint = suggestion(name, (target.name for target in self._targets.values()), self._effort)
        message = f"parameter {shown(name)} is not defined{hint}: define it in *PARAMETERS"
        return Problem(REF013, message, None, None, where)

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
    """The deck with other values of its parameters, for its equations only: its text is not that of the new one.

    They are defined once more behind all others, as the last definition of a parameter holds.
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
    """A value as a field of `*PARAMETERS`, a text with blanks or commas in quotes; None when it cannot stand there."""
    if read_number(text) is not None or Equation.match(text):
        return text
    if not text:
        return None
    fields, problems = split(text, Span(0, len(text)))
    alone = len(fields) == 1 and not problems and fields[0].text == text
    if alone and (unquoted(text) != text or not (set(text) & set(' \t"') or text[0] in "/=")):
        return text
    return None if '"' in text else f'"{text}"'
