"""Files that a deck names."""

from __future__ import annotations

from collections.abc import Iterator

from mudline.codes import REF015
from mudline.deck.model import Deck
from mudline.deck.parameters import Parameters
from mudline.diagnostics import Problem, Where
from mudline.keywords.kept import Names
from mudline.keywords.model import Block, names_given
from mudline.keywords.text import shown
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.scene.deck_files import file_name, find_file


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
    """Every field of a keyword with a model that names a file."""
    for i, section in enumerate(deck.sections):
        for j, block in enumerate(section.blocks):
            if isinstance(block, Block):
                yield from ((Where(i, j, path), name) for path, name in names_given(block, Names.FILE) if name)
