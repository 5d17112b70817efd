"""Decks that a deck continues by `*RESTART`, found next to it and read once for all decks that continue them."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import fields, replace
from functools import lru_cache
from itertools import islice
from pathlib import Path, PurePath
from typing import TYPE_CHECKING, NamedTuple, cast

from mudline.basics.files import look, unsaved
from mudline.basics.limits import LARGEST_FILE, MOST_CONTINUED, MOST_NEIGHBOURS
from mudline.basics.outside import without_text
from mudline.language.codes.references import REF015
from mudline.language.deck.forms import SUFFIXES
from mudline.language.deck.loading import load_bytes, load_path
from mudline.language.deck.model import Base, BaseProblem, Deck
from mudline.language.deck.parameters import Parameters, evaluated
from mudline.language.diagnostics import DeckError, Problem, Severity, Where
from mudline.language.keywords.text import shown
from mudline.model.scene.deck_values import file_name, find_file, not_found

if TYPE_CHECKING:
    from mudline.language.keywords.library.analysis import Restart


_ADVICE = "correct the name, or put the deck there"


class _Bases(NamedTuple):
    """Decks before a deck, the nearest first.

    bases: the decks.
    is_whole: the first of all was reached.
    fault: reason why it was not, if that is in the deck itself: in its own LAST=, or a cycle back to it.
    """

    bases: list[Base]
    is_whole: bool = False
    fault: Problem | None = None


def continued(deck: Deck) -> tuple[Deck, list[Problem]]:
    """Return the deck with the models of the decks that it continues, as far as they are found, and problems.

    A deck without a path is returned as it is: no file is looked for. Of several LAST= the last one is used.
    """
    names = list(_names(deck))
    if deck.folder is None or not names:
        return deck, []
    problems = [_missing(deck, name, where) for where, name in names[:-1] if find_deck(deck, name) is None]
    chain = _follow(deck)
    if chain.fault:
        problems.append(replace(chain.fault, where=names[-1][0]))
    if not chain.bases:
        return deck, problems
    for base in chain.bases:
        path = Path(base.deck.folder or deck.folder, Path(base.deck.file).name)
        for problem in base.errors:  # without text from files outside of the project
            shown_ = replace(problem, message=without_text(problem.message, path, deck.folder), repair=None)
            values = {each.name: getattr(shown_, each.name) for each in fields(Problem)}
            problems.append(BaseProblem(**values, deck=base.deck))
    units = (each.units for each in (deck, *(base.deck for base in chain.bases)))
    whole = replace(
        deck,
        units=next((name for name in units if name != "user"), "user"),
        sections=[*deck.sections, *(model for base in reversed(chain.bases) for model in base.sections.values())],
        bases=tuple(chain.bases),
        incomplete=not chain.is_whole,
    )
    return whole, problems


def decks_before(deck: Deck) -> list[Path]:
    """Return the files of the decks that a deck continues, the nearest first, as far as they are found."""
    bases = (base.deck for base in _follow(deck).bases)
    return [base.folder / Path(base.file).name for base in bases if base.folder is not None]


def _names(deck: Deck) -> Iterator[tuple[Where, str]]:
    """Yield every LAST=, with the values of parameters put in."""
    parameters = Parameters(deck)
    for where, block in deck.blocks("RESTART", "LOAD CASE"):
        if last := cast("Restart", block).last:
            yield where.inside("last"), parameters.filled(last)


def _follow(deck: Deck) -> _Bases:
    """Return the decks before a deck, each followed by the deck that it continues."""
    bases: list[Base] = []
    seen = {_identity(Path(deck.folder, Path(deck.file).name))} if deck.folder is not None else set()
    trail = [Path(deck.file).name]
    current = deck
    while "RESTART" in current.keywords("LOAD CASE"):
        names = list(_names(current))
        if not names:
            return _Bases(bases)
        where, name = names[-1]
        path = find_deck(current, name)
        if path is None:
            return _Bases(bases, fault=None if bases else _missing(current, name, where))
        if _identity(path) in seen:
            back = " -> ".join([*trail, path.name])
            message = f"LAST= leads back to a deck that is open already ({back}): choose the deck of the run before"
            return _Bases(bases, fault=Problem(REF015, message) if path.name == trail[0] else None)
        if len(bases) == MOST_CONTINUED:
            return _Bases(bases)
        base = read_base(path)
        if isinstance(base, str):
            why = without_text(base, path, deck.folder or path.parent)
            message = f"the deck that LAST= continues is not read: {why}; {_ADVICE}"
            return _Bases(bases, fault=None if bases else Problem(REF015, message))
        seen.add(_identity(path))
        trail.append(path.name)
        bases.append(base)
        current = base.deck
    return _Bases(bases, is_whole=True)


def _missing(deck: Deck, name: str, where: Where) -> Problem:
    """Return the problem of a LAST= whose deck is not there, or is refused."""
    names = candidate_names(deck, name)
    folder = deck.folder or Path()
    why, severity = not_found(folder, names[0])
    if severity is Severity.ERROR:
        return Problem(REF015, why, None, severity, where)
    looked = f"looked in {folder.as_posix() if deck.folder else ''} for {', '.join(names)}"
    return Problem(REF015, f"the deck {shown(names[0])} was not found ({looked}): {_ADVICE}", where=where)


def _identity(path: Path) -> Path:
    """Return a path that identifies a file whatever its name; never fails."""
    try:
        return path.resolve()
    except (OSError, RuntimeError, ValueError):  # a loop of links, a name that no file has
        return path


def read_base(path: Path) -> Base | str:
    """Return the deck of a file in any form, its model evaluated, or the reason why it cannot be continued."""
    try:
        stat = path.stat()
        if stat.st_size > LARGEST_FILE:
            return f"{path.as_posix()} has more than {LARGEST_FILE // 10**6} million bytes"
        edited = unsaved(path)
        version = (stat.st_ino, -edited.revision if edited else stat.st_mtime_ns, stat.st_size)
        return _read_base(path, version)
    except OSError as error:
        return f"{path.as_posix()}: {error.strerror or error}"


@lru_cache(maxsize=8)
def _read_base(path: Path, _version: tuple[int, ...]) -> Base | str:
    """Return the same for a version of the file: many decks continue the same decks."""
    edited = unsaved(path)
    try:
        content = edited and edited.content()
        deck = load_path(path) if content is None else load_bytes(content, path.as_posix(), folder=path.parent)
    except DeckError as error:
        return f"{error.diagnostics[0]}"
    if not deck.sections:
        return f"{path.as_posix()} has no section: it is not a deck"
    ready, problems = evaluated(deck)
    model = {number: section for number, section in enumerate(ready.sections) if section.name == "MODEL"}
    return Base(deck, model, (*deck.problems, *problems))


def candidate_names(deck: Deck, written: str) -> list[str]:
    """Return the possible names of a LAST=: as written, then with the deck's own suffix, then with other suffixes."""
    name = file_name(written)
    return list(dict.fromkeys([name, *(name + suffix for suffix in (PurePath(deck.file).suffix, *SUFFIXES))]))


def find_deck(deck: Deck, written: str) -> Path | None:
    """Return the file that a LAST= of a deck names; of names that differ in case only, the first in sorted order."""
    names = candidate_names(deck, written)
    exact = (find_file(deck.folder, name) for name in names)
    return next((path for path in exact if path is not None), None) or _in_other_case(deck.folder, names)


def _in_other_case(folder: Path | None, names: list[str]) -> Path | None:
    if folder is None:
        return None
    inner = PurePath(names[0]).parent
    try:
        listed = _listed(str(look(folder / inner)), (folder / inner).stat().st_mtime_ns)
    except (OSError, ValueError):
        return None
    known = (listed.get(PurePath(name).name.casefold()) for name in names)
    files = (find_file(folder, (inner / name).as_posix()) for name in known if name is not None)
    return next((path for path in files if path is not None), None)


@lru_cache(maxsize=4)
def _listed(folder: str, _changed: int) -> dict[str, str]:
    """Return the files of a folder by their names without case; cached until the folder changes."""
    with os.scandir(folder) as entries:
        names = sorted(islice((each.name for each in entries), MOST_NEIGHBOURS), reverse=True)
    return {name.casefold(): name for name in names}
