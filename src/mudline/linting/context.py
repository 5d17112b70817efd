"""What a rule sees."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import chain, islice
from typing import TypeVar, cast

from mudline.deck.model import Deck
from mudline.deck.reading import TextOrigin
from mudline.diagnostics import Blocks, Code, Problem
from mudline.linting.odd_curves import odd_curves
from mudline.scene.context import MOST_REPORTED
from mudline.scene.force_curves import SceneCurve
from mudline.scene.model import Scene, resolve
from mudline.variations.names import misspelt_keywords, misspelt_sections, undefined_parameters, undefined_variations

T = TypeVar("T")


@dataclass
class LintContext:
    """A deck as it is written (equations and all) and its scene (evaluated and resolved, as far as that goes).

    `dialect` is the deck language that the deck must keep to: "mudline", or "flexcom" without extension keywords.
    """

    deck: Deck
    dialect: str = "mudline"
    _made: dict[object, object] = field(default_factory=dict, repr=False)

    @property
    def text(self) -> TextOrigin | None:
        """Tree, source and places of a deck that was read from text; None for one in JSON or YAML."""
        return self.deck.origin if isinstance(self.deck.origin, TextOrigin) else None

    @cached_property
    def scene(self) -> Scene:
        """The scene of the deck."""
        return resolve(self.deck)

    @cached_property
    def odd_curves(self) -> list[tuple[int, SceneCurve]]:
        """The curves that rules about the shape of a curve have to look at, with their index in the table of laws."""
        return odd_curves(self.scene.laws)

    @cached_property
    def _told(self) -> dict[str, list[Problem]]:
        told: dict[str, list[Problem]] = {}
        for problem in chain(self.scene.findings, _of_variations(self.deck)):
            told.setdefault(problem.code.code, []).append(problem)
        return told

    def once(self, make: Callable[[LintContext], T]) -> T:
        """What a function makes of this deck, made once for all rules that ask."""
        if make not in self._made:
            self._made[make] = make(self)
        return cast("T", self._made[make])

    def told(self, code: Code) -> Iterator[Problem]:
        """What reading and resolving the deck, and the checks of its scene, noticed under a code."""
        yield from self._told.get(code.code, ())


def _of_variations(deck: Deck) -> Iterator[Problem]:
    """Names in variations that lead nowhere: they spoil the decks that are made, and not this one."""
    for find in (undefined_parameters, undefined_variations, misspelt_keywords, misspelt_sections):
        for problem in islice(find(deck), MOST_REPORTED):
            yield replace(problem, blocks=Blocks.NEVER)
