"""One of the two decks that are compared."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import cast

from mudline.codes.fields import SYN002, SYN006, SYN017
from mudline.codes.references import REF013, REF014
from mudline.deck.model import Nowhere
from mudline.deck.parameters import Parameters
from mudline.deck.reading import TextOrigin
from mudline.diagnostics import Blocks, DeckError, Problem, Where
from mudline.keywords.model import Block
from mudline.scene.model import Scene

_NO_VALUE = (SYN002, SYN006, SYN017, REF013, REF014)

_MOST_STEPS = 1_000_000
"""Rows that may be passed to find lines in a document: a row is found by counting from the first one of its table."""

_FEW = 100


@dataclass
class Side:
    """A resolved deck, its parameters, and the lines of its file."""

    scene: Scene
    names: dict[str, str] = field(default_factory=dict)
    """Names as the deck writes them, by their folded form."""
    _steps: int = _MOST_STEPS

    def path(self, path: str) -> str:
        """A path of folded names with the names as the deck writes them."""
        return "/".join(self.names.get(step, step) for step in path.split("/"))

    @cached_property
    def parameters(self) -> Parameters:
        """The parameters, evaluated."""
        return Parameters(self.scene.deck)

    def comparable(self, block: Block, where: Where) -> Block:
        """A block, or that block as written where one of its equations has no value: then their texts compare."""
        if (where.section, where.block) not in self._valueless:
            return block
        return cast("Block", self.scene.context.as_written(where))

    @cached_property
    def _valueless(self) -> set[tuple[int, int]]:
        """Section and block of what was noticed of equations."""
        places = (problem.where for problem in self.scene.noticed if problem.code in _NO_VALUE)
        return {(where.section, where.block) for where in places if where is not None}

    def line(self, where: Where | None) -> int | None:
        """The line of a place; None for what stands in no line of this file, and once too many were sought."""
        deck = self.scene.deck
        if where is None or not 0 <= where.section < len(deck.own_sections) or isinstance(deck.origin, Nowhere):
            return None
        steps = 0 if isinstance(deck.origin, TextOrigin) else sum(step for step in where.path if isinstance(step, int))
        if steps > max(self._steps, _FEW):
            return None
        self._steps -= steps
        return deck.origin.place(Problem(SYN002, "", where=where)).line

    def require(self) -> None:
        """Raise DeckError for what could not be read, and for equations without a value."""
        self.scene.deck.require()
        unknown = [
            problem
            for problem in self.scene.noticed
            if problem.code in _NO_VALUE and problem.blocking is not Blocks.NEVER
        ]
        if unknown:
            raise DeckError(self.scene.deck.diagnose(unknown))
