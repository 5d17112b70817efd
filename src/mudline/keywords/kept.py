"""Keywords whose format is not public: what they are for, and which names in their lines are names of what."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum


class Names(Enum):
    """What the value of a `KEY=` names; the words are for a reader."""

    SET = "an element set"
    SETS = "one or more element sets"
    CURVE = "a force-embedment curve"
    FILE = "a file"
    DECK = "the deck before"


LINE_SETS: Mapping[str, Names] = {
    "LINE": Names.SET,
    "NAME": Names.SET,
    "SECTION": Names.SET,
    "ADDITIONAL": Names.SETS,
}
"""Settings of lines that make element sets: a line and each of its sections is one."""


@dataclass(frozen=True, slots=True)
class Kept:
    """A keyword that is known, and whose lines are passed through unchanged.

    `example` shows what its lines may look like, not its format. `certain` and `inferred` say what we know of it and
    what we conclude. `harvest` has the settings that give names; of a SET only the first value is a name. `labels` says
    that any text among its lines may be the label of a node. `makes` are the keywords of what it may define: a thing of
    these kinds that is missing may come from here. `sections_inferred` says that its section is not confirmed: in
    another one it is not reported.
    """

    names: tuple[str, ...]
    summary: str
    example: str
    certain: str
    inferred: str
    sections: tuple[str, ...] = ("MODEL",)
    sections_inferred: bool = False
    harvest: Mapping[str, Names] = field(default_factory=dict)
    labels: bool = False
    makes: tuple[str, ...] = ()
