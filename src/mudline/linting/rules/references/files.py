"""Files that a deck names."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import Any

from mudline.codes import REF015
from mudline.deck.model import Deck
from mudline.deck.parameters import Parameters
from mudline.diagnostics import Problem, Where
from mudline.keywords.model import Block, Part, Slot, layout
from mudline.keywords.text import shown
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.scene.deck_files import file_name, find_file

_KEY = "FILE"


@rule(REF015)
def missing_file(context: LintContext) -> Iterator[Problem]:
    """A file that the deck names is not there.

    FILE= and the LAST= of *RESTART name files beside the deck. Without the deck before a *RESTART mudline does not know
    the model that this deck works on, and what is missing is a warning only. The finding is also given for a deck that
    is there and cannot be read, and for decks that continue each other in a circle. A deck from standard input names no
    place where its files could be, so nothing is looked for.

    Bad:
        $LOAD CASE
        *RESTART
         LAST=static
        *TIME
         STEP=FIXED
         0.0, 120.0, 0.05

    Good:
        $LOAD CASE
        *TIME
         STEP=FIXED
         0.0, 120.0, 0.05

    Finds: 3:7
    """
    yield from context.told(REF015)
    deck = context.deck
    if deck.folder is None:
        return
    parameters = Parameters(deck)
    for where, written in _files(deck):
        name = file_name(parameters.filled(written))
        if "%" not in name and find_file(deck.folder, name) is None:
            folder = deck.folder.as_posix()
            message = (
                f"the file {shown(name)} is not there (looked in {folder}): correct the name, or put the file there"
            )
            yield Problem(REF015, message, where=where)


def _files(deck: Deck) -> Iterator[tuple[Where, str]]:
    """Every FILE= of a keyword with a model."""
    for i, section in enumerate(deck.sections):
        for j, block in enumerate(section.blocks):
            if isinstance(block, Block):
                yield from ((Where(i, j, path), name) for path, name in _named(block))


@cache
def _naming(part: type[Part]) -> tuple[Slot, ...]:
    """The fields that name a file, and those with records that have one."""
    found = layout(part).slots
    return tuple(slot for slot in found if slot.key == _KEY or any(map(_naming, slot.record.values())))


def _named(part: Part) -> Iterator[tuple[tuple[str | int, ...], str]]:
    for slot in _naming(type(part)):
        value: Any = getattr(part, slot.name, None)
        if isinstance(value, str) and value:
            yield (slot.json,), value
        elif isinstance(value, list):
            for index, record in enumerate(value):
                yield from (((slot.json, index, *path), name) for path, name in _named(record))
