"""The parameters of a deck as a variation sees them: how their values are written, and where."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, cast

from mudline.codes import EXP001, REF013
from mudline.deck.model import Deck
from mudline.deck.parameters import Parameters, folded
from mudline.deck.reading import TextOrigin
from mudline.diagnostics import Problem, Span, Where
from mudline.keywords.model import Block
from mudline.keywords.text import shown, suggestion
from mudline.keywords.values import Equation
from mudline.syntax.fields import split
from mudline.syntax.rows import read_number
from mudline.variations.names import unquoted

if TYPE_CHECKING:
    from mudline.keywords.library.parameters import Parameter
    from mudline.keywords.library.parameters import Parameters as Block_

Values = Mapping[str, str]
"""Values as they are written in `*PARAMETERS`, by the name of the parameter there."""


@dataclass(frozen=True, slots=True)
class Target:
    """A parameter: its name and the text of its value, both as written, and the place of the value."""

    name: str
    text: str
    span: Span


class Targets:
    """The parameters of a deck that was read from text; of several with one name the last, which holds."""

    def __init__(self, deck: Deck) -> None:
        self.deck = deck
        self.parameters = Parameters(deck)
        self._targets: dict[str, Target] = {}
        origin = cast("TextOrigin", deck.origin)
        text = origin.source.text
        for key, definition in self.parameters.definitions.items():
            where = definition.where
            block = cast("Block_", deck.sections[where.section].blocks[where.block])
            name = block.parameters[cast("int", where.path[1])].name
            if folded(name) == key:
                span = origin.read[where.section, where.block].places.find(where.path)
                self._targets[key] = Target(name, text[slice(*span)], span)

    def target(self, name: str) -> Target:
        """A parameter that is known to be there."""
        return self._targets[folded(name)]

    def fault(self, name: str, where: Where) -> Problem | None:
        """Why a parameter cannot vary."""
        if folded(name) in self._targets:
            return None
        if problem := self.undefined(name, where):
            return problem
        message = f"{shown(name)} is an item of a list: give it a line of its own in *PARAMETERS, so that it can vary"
        return Problem(EXP001, message, None, None, where)

    def undefined(self, name: str, where: Where) -> Problem | None:
        """That a parameter is not there."""
        known = [definition.name for definition in self.parameters.definitions.values()]
        if folded(name) in self.parameters.definitions:
            return None
        message = f"parameter {shown(name)} is not defined{suggestion(name, known)}: define it in *PARAMETERS"
        return Problem(REF013, message, None, None, where)

    def in_a_name(self, name: str, values: Values) -> str | None:
        """A parameter's value for the name of a file: as written, without quotes; None where an equation has none."""
        key = folded(name)
        given = next((text for other, text in values.items() if folded(other) == key), None)
        if given is None and key in self._targets:
            given = self._targets[key].text
        if given is not None and Equation.match(given) is None:
            return unquoted(given)
        found = Parameters(with_values(self.deck, values)).values.get(key)
        if isinstance(found, float) and found.is_integer() and abs(found) < 1e15:
            return str(int(found))
        return None if found is None else str(found)


def with_values(deck: Deck, values: Values) -> Deck:
    """The deck with other values of its parameters, for its equations only: its text is not that of the new one."""
    by_key = {folded(name): text for name, text in values.items()}

    def changed(parameter: Parameter) -> Parameter:
        text = by_key.get(folded(parameter.name))
        return parameter if text is None else parameter.model_copy(update={"value": text})

    sections = list(deck.sections)
    for where, block in deck.blocks("PARAMETERS", "PREPROCESSOR"):
        section = sections[where.section]
        blocks = list(section.blocks)
        blocks[where.block] = cast("Block", block).model_copy(
            update={"parameters": [changed(parameter) for parameter in cast("Block_", block).parameters]}
        )
        sections[where.section] = replace(section, blocks=blocks)
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
