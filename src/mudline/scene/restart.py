"""`*RESTART`: the decks that a deck continues, found beside it and read."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, cast

from mudline.codes.references import REF015
from mudline.deck.model import Deck
from mudline.deck.parameters import Parameters
from mudline.diagnostics import Problem, Where
from mudline.keywords.text import shown
from mudline.scene.base_files import BaseError, read_base
from mudline.scene.continued import Base, continuation, lent
from mudline.scene.deck_search import find_deck, tried

if TYPE_CHECKING:
    from mudline.keywords.library.restart import Restart

MOST_FOLLOWED = 20
"""Decks in a chain; a longer one is not followed to its beginning."""

_MEND = "correct the name, or put the deck there"


class _Chain(NamedTuple):
    """The decks before a deck, the nearest first; `fault` says why the first of all was not reached, and "" if it was.

    `told` says that the deck itself has to be told of the fault: it is about its own LAST=, or leads back to it.
    """

    bases: list[Base]
    fault: str = ""
    told: bool = False


def continued(deck: Deck) -> tuple[Deck, list[Problem]]:
    """The deck with the models of the decks that it continues, as far as they are found, and what went wrong.

    A deck that came from no path is given back as it is: no file is looked for. Of several LAST= the last one holds.
    """
    names = list(_names(deck))
    if deck.folder is None or not names:
        return deck, []
    problems: list[Problem] = []
    for where, name in names[:-1]:
        if find_deck(deck, name) is None:
            problems.append(Problem(REF015, _missing(deck, name), where=where))
    where, _ = names[-1]
    chain = _follow(deck)
    if chain.told:
        problems.append(Problem(REF015, chain.fault, where=where))
    if not chain.bases:
        return deck, problems
    for base in chain.bases:
        problems += (lent(problem, base.deck) for problem in base.errors)
    return continuation(deck, chain.bases, incomplete=bool(chain.fault)), problems


def decks_before(deck: Deck) -> list[Path]:
    """The files of the decks that a deck continues, the nearest first, as far as they are found."""
    bases = (base.deck for base in _follow(deck).bases)
    return [base.folder / Path(base.file).name for base in bases if base.folder is not None]


def _names(deck: Deck) -> Iterator[tuple[Where, str]]:
    """Every LAST=, with the values of parameters put in."""
    blocks = [(where, cast("Restart", block)) for where, block in deck.blocks("RESTART", "LOAD CASE")]
    parameters = Parameters(deck) if any("%" in (block.last or "") for _, block in blocks) else None
    for where, block in blocks:
        if block.last:
            name = parameters.filled(block.last) if parameters else block.last
            yield where._replace(path=("last",)), name


def _follow(deck: Deck) -> _Chain:
    """The decks before a deck, one behind the other."""
    bases: list[Base] = []
    seen = {_identity(Path(deck.folder, Path(deck.file).name))} if deck.folder is not None else set()
    trail = [Path(deck.file).name]
    current = deck
    while "RESTART" in current.keywords("LOAD CASE"):
        name = next((name for _, name in reversed(list(_names(current)))), None)
        if name is None:
            return _Chain(bases, f"the *RESTART of {trail[-1]} could not be read")
        path = find_deck(current, name)
        if path is None:
            return _Chain(bases, _missing(current, name), told=not bases)
        if _identity(path) in seen:
            back = " -> ".join([*trail, path.name])
            message = f"LAST= leads back to a deck that is open already ({back}): choose the deck of the run before"
            return _Chain(bases, message, told=path.name == trail[0])
        if len(bases) == MOST_FOLLOWED:
            return _Chain(bases, f"more than {MOST_FOLLOWED} decks continue each other")
        try:
            base = read_base(path)
        except BaseError as reason:
            return _Chain(bases, f"the deck that LAST= continues is not read: {reason}; {_MEND}", told=not bases)
        seen.add(_identity(path))
        trail.append(path.name)
        bases.append(base)
        current = base.deck
    return _Chain(bases)


def _missing(deck: Deck, name: str) -> str:
    folder = deck.folder.as_posix() if deck.folder else ""
    names = tried(deck, name)
    return f"the deck {shown(names[0])} is not there (looked in {folder} for {', '.join(names)}): {_MEND}"


def _identity(path: Path) -> Path:
    """A path by which a file is known whatever it is called; never fails."""
    try:
        return path.resolve()
    except (OSError, RuntimeError, ValueError):  # a loop of links, a name that no file has
        return path
