"""Two decks, or the decks of two folders, compared: differences of meaning, and of spelling in superseded keywords."""

from __future__ import annotations

import errno
import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from enum import StrEnum
from functools import partial
from itertools import combinations, pairwise
from pathlib import Path
from typing import NamedTuple

import numpy as np

from mudline.basics.files import reason
from mudline.editing.comparison.comparing import (
    Values,
    compare,
    follow_differently,
    law_values,
    laws_followed,
    numbers_given,
    resistance_followed,
    seabed_points,
    shown_points,
)
from mudline.editing.comparison.model import Allowance, Difference, Pair, Side
from mudline.language.deck.loading import load_path
from mudline.language.deck.model import Deck
from mudline.language.deck.parameters import folded
from mudline.language.deck.searching import Search, is_in_any_form
from mudline.language.diagnostics import DeckError, Diagnostic
from mudline.language.keywords.catalogue import is_superseded, supersedes
from mudline.model.contact.input import LawKind
from mudline.model.scene.csv_file import ExternalElements
from mudline.model.scene.deck_values import LARGEST_MOBILISATION
from mudline.model.scene.laws import ResistanceValues, SetLaw
from mudline.model.scene.model import Scene, resolve


class DeckStatus(StrEnum):
    """Result of the comparison of a deck in two folders, in the order of a summary."""

    CHANGED = "changed"
    ADDED = "added"
    REMOVED = "removed"
    EQUAL = "equal"
    FAILED = "failed"


class Comparison(NamedTuple):
    """The semantic differences of two decks, and the differences of spelling in superseded keywords.

    For two folders these are the differences of all decks, and `decks` has the result of each deck.
    """

    differences: list[Difference]
    spelling: list[Difference]
    decks: Sequence[ComparedDeck] = ()

    @property
    def equivalent(self) -> bool:
        """True if both mean the same."""
        return not self.differences and all(deck.status is DeckStatus.EQUAL for deck in self.decks)


class DeckPair(NamedTuple):
    """The decks with the same path below two folders.

    Attributes:
        name: path of the decks below both folders.
        before: file of the first deck; "" if missing.
        after: file of the second deck; "" if missing.
        unread: reason why `name`, a path in one of the folders, cannot be searched for decks.
    """

    name: str
    before: str = ""
    after: str = ""
    unread: OSError | None = None


class ComparedDeck(NamedTuple):
    """Result of the comparison of a deck in two folders.

    Attributes:
        name: path of the deck below both folders.
        status: result of the comparison.
        before: file of the first deck; "" if missing.
        after: file of the second deck; "" if missing.
        comparison: the differences.
        errors: reasons why the decks could not be compared.
        unread: reason why a file could not be read.
        crash: fault of the program itself, which the command reports; "" for none.
    """

    name: str
    status: DeckStatus
    before: str = ""
    after: str = ""
    comparison: Comparison = Comparison([], [])
    errors: Sequence[Diagnostic] = ()
    unread: OSError | None = None
    crash: str = ""

    @property
    def why(self) -> str:
        """The first error in one line; "" without errors."""
        if self.unread is not None:
            return f"{Path(self.unread.filename).as_posix()}: {reason(self.unread)}"
        return str(self.errors[0]) if self.errors else self.crash


def compare_decks(first: Deck, second: Deck, tolerance: float = 0.0, *, strict: bool = False) -> Comparison:
    """Return the differences of two decks; if `strict`, differences of spelling count as differences.

    Raises DeckError for a deck that cannot be compared.
    """
    before, after = resolve(first), resolve(second)
    differences = compare(before, after, tolerance)
    return Comparison(differences, []) if strict else without_spelling(before, after, differences, tolerance)


def paired(before: str, after: str, takes: Callable[..., bool], *, gitignore: bool) -> list[DeckPair]:
    """Return each relative path of a deck below one of two folders, in sorted order; what cannot be searched is first.

    `takes` is that of a configuration. Raises FileNotFoundError for folders without decks.
    """
    searches = Search(before, gitignore), Search(after, gitignore)
    taken = partial(takes, wanted=is_in_any_form)
    old, new = ({name: Path(path).as_posix() for name, path in search.files(taken)} for search in searches)
    unreadable = [error for search in searches for error in search.unreadable]
    pairs = [DeckPair(str(error.filename).replace(os.sep, "/"), unread=error) for error in unreadable]
    pairs += [DeckPair(name, old.get(name, ""), new.get(name, "")) for name in sorted({*old, *new})]
    if not pairs:
        raise FileNotFoundError(errno.ENOENT, "no deck in these folders", f"{before} and {after}")
    return pairs


def compare_pair(
    pair: DeckPair,
    tolerance: float,
    strict: bool,  # noqa: FBT001 - other processes get arguments by place
    units: str | None,
) -> ComparedDeck:
    """Return the result of the comparison of two decks of folders, read in `units` if given. Runs in any process.

    Decks that cannot be read or have errors have the status "failed".
    """
    failed = partial(ComparedDeck, pair.name, DeckStatus.FAILED)
    if pair.unread is not None:
        return failed(unread=pair.unread)
    if not (pair.before and pair.after):
        return ComparedDeck(pair.name, DeckStatus.REMOVED if pair.before else DeckStatus.ADDED)
    files = pair.before, pair.after
    try:
        first, second = (load_path(Path(file), units=units) for file in files)
        compared = compare_decks(first, second, tolerance, strict=strict)
    except DeckError as error:
        return failed(*files, errors=error.diagnostics)
    except OSError as error:
        return failed(*files, unread=error)
    status = DeckStatus.CHANGED if compared.differences else DeckStatus.EQUAL
    return ComparedDeck(pair.name, status, *files, compared)


# -------------------------------------------------------------------------------------------------- superseded keywords


def without_spelling(before: Scene, after: Scene, found: Sequence[Difference], tolerance: float = 0.0) -> Comparison:
    """Replace differences of superseded and newer seabed keywords by semantic differences, element by element.

    `found` are the differences of `compare` with the same tolerance. Decks with the same family of keywords have no
    differences of spelling. Elements that a deck does not list are represented by elements in every set.
    """
    if not (_rewritten(before, after) or _rewritten(after, before)):
        return Comparison(list(found), [])
    pair = Pair(Side(before), Side(after), Allowance(tolerance))
    groups = _groups(pair)
    others: list[Difference] = []
    replaced: list[Difference] = []
    for difference in found:
        (replaced if difference.group in groups or _is_whole_curve(difference, pair) else others).append(difference)
    semantic = list(_meaning(pair, groups))
    places = {difference.where for difference in semantic}
    return Comparison([*others, *semantic], [difference for difference in replaced if difference.where not in places])


def _rewritten(old: Scene, new: Scene) -> bool:
    """Return True if the new deck lacks superseded keywords of the old deck and has newer seabed keywords."""
    before, after = ({keyword for keyword in scene.deck.keywords() if is_superseded(keyword)} for scene in (old, new))
    return after < before and any(law.family == "new" for law in new.laws.set_laws)


def _groups(pair: Pair) -> set[str]:
    """Return the groups of differences that are replaced by semantic differences of elements and seabed."""
    keywords = [side.scene.deck.keywords() for side in (pair.before, pair.after)]
    groups = {f"*{name}" for names in keywords for name in names if is_superseded(name) or supersedes(name)}
    groups |= {"laws of elements", "bed of elements", "seabed"}
    return groups - {"*SEABED PROFILE", "seabed"} if all("SEABED PROFILE" in names for names in keywords) else groups


def _is_whole_curve(difference: Difference, pair: Pair) -> bool:
    """Return True for a curve in one deck only that is for a set or named by a set: its elements are compared."""
    if difference.kind == "changed" or not isinstance(difference.before or difference.after, list):
        return False
    side = pair.before if difference.kind == "removed" else pair.after
    kind, _, name = difference.where.partition("/")
    return kind == "curves of sets" or (kind == "curves" and folded(name) in side.scene.referenced)


def _meaning(pair: Pair, groups: set[str]) -> Iterator[Difference]:
    """Yield the differences of the laws of elements and of the seabed."""
    yield from _of_elements(pair)
    scenes = pair.before.scene, pair.after.scene
    if not all(scene.shows_elements for scene in scenes):
        external, names = representatives(*scenes)
        first, second = (Side(resolve(scene.deck, external)) for scene in scenes)
        yield from _of_elements(replace(pair, before=first, after=second), names)
    if "seabed" in groups:
        yield from _seabed(pair)


def _of_elements(pair: Pair, names: Mapping[int, str] | None = None) -> Iterator[Difference]:
    fresh = replace(pair, reported=set())
    yield from follow_differently("laws", partial(laws_followed, describe=_law), fresh, names)
    yield from follow_differently("bed", partial(resistance_followed, describe=_values), fresh, names)


def _law(scene: Scene, law: SetLaw) -> Values:
    """Return a law by its effect: neither the name of a curve nor the keyword counts."""
    if law.kind is LawKind.CURVE and law.curve >= 0:
        return {"": "curve", "points": shown_points(scene.laws.curves[law.curve])}
    return law_values(scene, law)


def _values(given: ResistanceValues, units: str) -> Values:
    """Return the values that have an effect: no coefficient, resistance or suction of 0, no default length."""
    default = LARGEST_MOBILISATION.get(units, np.nan)
    slips = np.array(given.friction) > 0.0
    bounded = slips & np.isnan(given.mobilisation) & (np.array(given.characteristic) != default)
    longitudinal, transverse = np.where(bounded, given.characteristic, np.nan).tolist()
    values = numbers_given(given._replace(characteristic=(longitudinal, transverse))._asdict())
    silent = ("longitudinal friction", "transverse friction", "lateral", "suction")
    return {name: value for name, value in values.items() if value != 0.0 or name not in silent}


def _seabed(pair: Pair) -> Iterator[Difference]:
    """Yield the differences of the shape of the seabed, from any keyword."""
    old, new = pair.before.scene.seabed, pair.after.scene.seabed
    names = ["slope", "direction", "interpolation", *(["file"] if old.missing or new.missing else [])]
    given = [(name, getattr(old, name), getattr(new, name)) for name in names]
    for name, before, after in [("kind", old.kind.value, new.kind.value), *given]:
        if not pair.tolerance.values(before, after):
            yield pair.difference("seabed", f"seabed/{name}", (before, old.where), (after, new.where))
    yield from seabed_points(pair)


# -------------------------------------------------------------------------------- elements that a deck does not show

_ALL_PAIRS = 40
_DIAMETERS = (0.2731, 0.5)
_FIRST = 2**40


def representatives(*scenes: Scene) -> tuple[ExternalElements, dict[int, str]]:
    """Return elements of two diameters in no set, in each set that a law names, and in two of them.

    The last block that holds an element wins, which makes an order of the blocks. It is the same in two decks if it is
    the same for every two consecutive blocks; with many sets no other pairs are needed. Each element has two nodes of
    its own. The second result is its description, by its number.
    """
    sets = _sets(scenes)
    pairs = combinations(sets, 2) if len(sets) <= _ALL_PAIRS else pairwise(sets)
    given: list[tuple[str, ...]] = [(), *((name,) for name in sets), *pairs]
    memberships = dict(enumerate((membership for membership in given for _ in _DIAMETERS), _FIRST))
    members: dict[str, list[int]] = {name: [] for name in sets}
    for number, membership in memberships.items():
        for name in membership:
            members[name].append(number)
    count = len(memberships)
    elements = ExternalElements(
        "representative elements",
        _FIRST + np.arange(count),
        _FIRST + np.arange(2 * count).reshape(count, 2),
        np.resize(_DIAMETERS, count),
        np.ones(count),
        {name: np.array(ids, dtype=np.int64) for name, ids in members.items()},
    )
    names = {
        number: f"an element of {' and '.join(membership)}" if membership else "an element of no set but ALL"
        for number, membership in memberships.items()
    }
    return elements, names


def _sets(scenes: Iterable[Scene]) -> list[str]:
    """Return the sets that laws name, each once, in the order of the last block that names it."""
    last: dict[str, str] = {}
    for scene in scenes:
        for law in scene.laws.set_laws:
            if law.set_ is not scene.set_table.everything:
                last.pop(folded(law.set_.name), None)
                last[folded(law.set_.name)] = law.set_.name
    return list(last.values())
