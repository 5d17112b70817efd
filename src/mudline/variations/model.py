"""What a plan holds: cases of variations, and the decks that they make."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from mudline.diagnostics import Where
from mudline.short_repr import short_repr

MOST_DECKS = 100_000
"""Decks that one deck may describe; more are refused, as they are a mistake."""


@dataclass(frozen=True, slots=True)
class Removal:
    """Blocks that are left out, by section and block."""

    blocks: frozenset[tuple[int, int]]


@dataclass(frozen=True, slots=True)
class Addition:
    """Lines, with LF behind each, that are put at the end of a section."""

    section: int
    text: str


Action = Removal | Addition


@dataclass(frozen=True, slots=True)
class Cases:
    """A variation: names of parameters, a row of their values for each case, and what is done in every case."""

    name: str
    where: Where
    parameters: Sequence[str]
    rows: Sequence[Sequence[str]]
    actions: Sequence[Action]


@dataclass(frozen=True, slots=True)
class PlannedDeck:
    """A deck to write: its path with `/` in the output folder, and what it shows.

    `variations` are the names of those that made it, `values` its parameters as they will be written.
    """

    path: str
    description: str
    variations: Sequence[str]
    values: Mapping[str, str]
    actions: Sequence[Action] = field(default=(), repr=False)

    __repr__ = short_repr
