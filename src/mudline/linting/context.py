"""What a rule sees."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from mudline.deck.model import Deck
from mudline.deck.reading import TextOrigin
from mudline.diagnostics import Code, Problem
from mudline.linting.odd_curves import odd_curves
from mudline.scene.build import resolve
from mudline.scene.force_curves import SceneCurve
from mudline.scene.model import Scene


@dataclass
class LintContext:
    """A deck as it is written (equations and all) and its scene (evaluated and resolved, as far as that goes).

    `dialect` is the deck language that the deck must keep to: "mudline", or "flexcom" without extension keywords.
    """

    deck: Deck
    dialect: str = "mudline"

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
        for problem in [*self.deck.problems, *self.scene.problems]:
            told.setdefault(problem.code.code, []).append(problem)
        return told

    def told(self, code: Code) -> Iterator[Problem]:
        """What reading and resolving the deck noticed under a code."""
        yield from self._told.get(code.code, ())
