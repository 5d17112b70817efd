"""What a rule sees: a deck, its scene, and the curves that a rule may have something to say about."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import chain, islice, pairwise
from typing import TypeVar, cast

from mudline.deck.model import Deck
from mudline.deck.reading import TextOrigin
from mudline.diagnostics import MOST_REPORTED, Blocks, Code, Problem
from mudline.scene.force_curves import SceneCurve
from mudline.scene.laws import LawTable
from mudline.scene.model import Scene, resolve
from mudline.variations.names import misspelt_keywords, misspelt_sections, undefined_parameters, undefined_variations

T = TypeVar("T")

MOST_POINTS = 64
"""Points of a curve that are looked at one by one; longer curves are left to the rules."""

LARGEST_RATIO = 5.0
"""Diameters of embedment; a larger ratio is a length or a percentage."""
STEEPEST = 100.0
"""Ratio of two slopes of a curve."""


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
    def _by_code(self) -> dict[str, list[Problem]]:
        found: dict[str, list[Problem]] = {}
        for problem in chain(self.scene.findings, _of_variations(self.deck)):
            found.setdefault(problem.code.code, []).append(problem)
        return found

    def once(self, make: Callable[[LintContext], T]) -> T:
        """What a function makes of this deck, made once for all rules that ask."""
        if make not in self._made:
            self._made[make] = make(self)
        return cast("T", self._made[make])

    def problems_of(self, code: Code) -> Iterator[Problem]:
        """What reading and resolving the deck, and the checks of its scene, report under a code."""
        yield from self._by_code.get(code.code, ())


def _of_variations(deck: Deck) -> Iterator[Problem]:
    """Undefined names in variations: they are faults of the varied decks, and not of this one."""
    for find in (undefined_parameters, undefined_variations, misspelt_keywords, misspelt_sections):
        for problem in islice(find(deck), MOST_REPORTED):
            yield replace(problem, blocks=Blocks.NEVER)


def odd_curves(laws: LawTable) -> list[tuple[int, SceneCurve]]:
    """The curves that are not as they should be, with their index in the table of laws.

    As they should be are curves whose points were all read, begin at (0, 0) and rise in order, with slopes that differ
    by a factor of 100 at most, to a ratio of 5 at most.
    """
    return [(number, entry) for number, entry in enumerate(laws.curves) if not _ordinary(entry)]


def _ordinary(entry: SceneCurve) -> bool:
    if not entry.usable or len(entry.points) > MOST_POINTS:
        return False
    points = entry.points.tolist()
    if points[0] != [0.0, 0.0] or points[-1][0] > LARGEST_RATIO:
        return False
    steps = [(after[0] - before[0], after[1] - before[1]) for before, after in pairwise(points)]
    if any(width <= 0.0 or rise <= 0.0 for width, rise in steps):
        return False
    slopes = [rise / width for width, rise in steps]
    return bool(max(slopes) <= STEEPEST * min(slopes))
