"""Files that a deck names."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import TYPE_CHECKING, Any

from mudline.codes import REF015
from mudline.deck.model import Deck
from mudline.deck.parameters import Parameters
from mudline.diagnostics import Blocks, Problem, Where
from mudline.keywords.model import Block, Part, Slot, layout
from mudline.keywords.text import shown
from mudline.scene.checks.declaring import check
from mudline.scene.deck_files import file_name, find_file

if TYPE_CHECKING:
    from mudline.scene.model import Scene

_KEY = "FILE"


@check(REF015)
def missing_file(scene: Scene) -> Iterator[Problem]:
    """Every FILE= of the deck itself that names no file, if it is known where files could be.

    Without the file of its profile the seabed is not known.
    """
    deck = scene.context.written
    if deck.folder is None:
        return
    files = list(_files(deck))
    parameters = Parameters(deck) if files else None
    for where, written in files:
        name = parameters.filled(written) if parameters else written
        name = file_name(name)
        if "%" not in name and find_file(deck.folder, name) is None:
            folder = deck.folder.as_posix()
            message = (
                f"the file {shown(name)} is not there (looked in {folder}): correct the name, or put the file there"
            )
            profile = bool(scene.floor.missing) and where == scene.floor.where._replace(path=("file",))
            yield Problem(REF015, message, where=where, blocks=Blocks.ALWAYS if profile else Blocks.NEVER)


def _files(deck: Deck) -> Iterator[tuple[Where, str]]:
    """Every FILE= of a keyword with a model."""
    for i, section in enumerate(deck.own_sections):
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
