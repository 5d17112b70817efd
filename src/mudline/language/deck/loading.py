"""Reading and writing a deck in any form, and the share of it that was read."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import cast

from mudline.basics.limits import LARGEST_FILE
from mudline.language.deck import forms
from mudline.language.deck.faults import refusal
from mudline.language.deck.forms import KEYWORD, form_of
from mudline.language.deck.model import Deck, Opaque
from mudline.language.deck.reading import read_source
from mudline.language.diagnostics import Coverage
from mudline.language.keywords.catalogue import is_read_somewhere
from mudline.language.keywords.contents import is_read
from mudline.language.keywords.model import Block
from mudline.language.keywords.reader import BlockReader, read_block
from mudline.language.syntax.source import Source


def load_path(path: Path, name: str | None = None, *, form: str | None = None, units: str | None = None) -> Deck:
    """Return the deck of a file; raises OSError, or DeckError for a JSON or YAML file without a deck."""
    return load_bytes(path.read_bytes(), name or path.as_posix(), form=form, units=units, folder=path.parent)


def load_bytes(
    data: bytes,
    name: str,
    *,
    form: str | None = None,
    units: str | None = None,
    folder: Path | None = None,
    read: BlockReader = read_block,
) -> Deck:
    """Return the deck of a file's content. Keyword text never fails: its faults are in the deck's problems.

    Files that the deck names are looked for in `folder`; without a folder none is looked for. `read` reads the blocks
    of a keyword text.
    """
    form = form or form_of(name)
    if form == KEYWORD:
        source = Source.from_bytes(data, name)
        del data  # frees its memory for the tables, unless the caller keeps it
        deck = read_source(source, units=units, read=read)
    else:
        if len(data) > LARGEST_FILE:
            raise refusal(name, f"more than {LARGEST_FILE} bytes: is this a deck? Write a large one as keyword text")
        deck = cast("Deck", _form(form).read(data, name))
        deck.units = units or deck.units
    deck.folder = folder
    return deck


def dump(deck: Deck, form: str) -> str:
    """Return the text of a deck in a form: keyword text, JSON or YAML."""
    return cast("str", _form(form).write(deck))


def _form(form: str) -> ModuleType:
    """Return the module of a form, imported when it is needed: keyword decks need neither JSON nor YAML."""
    return import_module(f"{forms.__name__}.{form}")


def coverage_of(deck: Deck) -> Coverage:
    """Count the keywords of the deck itself by the share of them that was read.

    The name of an unread keyword is followed by its section if a keyword of that name is read in another section.
    """
    coverage = Coverage()
    for _, section, block in deck.alone.every_block():
        coverage.total += 1
        if extent(block) == "read":
            coverage.read += 1
        else:
            unread = type(block) is Opaque
            names, name = coverage.unread if unread else coverage.partly, block.keyword
            if unread and is_read_somewhere(name):
                name += f" in ${section}"
            names[name] = names.get(name, 0) + 1
    return coverage


def extent(block: Block | Opaque) -> str:
    """Return "read", "partly" or "unread": the share of a block that was read."""
    if type(block) is Opaque:
        return "unread"
    return "read" if is_read(block) else "partly"
