"""From a name or number to where it is defined and used, in all decks of a chain, and new names for what has one."""

from __future__ import annotations

import os
from collections.abc import Iterator
from functools import cache
from itertools import islice
from pathlib import Path
from typing import NamedTuple, cast

import numpy as np
from lsprotocol import types

from mudline.deck.forms import SUFFIXES
from mudline.deck.model import Deck, Opaque
from mudline.deck.reading import TextOrigin
from mudline.diagnostics import Span
from mudline.expression.evaluation import CONSTANTS
from mudline.expression.nodes import ExpressionError
from mudline.expression.parsing import parse
from mudline.keywords.model import Block, FieldSpec, ListRow, Part, Rows, record_schema
from mudline.keywords.places import Path as ValuePath
from mudline.keywords.table import Table
from mudline.keywords.text import shown
from mudline.keywords.values import Names
from mudline.linting.engine import read_deck
from mudline.lsp import names
from mudline.lsp.decks import Analysis, Decks
from mudline.lsp.documents import Document, address_of
from mudline.lsp.names import WORDS, Occurrence, Thing, occurrences
from mudline.lsp.sites import Site, site
from mudline.scene.deck_values import find_file
from mudline.scene.references import given_names
from mudline.scene.restart import decks_before, find_deck
from mudline.scene.sets import ALL
from mudline.syntax.edits import TextEdit, apply_edits

# ----------------------------------------------------------------------------------------------------- decks of a chain

_MOST_FILES = 1000
_LARGEST = 5_000_000
"""Bytes of a file beside a deck that is looked through for a *RESTART."""
_RESTART = b"RESTART"


class Linked(NamedTuple):
    """A deck of a chain with its text as a document, open or not."""

    document: Document
    deck: Deck


def chain(decks: Decks, analysis: Analysis, folders: list[Path]) -> list[Linked]:
    """A deck, those that it continues, and those that continue it.

    Of the latter, open ones count, and files beside the deck if that is in one of the `folders` of the workspace.
    """
    if analysis.deck is None or analysis.scene is None:
        return []
    found = [Linked(analysis.document, analysis.deck)]
    for base in analysis.scene.deck.bases:
        if base.deck.folder is not None and isinstance(base.deck.origin, TextOrigin):
            path = base.deck.folder / Path(base.deck.file).name
            found.append(Linked(decks.at(path) or _unopened(path, base.deck.origin), base.deck))
    if analysis.document.path is not None:
        found += _dependents(decks, analysis.document.path)
        if any(analysis.document.path.is_relative_to(folder) for folder in folders):
            with decks.reading():
                found += _beside(decks, analysis.document.path)
    return found


def _unopened(path: Path, origin: TextOrigin) -> Document:
    return Document(address_of(path), origin.source.text, 0)


def _dependents(decks: Decks, path: Path) -> Iterator[Linked]:
    """The open decks that continue a deck."""
    for uri in list(decks.documents):
        other = decks.analysis(uri)
        if other is not None and other.deck is not None and other.document.path != path:
            with decks.reading():
                if _continues(other.deck, path):
                    yield Linked(other.document, other.deck)


def _continues(deck: Deck, path: Path) -> bool:
    """Whether a deck continues that of a file."""
    return any(os.path.abspath(before) == os.path.abspath(path) for before in decks_before(deck))  # noqa: PTH100 - links stay


def _beside(decks: Decks, path: Path) -> Iterator[Linked]:
    """The decks in the folder of a deck that continue it and are not open."""
    for number, other in enumerate(sorted(path.parent.iterdir())):
        if number == _MOST_FILES:
            return
        if other == path or other.suffix.lower() not in SUFFIXES or decks.at(other) is not None:
            continue
        try:
            data = other.read_bytes() if other.stat().st_size <= _LARGEST else b""
        except OSError:
            continue
        if _RESTART in data.upper():
            deck = read_deck(data, other.as_posix(), folder=other.parent)
            if isinstance(deck.origin, TextOrigin) and _continues(deck, path):
                yield Linked(_unopened(other, deck.origin), deck)


# ---------------------------------------------------------------------------------------- numbers of nodes and elements

KINDS = {Names.NODE: "node", Names.ELEMENT: "element"}
_MOST = 10_000
"""Places that are given of one number."""


class Use(NamedTuple):
    """A place where a number is given; `defines` says that the node or element is made there."""

    span: Span
    defines: bool


def uses(deck: Deck, kind: Names, number: int) -> list[Use]:
    """The first places in a deck of its own, in the order of the text; none in a deck that is no keyword text."""
    origin = deck.origin
    if not isinstance(origin, TextOrigin):
        return []
    found: list[Use] = []
    for (i, j), read in origin.read.items():
        block = deck.sections[i].blocks[j]
        if type(block) is Opaque or not _leads(type(cast("Block", block)), kind):
            continue
        makes = cast("Block", block).facts.defines == f"{KINDS[kind]}s"
        paths = islice(_paths(cast("Block", block), kind, number, (), makes=makes), _MOST)
        found += [Use(read.places.find(path), defines) for path, defines in paths]
    return sorted(found)


@cache
def _leads(part: type[Part], kind: Names) -> bool:
    return any(_of(slot, kind) or any(_leads(inner, kind) for inner in _inner(slot)) for slot in _slots(part))


def _slots(part: type[Part]) -> list[FieldSpec]:
    return record_schema(part).slots


def _of(slot: FieldSpec, kind: Names) -> bool:
    return kind in (slot.about.names, slot.about.defines)


def _inner(slot: FieldSpec) -> list[type[Part]]:
    row = slot.about.row if isinstance(slot.about, Rows) else slot.row
    return [each for each in (row, *slot.record.values()) if each]


def _paths(part: Part, kind: Names, number: int, path: ValuePath, *, makes: bool) -> Iterator[tuple[ValuePath, bool]]:
    """The paths below a part that give the number, and whether it is defined there; `makes` is that of the block."""
    for slot in _slots(type(part)):
        value = getattr(part, slot.name, None)
        inner = (*path, slot.json)
        if isinstance(value, Table):
            yield from (((*inner, row, column), defines) for row, column, defines in _cells(slot, value, kind, number))
        elif isinstance(value, ListRow):
            if any(_of(each, kind) for each in _slots(type(value))) and _holds(value, number):
                yield inner, makes
        elif isinstance(value, list) and slot.record:
            for index, item in enumerate(value):
                yield from _paths(item, kind, number, (*inner, index), makes=makes)
        elif isinstance(value, list) and _of(slot, kind):
            yield from (((*inner, index), False) for index, item in enumerate(value) if item == number)
        elif _of(slot, kind) and value == number:
            yield inner, False


def _cells(slot: FieldSpec, table: Table, kind: Names, number: int) -> Iterator[tuple[int, int, bool]]:
    """Row and column of the cells of a table that give the number, and whether it is defined there."""
    for column, each in enumerate(_slots(_inner(slot)[0])):
        if _of(each, kind) and column < table.values.shape[1]:
            rows = np.flatnonzero(table.values[:, column] == number)[:_MOST].tolist()
            yield from ((row, column, each.about.defines is kind) for row in rows)


def _holds(row: ListRow, number: int) -> bool:
    """Whether a range holds a number: `start, end [, increment]`, or `master, count [, increment]`."""
    start = getattr(row, "start", getattr(row, "master", None))
    of_five = getattr(row, "third", None) if getattr(row, "fifth", None) is not None else None  # of *BOUNDARY
    step = getattr(row, "increment", of_five) or 1
    end = getattr(row, "end", None)
    if not isinstance(start, int) or not isinstance(step, int):
        return False
    if end is None and isinstance(count := getattr(row, "count", None), int):
        end = start + (count - 1) * step
    return isinstance(end, int) and step > 0 and start <= number <= end and (number - start) % step == 0


# -------------------------------------------------------------------------------------------------------------- answers

_LONGEST_NAME = 256
_NOT_IN_NAMES = ',="{}[]%/\r\n'


class RenameError(ValueError):
    """A new name that cannot be given; the message says why and what to do."""


class Navigator:
    """Answers about one open deck; `folders` are those of the workspace."""

    def __init__(self, decks: Decks, analysis: Analysis, folders: list[Path]) -> None:
        self.decks = decks
        self.analysis = analysis
        self.folders = folders

    # --------------------------------------------------------------------------------------------- definition and uses

    def definition(self, offset: int) -> list[types.Location]:
        """Where the thing at an offset is defined; of a file, the file."""
        named = names.at(self.analysis.names, offset)
        if named is not None:
            return [_location(each.document, one.span) for each, one in self._named(named.thing) if one.defines]
        found = site(self.analysis, offset)
        if found is not None and (file := self._file(found.slot.about.names, self.analysis.deck, found.value)):
            return [types.Location(address_of(file), types.Range(types.Position(0, 0), types.Position(0, 0)))]
        return [_location(document, use.span) for document, use in self._numbered(found) if use.defines]

    def references(self, offset: int, *, declaration: bool) -> list[types.Location]:
        """Every place where the thing at an offset is used, and, with `declaration`, where it is defined."""
        named = names.at(self.analysis.names, offset)
        if named is not None:
            found = self._named(named.thing)
            return [_location(each.document, one.span) for each, one in found if declaration or not one.defines]
        value = site(self.analysis, offset)
        if value is not None and (file := self._file(value.slot.about.names, self.analysis.deck, value.value)):
            return list(self._named_file(file))
        uses = self._numbered(value)
        return [_location(document, use.span) for document, use in uses if declaration or not use.defines]

    def highlights(self, offset: int) -> list[types.DocumentHighlight]:
        """The places in this deck alone."""
        places = self.references(offset, declaration=True)
        return [types.DocumentHighlight(place.range) for place in places if place.uri == self.analysis.document.uri]

    def _linked(self, thing: Thing | None = None) -> list[Linked]:
        """The decks in which a thing is the same: a parameter belongs to its deck."""
        own = thing is not None and thing.kind is Names.PARAMETER
        if own and self.analysis.deck is not None:
            return [Linked(self.analysis.document, self.analysis.deck)]
        return chain(self.decks, self.analysis, self.folders)

    def _named(self, thing: Thing) -> Iterator[tuple[Linked, Occurrence]]:
        for linked in self._linked(thing):
            own = linked.deck is self.analysis.deck
            for one in self.analysis.names if own else occurrences(linked.deck):
                if one.thing == thing:
                    yield linked, one

    def _numbered(self, found: Site | None) -> Iterator[tuple[Document, Use]]:
        kind = (found.slot.about.names or found.slot.about.defines) if found else None
        if found is None or kind not in KINDS or not isinstance(found.value, int | float):
            return
        if float(found.value).is_integer():
            for linked in self._linked():
                for use in uses(linked.deck, kind, int(found.value)):
                    yield linked.document, use

    def _named_file(self, file: Path) -> Iterator[types.Location]:
        """Every place in the decks of the chain that names a file."""
        for document, deck in self._linked():
            for kind in (Names.DECK, Names.FILE):
                for _, where, name in given_names(deck, kind):
                    span = deck.origin.span(where) if isinstance(deck.origin, TextOrigin) else None
                    if span is not None and self._file(kind, deck, name) == file:
                        yield _location(document, span)

    def _file(self, kind: Names | None, deck: Deck | None, name: object) -> Path | None:
        """The file that a name of a kind in a deck stands for, if it is there."""
        if deck is None or not isinstance(name, str):
            return None
        if kind is Names.DECK:
            return find_deck(deck, name)
        return find_file(deck.folder, name) if kind is Names.FILE else None

    # ------------------------------------------------------------------------------------------------------ new names

    def renamed(self, offset: int) -> Occurrence:
        """The name at an offset, if it can be changed; raises RenameError."""
        named = names.at(self.analysis.names, offset)
        if named is None:
            raise RenameError("only sets, curves and parameters can be renamed")
        word = WORDS[named.thing.kind]
        if named.thing == Thing(Names.SET, ALL):
            raise RenameError("set ALL is predefined and cannot be renamed")
        found = [one for _, one in self._named(named.thing)]
        if not any(one.defines for one in found):
            where = "by lines that are not read, or nowhere" if word == "set" else "nowhere"
            raise RenameError(f"{word} {shown(named.name)} is defined {where}: rename it by hand")
        if any(one.composed for one in found):
            raise RenameError(f"{word} {shown(named.name)} is an item of a list: rename it by hand")
        return named

    def rename(self, offset: int, name: str) -> types.WorkspaceEdit:
        """The changes that give the thing at an offset another name, in every deck of a chain; raises RenameError."""
        named = self.renamed(offset)
        old, new = named.thing, names.thing(named.thing.kind, name)
        self._check(old, new, name)
        edits: dict[int, tuple[Linked, list[TextEdit]]] = {}
        for linked, one in self._named(old):
            edits.setdefault(id(linked.deck), (linked, []))[1].append(TextEdit(one.span, name))
        for linked, changes in edits.values():
            text = apply_edits(linked.document.text, changes)
            again = occurrences(read_deck(text.encode(), linked.document.name))
            if sum(one.thing == new for one in again) < len(changes):
                raise RenameError(f"{shown(name)} would not be read as this name everywhere: choose another one")
        changes_of = {linked.document.uri: linked.document.edits(changes) for linked, changes in edits.values()}
        return types.WorkspaceEdit(changes=changes_of)

    def _check(self, old: Thing, new: Thing, name: str) -> None:
        word = WORDS[old.kind]
        if not name or name != name.strip() or any(letter in name for letter in _NOT_IN_NAMES):
            raise RenameError(f"{shown(name)} cannot be the name of a {word}: leave out commas, =, quotes and brackets")
        if len(name) > _LONGEST_NAME:
            raise RenameError(f"a name has at most {_LONGEST_NAME} characters, found {len(name)}")
        if old.kind is Names.PARAMETER and not _is_parameter(name):
            raise RenameError(f"{shown(name)} cannot be used in an equation: use letters, digits and _")
        scene = self.analysis.scene
        opaque = scene is not None and old.kind is Names.SET and scene.set_table.find(name) is not None
        if new != old and (opaque or new == Thing(Names.SET, ALL) or any(True for _ in self._named(new))):
            raise RenameError(f"{word} {shown(name)} is already defined: choose another name")


def _is_parameter(name: str) -> bool:
    """Whether an equation reads a text as the name of a parameter."""
    try:
        read = parse(name)
    except ExpressionError:
        return False
    return read.names == (name,) and name.casefold() not in CONSTANTS


def _location(document: Document, span: Span) -> types.Location:
    return types.Location(document.uri, document.range(span))
