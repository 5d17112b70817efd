"""Files that a deck names."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from mudline.codes.references import REF015
from mudline.deck.model import Deck
from mudline.deck.parameters import Parameters
from mudline.diagnostics import Blocks, Problem, Where
from mudline.keywords.kept import Names
from mudline.keywords.model import Block, names_given
from mudline.keywords.text import shown
from mudline.scene.checks.declaring import check
from mudline.scene.deck_files import file_name, find_file

if TYPE_CHECKING:
    from mudline.scene.model import Scene


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
    """Every field of a keyword with a model that names a file."""
    for i, section in enumerate(deck.own_sections):
        for j, block in enumerate(section.blocks):
            if isinstance(block, Block):
                yield from ((Where(i, j, path), name) for path, name in names_given(block, Names.FILE) if name)
