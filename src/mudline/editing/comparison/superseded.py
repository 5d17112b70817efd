"""Decks with superseded and with newer seabed keywords: differences of spelling, and of meaning."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from enum import StrEnum
from pathlib import Path
from typing import NamedTuple

import numpy as np

from mudline.editing.comparison.comparing import (
    Followed,
    Values,
    compare,
    follow_differently,
    numbers_given,
    seabed_points,
    shown_points,
)
from mudline.editing.comparison.model import Difference, Pair, Side, Tolerance, plain
from mudline.language.deck.model import Deck
from mudline.language.deck.parameters import folded
from mudline.language.diagnostics import Diagnostic
from mudline.language.keywords.catalogue import is_superseded, supersedes
from mudline.model.contact.input import LawKind
from mudline.model.scene.deck_values import LARGEST_MOBILISATION
from mudline.model.scene.laws import ResistanceValues, SetLaw
from mudline.model.scene.model import Scene, resolve
from mudline.model.scene.representatives import representatives, shows_elements


class Status(StrEnum):
    """What became of a deck between two folders; the order is that of a summary."""

    CHANGED = "changed"
    ADDED = "added"
    REMOVED = "removed"
    EQUAL = "equal"
    FAILED = "failed"


class Comparison(NamedTuple):
    """The semantic differences of two decks, and the differences of spelling in superseded keywords.

    Of two folders these are those of all decks, and `decks` has each of them.
    """

    differences: list[Difference]
    spelling: list[Difference]
    decks: Sequence[ComparedDeck] = ()

    @property
    def equivalent(self) -> bool:
        """Whether both mean the same."""
        return not self.differences and all(one.status is Status.EQUAL for one in self.decks)


class ComparedDeck(NamedTuple):
    """A deck by its path below two folders, and what became of it; `before` and `after` are its files where it has two.

    `errors` say why it could not be compared, or `unread` why a file could not be read.
    """

    name: str
    status: Status
    before: str = ""
    after: str = ""
    comparison: Comparison = Comparison([], [])
    errors: Sequence[Diagnostic] = ()
    unread: OSError | None = None

    @property
    def why(self) -> str:
        """The first of the errors, in a line; "" without any."""
        if self.unread is not None:
            return f"{Path(self.unread.filename).as_posix()}: {(self.unread.strerror or str(self.unread)).lower()}"
        return next((f"{one.file}:{one.line}:{one.column}: {one.code} {one.message}" for one in self.errors), "")


def compare_decks(first: Deck, second: Deck, tolerance: float = 0.0, *, strict: bool = False) -> Comparison:
    """The differences of two decks; if `strict`, those of spelling count like the others.

    Raises DeckError for a deck that cannot be compared.
    """
    before, after = resolve(first), resolve(second)
    found = compare(before, after, tolerance)
    return Comparison(found, []) if strict else without_spelling(before, after, found, tolerance)


def without_spelling(before: Scene, after: Scene, found: Sequence[Difference], tolerance: float = 0.0) -> Comparison:
    """Replace differences of superseded and newer seabed keywords by semantic differences, element by element.

    `found` is what `compare` finds with the same tolerance. Decks that do not differ in the family of their keywords
    have no differences of spelling. Elements that a deck does not show are represented by some in every set.
    """
    if not (_rewritten(before, after) or _rewritten(after, before)):
        return Comparison(list(found), [])
    pair = Pair(Side(before), Side(after), Tolerance(tolerance))
    groups = _groups(pair)
    others: list[Difference] = []
    replaced: list[Difference] = []
    for one in found:
        (replaced if one.group in groups or _is_whole_curve(one, pair) else others).append(one)
    meant = list(_meaning(pair, groups))
    places = {one.where for one in meant}
    return Comparison([*others, *meant], [one for one in replaced if one.where not in places])


def _rewritten(old: Scene, new: Scene) -> bool:
    """Whether a deck has newer keywords where another has superseded ones."""
    before, after = ({keyword for keyword in scene.deck.keywords() if is_superseded(keyword)} for scene in (old, new))
    return after < before and any(law.family == "new" for law in new.laws.set_laws)


def _groups(pair: Pair) -> set[str]:
    """The groups of differences that the meaning of the elements and of the seabed replaces."""
    keywords = [side.scene.deck.keywords() for side in (pair.one, pair.other)]
    groups = {f"*{name}" for found in keywords for name in found if is_superseded(name) or supersedes(name)}
    groups |= {"laws of elements", "bed of elements", "seabed"}
    return groups - {"*SEABED PROFILE", "seabed"} if all("SEABED PROFILE" in found for found in keywords) else groups


def _is_whole_curve(one: Difference, pair: Pair) -> bool:
    """Whether a curve that only one deck has is for a set, or a set names it: then the elements are compared."""
    if one.kind == "changed" or not isinstance(one.before or one.after, list):
        return False
    side = pair.one if one.kind == "removed" else pair.other
    kind, _, name = one.where.partition("/")
    return kind == "curves of sets" or (kind == "curves" and folded(name) in side.scene.laws.referenced)


def _meaning(pair: Pair, groups: set[str]) -> Iterator[Difference]:
    """Differences of the laws of elements and of the seabed."""
    yield from _of_elements(pair)
    scenes = pair.one.scene, pair.other.scene
    if not all(map(shows_elements, scenes)):
        external, names = representatives(*scenes)
        one, other = (Side(resolve(scene.deck, external)) for scene in scenes)
        yield from _of_elements(replace(pair, one=one, other=other), names)
    if "seabed" in groups:
        yield from _seabed(pair)


def _of_elements(pair: Pair, names: Mapping[int, str] | None = None) -> Iterator[Difference]:
    fresh = replace(pair, said=set())
    yield from follow_differently("laws", _laws, fresh, names)
    yield from follow_differently("bed", _resistance, fresh, names)


def _laws(side: Side) -> Followed:
    laws = side.scene.laws
    entries = [_law(side.scene, law) for law in laws.set_laws]
    return Followed(entries, [law.where for law in laws.set_laws], laws.of_element)


def _law(scene: Scene, law: SetLaw) -> Values:
    """A law by its effect: the name of a curve does not count, nor the keyword that gives it."""
    match law.kind:
        case LawKind.CURVE if law.curve >= 0:
            return {"": "curve", "points": shown_points(scene.laws.curves[law.curve])}
        case LawKind.LINEAR:
            return {"": "linear", "stiffness": plain(law.stiffness)}
        case LawKind.NONE:
            return {}
    return {"": scene.law_name(law)}


def _resistance(side: Side) -> Followed:
    found = side.scene.resistance
    entries = [_values(values, side.scene.units) for values in found.values]
    return Followed(entries, found.places, found.of_element)


def _values(given: ResistanceValues, units: str) -> Values:
    """Values that have an effect: no coefficient, resistance or suction of 0, no default length."""
    default = LARGEST_MOBILISATION.get(units, np.nan)
    slips = np.array(given.friction) > 0.0
    bounded = slips & np.isnan(given.mobilisation) & (np.array(given.characteristic) != default)
    longitudinal, transverse = np.where(bounded, given.characteristic, np.nan).tolist()
    values = numbers_given(given._replace(characteristic=(longitudinal, transverse))._asdict())
    silent = ("longitudinal friction", "transverse friction", "lateral", "suction")
    return {name: value for name, value in values.items() if value != 0.0 or name not in silent}


def _seabed(pair: Pair) -> Iterator[Difference]:
    """The shape of the seabed, whichever keyword gives it."""
    old, new = pair.one.scene.seabed, pair.other.scene.seabed
    given = [("kind", old.kind.value, new.kind.value), ("slope", old.slope, new.slope)]
    given += [("direction", old.direction, new.direction), ("interpolation", old.interpolation, new.interpolation)]
    if old.missing or new.missing:
        given.append(("file", old.file, new.file))
    for name, one, other in given:
        if not pair.tolerance.values(one, other):
            yield pair.difference("seabed", f"seabed/{name}", (one, old.where), (other, new.where))
    yield from seabed_points(pair)
