"""Reasons against a migration: misspelt keywords, statements without equivalent, decks that continue a deck."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple

from mudline.basics.files import recording_looks, version_of
from mudline.basics.limits import LARGEST_NEIGHBOUR
from mudline.language.codes import MIG001
from mudline.language.deck.loading import load_path
from mudline.language.deck.model import Deck, Opaque
from mudline.language.deck.searching import is_in_any_form, may_be_file
from mudline.language.diagnostics import DeckError, Problem, Where
from mudline.language.keywords.catalogue import (
    facts_of,
    in_order,
    is_superseded,
    sections_of,
    suggest_keyword,
    supersedes,
)
from mudline.language.keywords.library.seabed_properties import Surface
from mudline.language.keywords.model import Block
from mudline.language.keywords.values import Equation
from mudline.language.syntax.tree import canonical_name
from mudline.model.scene.deck_values import LARGEST_MOBILISATION
from mudline.model.scene.laws import DIRECTIONS
from mudline.model.scene.model import Scene
from mudline.model.scene.restart import decks_before

_MISSPELT = "{} may be meant as *{}{}: correct or remove it first"


def superseded_blocks(deck: Deck) -> list[tuple[Where, Block]]:
    """Return the blocks of superseded keywords: surfaces first, then curves by set."""
    present = filter(is_superseded, in_order(deck.keywords()))
    first = sorted(present, key=lambda keyword: not facts_of(keyword, "MODEL").seabed_type)
    return [block for keyword in first for block in deck.blocks(keyword)]


def surfaces(deck: Deck) -> list[tuple[Where, Surface]]:
    """Return the legacy surfaces of a deck, in the order of the file."""
    return deck.blocks_with("seabed_type")


def misspelt(deck: Deck) -> Iterator[Problem]:
    """Yield unknown keywords of the model that resemble a legacy keyword; for a deck without legacy keywords."""
    for where, section, block in deck.every_block():
        unknown = section == "MODEL" and isinstance(block, Opaque) and sections_of(block.keyword) is None
        if unknown and is_superseded(suggested := suggest_keyword(block.keyword)):
            yield _refusal(_MISSPELT.format(f"*{block.keyword}, which is not known,", suggested, ""), where)


def refusals(deck: Deck, scene: Scene, continued_by: Sequence[str] = ()) -> Iterator[Problem]:
    """Yield the reasons why a deck without errors cannot be migrated; `deck` has its equations as written.

    `scene` is the resolved deck. `continued_by` names decks that continue this deck with seabed keywords of their own.
    """
    yield from misplaced_keywords(scene)
    for where, _ in deck.blocks("SEABED PROPERTIES"):  # which family applies to an element is not for us to decide
        message = "*SEABED PROPERTIES is used next to legacy keywords: decide which applies and remove the other"
        yield _refusal(message, where)
    for where, section, block in deck.every_block():
        if (section, block.keyword) == ("LOAD CASE", "RESTART"):
            message = "*RESTART continues another deck, whose seabed applies as well: put the model in one deck"
            yield _refusal(message, where)
    for name in continued_by:
        message = (
            f"{name} continues this deck and has seabed keywords of its own, which would apply differently: "
            "leave both decks unchanged"
        )
        yield _refusal(message, superseded_blocks(deck)[0][0])
    yield from _varied_keywords(deck)
    legacy = surfaces(deck)
    for where, block in legacy[1:]:
        yield _refusal(f"a second surface: remove all but one, then migrate *{block.keyword}", where)
    for where, block in legacy[:1]:
        yield from _lengths(block, where, deck.units)
        yield from _shapes(deck, block, where)


def _refusal(message: str, where: Where) -> Problem:
    return Problem(MIG001, message, where=where)


def misplaced_keywords(scene: Scene) -> Iterator[Problem]:
    """Yield misspelt or misplaced keywords that matter to the laws.

    These are keywords of the seabed, and keywords whose absence turns an error into a warning.
    """
    for keyword in filter(None, scene.context.misplaced):
        depend = sorted({finding.code.code for finding in scene.findings if finding.maybe_defined_by == keyword})
        if depend or is_superseded(keyword) or supersedes(keyword):
            words, where = scene.context.misplaced[keyword]
            codes = f" ({', '.join(depend)})" if depend else ""
            yield _refusal(_MISSPELT.format(words, keyword, codes), where)


def _varied_keywords(deck: Deck) -> Iterator[Problem]:
    """Yield actions of `*VARIATION` on keywords that a migration removes or adds."""
    for where, block in deck.blocks("VARIATION", "PREPROCESSOR"):
        for i, variation in enumerate(block.variations):
            for j, item in enumerate(variation.blocks):
                keyword = canonical_name("*" + ",".join(item.keyword))
                if is_superseded(keyword) or supersedes(keyword):
                    message = f"a variation adds or removes *{keyword}, which migration changes: remove the action"
                    yield _refusal(message, where.inside("variations", i, "blocks", j))


def _lengths(block: Surface, where: Where, units: str) -> Iterator[Problem]:
    """Yield largest characteristic lengths that bound the mobilisation length and differ from the default.

    A length has no effect if the mobilisation length is given or the friction coefficient is 0. The value of an
    equation may change: it is taken neither as 0 nor as the default.
    """
    values: Any = block.properties
    for direction in DIRECTIONS:
        name = f"{direction}_length"
        length = getattr(values, name)
        if length is None or getattr(values, f"{direction}_mobilisation") is not None:
            continue
        if getattr(values, direction) not in (None, 0.0) and length != LARGEST_MOBILISATION.get(units):
            message = (
                f"the largest {direction} characteristic length bounds the mobilisation length of each element, "
                "and the new family has no field for it: give the mobilisation length instead"
            )
            yield _refusal(message, where.inside("properties", name))


def _shapes(deck: Deck, block: Surface, where: Where) -> Iterator[Problem]:
    """Yield a slope or profile that `*SEABED PROFILE` cannot take over."""
    shaped = block.slope is not None or block.profile is not None
    if block.slope is not None and block.profile is not None:
        yield _refusal("a slope and a profile: remove one of them", where.inside("slope"))
    for keyword in ("SEABED PROFILE", "SEABED PLANES") if shaped else ():
        for other, _ in deck.blocks(keyword):
            yield _refusal(f"*{keyword} and the slope or profile of *{block.keyword}: remove one of them", other)
    for (row, column), word in (block.profile.words if block.profile is not None else {}).items():
        if isinstance(word, Equation):
            message = "an equation in a profile, whose points go to a text file: write the number"
            yield _refusal(message, where.inside("profile", row, column))


# ---------------------------------------------------------------------------------------------- decks that continue one

_NEWER = {"SEABED PROPERTIES", "SEABED STIFFNESS"}
"""New keywords whose laws would be combined with those of a migrated deck."""


class _Visited(NamedTuple):
    """A deck that was read.

    Attributes:
        states: states of its file and of the files on which the decks that it continues depend.
        bases: decks that it continues with a model of its own.
        seabed: True if it has seabed keywords of its own.
    """

    states: dict[str, tuple[int, ...]]
    bases: list[Path]
    seabed: bool


class Continuations:
    """Decks that continue a deck, among those to be migrated and those in its folder."""

    def __init__(self, files: Iterable[Path] = ()) -> None:
        self._looked: set[Path] = set()
        self._visited: dict[Path, _Visited] = {}
        for file in files:
            self._visit(file)

    def of(self, file: Path) -> list[str]:
        """Return the names of the decks that continue a deck and have seabed keywords of their own."""
        if file.parent not in self._looked:
            self.look_in(file.parent)
        base = file.resolve()
        return sorted(each.as_posix() for each, other in self._visited.items() if other.seabed and base in other.bases)

    def extend(self, file: Path) -> bool:
        """Return True if a visited deck that continues the deck has a model of its own, with more elements or sets."""
        base = file.resolve()
        return any(base in other.bases for other in self._visited.values())

    def look_in(self, folder: Path) -> None:
        """Read new and changed decks of a folder, and forget decks that no longer exist."""
        self._looked.add(folder)
        there = {file for file in folder.iterdir() if may_be_file(str(file)) and is_in_any_form(str(file))}
        for gone in [file for file in self._visited if file.parent == folder and file not in there]:
            del self._visited[gone]
        for file in sorted(there):
            self._visit(file)

    def _visit(self, file: Path) -> None:
        known = self._visited.get(file)
        if known and all(version_of(path) == before for path, before in known.states.items()):
            return
        states, bases, seabed = {str(file): version_of(str(file))}, list[Path](), False
        with recording_looks() as looks, suppress(OSError, DeckError):  # an unreadable deck continues nothing
            if file.stat().st_size <= LARGEST_NEIGHBOUR and b"RESTART" in file.read_bytes().upper():
                deck = load_path(file)
                if keywords := deck.keywords():
                    seabed = bool(keywords & _NEWER) or any(map(is_superseded, keywords))
                    bases = [base.resolve() for base in decks_before(deck)]
        self._visited[file] = _Visited(states | {path: version_of(path) for path in looks}, bases, seabed)


def continuations_beside(deck: Deck, among: Continuations | None = None) -> tuple[list[str], bool]:
    """Return the results of `Continuations.of` and `extend` for a deck and its folder in its present state.

    `among` are the decks of a run, whose folders are searched once.
    """
    if deck.folder is None or not deck.folder.is_dir():
        return [], False
    file = deck.folder / Path(deck.file).name
    found = among or _continuations_in(deck.folder)
    if among is None:
        found.look_in(deck.folder)
    return found.of(file), found.extend(file)


@lru_cache(maxsize=1)
def _continuations_in(_: Path) -> Continuations:
    """Return the continuations of a folder, kept so that each of many decks is read once."""
    return Continuations()
