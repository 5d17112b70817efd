"""Navigation from a name or number to its definition and uses in a chain of decks, and renaming."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from lsprotocol import types

from mudline.checks.context import read_deck
from mudline.language.deck.model import Deck
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import Span
from mudline.language.expression.evaluation import CONSTANTS
from mudline.language.expression.parsing import ExpressionError, parse
from mudline.language.keywords.text import shown
from mudline.language.keywords.values import Names
from mudline.language.syntax.edits import TextEdit, apply_edits
from mudline.model.scene.restart import decks_before
from mudline.model.scene.sets import ALL, LONGEST_NAME
from mudline.tools.lsp import places
from mudline.tools.lsp.decks import Analysis, Decks, OpenDocument, address_of, failed
from mudline.tools.lsp.help import file_named, index_of
from mudline.tools.lsp.places import Occurrence, Site, Thing, occurrences, site

Linked = tuple[OpenDocument, Deck]
"""Text of a deck of a chain as a document, open or not, and the deck."""
_NOT_IN_NAMES = ',="{}[]%/\r\n'


class Navigator:
    """Answers about one open deck."""

    def __init__(self, decks: Decks, analysis: Analysis) -> None:
        self.decks = decks
        self.analysis = analysis
        self.at = analysis.document.offset

    # --------------------------------------------------------------------------------------------- definition and uses

    def definition(self, offset: int) -> list[types.Location]:
        """Return the places where the object at an offset is defined; for the name of a file, the file."""
        named = places.at(self.analysis.names, offset)
        if named is not None:
            return [_location(document, use.span) for document, use in self._named(named.thing) if use.defines]
        value = site(self.analysis.deck, offset)
        if value is not None and (file := file_named(value.slot.about.names, self.analysis.deck, value.value)):
            return [types.Location(address_of(file), types.Range(types.Position(0, 0), types.Position(0, 0)))]
        return self._numbered(value) if value else []

    def references(self, offset: int, *, declaration: bool) -> list[types.Location]:
        """Return every place where the object at an offset is used; with `declaration`, also its definitions."""
        named = places.at(self.analysis.names, offset)
        if named is not None:
            uses = self._named(named.thing)
            return [_location(document, use.span) for document, use in uses if declaration or not use.defines]
        value = site(self.analysis.deck, offset)
        file = value and file_named(value.slot.about.names, self.analysis.deck, value.value)
        if file is None:
            return []
        return [
            _location(document, span)
            for document, deck in self._linked()
            for kind, role, name, where in deck.names()
            if role == "names" and file_named(kind, deck, name) == file
            if isinstance(deck.origin, TextOrigin) and (span := deck.origin.span(where))
        ]

    def highlights(self, offset: int) -> list[types.DocumentHighlight]:
        """Return the uses and definitions in this deck only."""
        places = self.references(offset, declaration=True)
        return [types.DocumentHighlight(place.range) for place in places if place.uri == self.analysis.document.uri]

    def _linked(self, thing: Thing | None = None) -> Iterator[Linked]:
        """Yield this deck, the decks that it continues, and the open decks that continue it.

        These are the decks in which an object is the same; a parameter belongs to its deck.
        """
        yield self.analysis.document, self.analysis.deck
        if thing is not None and thing.kind is Names.PARAMETER:
            return
        for base in self.analysis.scene.deck.bases:
            if base.deck.folder is not None and isinstance(base.deck.origin, TextOrigin):
                path = base.deck.folder / Path(base.deck.file).name
                document = self.decks.at(path) or OpenDocument(address_of(path), base.deck.origin.source.text, 0)
                yield document, base.deck
        own = self.analysis.document.path
        for uri in list(self.decks.documents) if own is not None else ():
            other = self.decks.analysis(uri)
            if own is not None and other is not None and other.document.path != own:
                with other.reading():
                    bases = list(map(os.path.abspath, decks_before(other.deck)))
                if os.path.abspath(own) in bases:  # noqa: PTH100 - links stay
                    yield other.document, other.deck

    def _named(self, thing: Thing) -> Iterator[tuple[OpenDocument, Occurrence]]:
        for document, deck in self._linked(thing):
            yield from ((document, use) for use in self._uses(deck, thing))

    def _uses(self, deck: Deck, thing: Thing) -> list[Occurrence]:
        names = self.analysis.names if deck is self.analysis.deck else occurrences(deck)
        return [use for use in names if use.thing == thing]

    def _numbered(self, value: Site) -> list[types.Location]:
        """Return the definition of the node or element whose number stands in a field."""
        scene, kind = self.analysis.scene, value.slot.about.names or value.slot.about.defines
        index = index_of(scene, kind, value.value) if kind in (Names.NODE, Names.ELEMENT) else None
        if index is None or index < 0:
            return []
        where = (scene.nodes if kind is Names.NODE else scene.table.numbered).where(index)
        deck, where = scene.deck.base_of(where) or (self.analysis.deck, where)
        document = next((document for document, linked in self._linked() if linked is deck), None)
        if document is None or not isinstance(deck.origin, TextOrigin):
            return []
        span = deck.origin.span(where.inside(0)) or deck.origin.span(where)
        return [_location(document, span)] if span else []

    # ------------------------------------------------------------------------------------------------------ new names

    def renamed(self, offset: int) -> Occurrence:
        """Return the name at an offset if it can be changed; raises JsonRpcException."""
        named = places.at(self.analysis.names, offset)
        if named is None:
            raise failed("only sets, curves and parameters can be renamed")
        word = named.thing.kind.name.lower()
        if named.thing == Thing(Names.SET, ALL):
            raise failed("set ALL is predefined and cannot be renamed")
        uses = [use for _, use in self._named(named.thing)]
        if not any(use.defines for use in uses):
            where = "by lines that are not read, or nowhere" if word == "set" else "nowhere"
            raise failed(f"{word} {shown(named.name)} is defined {where}: rename it by hand")
        if any(use.composed for use in uses):
            raise failed(f"{word} {shown(named.name)} is an item of a list: rename it by hand")
        return named

    def prepared(self, offset: int) -> types.PrepareRenamePlaceholder:
        """Return the present name for the editor, which asks for it before the new name."""
        named = self.renamed(offset)
        return types.PrepareRenamePlaceholder(self.analysis.document.range(named.span), named.name)

    def rename(self, offset: int, name: str) -> types.WorkspaceEdit:
        """Return the changes that rename the object at an offset in every deck of a chain; raises JsonRpcException."""
        named = self.renamed(offset)
        old, new = named.thing, places.thing(named.thing.kind, name)
        self._check(old, new, name)
        edits_of_files: dict[str, list[types.TextEdit]] = {}
        for document, deck in self._linked(old):
            edits = [TextEdit(use.span, name) for use in self._uses(deck, old)]
            if edits:
                again = occurrences(read_deck(apply_edits(document.text, edits).encode(), document.name))
                if sum(use.thing == new for use in again) < len(edits):
                    raise failed(f"{shown(name)} would not be read as this name everywhere: choose another name")
                edits_of_files[document.uri] = [types.TextEdit(document.range(span), text) for span, text in edits]
        return types.WorkspaceEdit(changes=edits_of_files)

    def _check(self, old: Thing, new: Thing, name: str) -> None:
        word = old.kind.name.lower()
        if not name or name != name.strip() or any(letter in name for letter in _NOT_IN_NAMES):
            raise failed(f"{shown(name)} cannot be the name of a {word}: leave out commas, =, quotes and brackets")
        if len(name) > LONGEST_NAME:
            raise failed(f"a name has at most {LONGEST_NAME} characters, found {len(name)}")
        if old.kind is Names.PARAMETER and not _is_parameter(name):
            raise failed(f"{shown(name)} cannot be used in an equation: use letters, digits and _")
        opaque = old.kind is Names.SET and self.analysis.scene.set_table.find(name) is not None
        if new != old and (opaque or new == Thing(Names.SET, ALL) or any(True for _ in self._named(new))):
            raise failed(f"{word} {shown(name)} is already defined: choose another name")


def _is_parameter(name: str) -> bool:
    """Return True if an equation reads a text as the name of a parameter."""
    try:
        read = parse(name)
    except ExpressionError:
        return False
    return [use.name for use in read.uses] == [name] and name.casefold() not in CONSTANTS


def _location(document: OpenDocument, span: Span) -> types.Location:
    return types.Location(document.uri, document.range(span))
