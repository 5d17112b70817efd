"""What is known of a keyword besides its lines; whoever needs such a fact asks the keyword's class for it."""

from __future__ import annotations

from dataclasses import dataclass
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
