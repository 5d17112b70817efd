"""From a name or number to where it is defined and used, and new names for sets, curves and parameters."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from lsprotocol import types

from mudline.deck.model import Deck
from mudline.deck.reading import TextOrigin
from mudline.diagnostics import Span
from mudline.expression.evaluation import CONSTANTS
from mudline.expression.nodes import ExpressionError
from mudline.expression.parsing import parse
from mudline.keywords.text import shown
from mudline.keywords.values import Names
from mudline.linting.engine import read_deck
from mudline.lsp import names, numbers
from mudline.lsp.chains import Linked, chain
from mudline.lsp.decks import Analysis, Decks
from mudline.lsp.documents import Document, address_of
from mudline.lsp.names import WORDS, Occurrence, Thing, occurrences
from mudline.lsp.sites import Site, site
from mudline.scene.deck_values import find_file
from mudline.scene.references import given_names
from mudline.scene.restart import find_deck
from mudline.scene.sets import ALL
from mudline.syntax.edits import TextEdit, apply_edits

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

    def _numbered(self, found: Site | None) -> Iterator[tuple[Document, numbers.Use]]:
        kind = (found.slot.about.names or found.slot.about.defines) if found else None
        if found is None or kind not in numbers.KINDS or not isinstance(found.value, int | float):
            return
        if float(found.value).is_integer():
            for linked in self._linked():
                for use in numbers.uses(linked.deck, kind, int(found.value)):
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
            raise RenameError("there is no name here: sets, curves and parameters can be renamed")
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
            raise RenameError(f"there is a {word} {shown(name)} already: choose another name")


def _is_parameter(name: str) -> bool:
    """Whether an equation reads a text as the name of a parameter."""
    try:
        read = parse(name)
    except ExpressionError:
        return False
    return read.names == (name,) and name.casefold() not in CONSTANTS


def _location(document: Document, span: Span) -> types.Location:
    return types.Location(document.uri, document.range(span))
