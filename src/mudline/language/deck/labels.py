"""The labels that `*LABEL` gives to nodes and elements."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from mudline.language.codes.references import REF007
from mudline.language.deck.model import Deck
from mudline.language.deck.parameters import Parameters, bare, folded
from mudline.language.diagnostics import Blocks, Problem
from mudline.language.keywords.text import shown
from mudline.language.keywords.values import Names

if TYPE_CHECKING:
    from mudline.language.keywords.library.mesh import Labels

LabelNumbers = dict[tuple[Names | None, str], int]
"""Numbers of nodes and elements by what they are of and their folded label."""


def labels_of(deck: Deck, parameters: Parameters, problems: list[Problem]) -> LabelNumbers:
    """The labels that `*LABEL` gives; one that is given twice keeps its first number, and is a problem."""
    found: LabelNumbers = {}
    own = len(deck.own_sections)
    for where, block in deck.blocks("LABEL"):
        kind = Names.NODE
        for index, line in enumerate(cast("Labels", block).labels):
            if line.thing in Names.__members__:
                kind = Names[str(line.thing)]
            number = parameters.number(getattr(line.element if kind is Names.ELEMENT else line.node, "number", None))
            if number is None or not number.is_integer() or not line.label:
                continue
            name = folded(bare(line.label))
            if found.setdefault((kind, name), int(number)) != int(number) and where.section < own:
                thing = kind.name.lower()
                message = (
                    f"label {shown(line.label)} is that of {thing} {found[kind, name]} and of {thing} {int(number)}: "
                    "give one of them another label"
                )
                place = where.inside("labels", index, "label")
                problems.append(Problem(REF007, message, where=place, blocks=Blocks.NEVER))
    return found


def labels_given(deck: Deck, kind: Names) -> dict[str, str]:
    """The labels of nodes or of elements that `*LABEL` gives, as written, by their folded form."""
    found: dict[str, str] = {}
    for _, block in deck.blocks("LABEL"):
        thing: str | None = Names.NODE.name
        for line in cast("Labels", block).labels:
            thing = line.thing or thing
            if thing == kind.name and line.label:
                found.setdefault(folded(bare(line.label)), bare(line.label))
    return found


def all_labels_read(deck: Deck) -> bool:
    """Return False if a line of `*LABEL` could not be read, which may give any label."""
    lines = (line for _, block in deck.blocks("LABEL") for line in cast("Labels", block).labels)
    return all(line.label for line in lines)
