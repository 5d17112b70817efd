"""What is known of a keyword besides its lines: facts, and what keywords of no public format name."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum
from typing import Literal


@dataclass(frozen=True, slots=True)
class Successor:
    """A keyword that supersedes another one; with `key`, by that setting."""

    keyword: str
    key: str = ""

    def __str__(self) -> str:
        return f"{self.key}= of *{self.keyword}" if self.key else f"*{self.keyword}"


@dataclass(frozen=True, slots=True)
class Facts:
    """Facts about a keyword.

    Which keyword it is: `superseded_by` newer ones, of which each `supersedes` older ones; an `extension` is mudline's
    own; `plans_decks` says that its lines are about decks to be made, which do not have it. In the sections `passes_in`
    a keyword of its name passes through.

    What it does: `defines` is what its records define by number or name; `makes` are the keywords of what things
    outside the deck, which its lines are about, may define. With `later_wins` an element follows the last record whose
    SET= holds it, and that record as a whole. `carried` are the fields that a block has from the block before it, where
    it does not give them. `seabed_type` is the type of seabed that a legacy surface is. `soil_springs` hold elements in
    the soil. What is computed from it is said under the heading `computed_in` of the page on the contact evaluator.
    """

    superseded_by: tuple[Successor, ...] = ()
    supersedes: bool = False
    extension: bool = False
    plans_decks: bool = False
    passes_in: tuple[str, ...] = ()
    defines: Literal["", "nodes", "elements", "sets", "curves", "parameters"] = ""
    makes: tuple[str, ...] = ()
    later_wins: bool = False
    carried: tuple[str, ...] = ()
    seabed_type: Literal["", "RIGID", "ELASTIC"] = ""
    soil_springs: bool = False
    computed_in: str = ""


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
    what we conclude. `name_settings` has the settings that give names; of a SET only the first value is a name.
    `labels` says that any text among its lines may be the label of a node. `makes` are the keywords of what it may
    define: a thing of these kinds that is missing may come from here. `sections_inferred` says that its section is not
    confirmed: in another one it is not reported.
    """

    names: tuple[str, ...]
    summary: str
    example: str
    certain: str
    inferred: str
    sections: tuple[str, ...] = ("MODEL",)
    sections_inferred: bool = False
    name_settings: Mapping[str, Names] = field(default_factory=dict)
    labels: bool = False
    makes: tuple[str, ...] = ()
