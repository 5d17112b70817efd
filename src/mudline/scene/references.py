"""Names of sets and curves that fields give, against those of the deck; which fields do is declared with them."""

from __future__ import annotations

from collections.abc import Iterator

from mudline.deck.model import Deck
from mudline.deck.parameters import folded
from mudline.diagnostics import Where
from mudline.keywords.kept import Names
from mudline.keywords.model import Block, names_given
from mudline.scene.context import Context
from mudline.scene.laws import LawTable
from mudline.scene.sets import Sets


def check_references(context: Context, sets: Sets, laws: LawTable, *, with_soil: bool) -> None:
    """Every name of a set or a curve; those of soil springs on demand."""
    for block, where, name in given_names(context.deck, Names.SET):
        if with_soil or not block.facts.soil_springs:
            sets.check(name, where)
    laws.referenced.update(folded(name) for _, _, name in given_names(context.deck, Names.CURVE))


def given_names(deck: Deck, what: Names) -> Iterator[tuple[type[Block], Where, str]]:
    """The names of a kind that the fields of a deck give: the class of their block, their place and the name."""
    for i, section in enumerate(deck.sections):
        for j, block in enumerate(section.blocks):
            if isinstance(block, Block):
                for path, name in names_given(block, what):
                    yield type(block), Where(i, j, path), name
