"""Open decks: their texts, with places in the units of the editor, their findings and their scenes.

Findings and scenes are made once for each text.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from copy import copy
from dataclasses import dataclass, field
from functools import cached_property
from itertools import count
from pathlib import Path
from typing import Self, cast

from lsprotocol import types
from pygls.exceptions import JsonRpcException
from pygls.uris import from_fs_path, to_fs_path

from mudline.basics.files import Unsaved, recording_looks, with_unsaved
from mudline.basics.limits import LARGEST_AT_ONCE, LARGEST_OPEN
from mudline.basics.outside import refusing_outside
from mudline.basics.spelling import common_start
from mudline.checks.configuration import ConfigurationError
from mudline.checks.context import LintContext, read_deck
from mudline.checks.engine import LintSettings, lint_context
from mudline.checks.fixing import with_severities
from mudline.checks.registry import UnknownRule, select
from mudline.checks.settings import Settings, nearest_settings
from mudline.language.deck import MARK
from mudline.language.deck.forms import KEYWORD, form_of
from mudline.language.deck.model import Deck
from mudline.language.deck.parameters import NoValueError, Parameters
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import DeckError, Diagnostic, Span, Where
from mudline.language.keywords.text import shown
from mudline.language.keywords.values import Equation
from mudline.language.syntax.source import Source
from mudline.model.scene.model import Scene
from mudline.tools.lsp.places import Occurrence, occurrences

_SURROGATE = re.compile("[\ud800-\udfff]")
_BOM = "\ufeff"
_REVISIONS = count(1)


def _valid(text: str) -> str:
    """Return a text in which halves of UTF-16 pairs, which no file can hold, are replacement characters."""
    return text if text.isascii() else _SURROGATE.sub("\ufffd", text)


def units_of(text: str) -> int:
    """Return the number of UTF-16 units of a text, in which editors count columns."""
    return len(text) if text.isascii() else len(text.encode("utf-16-le")) // 2


def characters_of(line: str, units: int) -> int:
    """Return the number of characters before a column in units; a column inside a character counts as before it."""
    return len(line.encode("utf-16-le")[: 2 * max(units, 0)].decode("utf-16-le", errors="ignore"))


class OpenDocument:
    """An open file.

    Offsets are those of the deck's source, which has no byte-order mark; `text` has none either.

    Attributes:
        uri: address as written by the editor.
        path: path of the file; None for a text that is in no file.
        name: name of the file, in messages and for its form.
        version: the editor's number of the text.
        revision: a number that no other text has in this process.
    """

    def __init__(self, uri: str, text: str, version: int, language: str = "") -> None:
        self.uri = uri
        self.path = file_of(uri)
        self.name = self.path.as_posix() if self.path else _name_of(uri, language)
        self.version = version
        self.replace(text)

    def replace(self, text: str) -> None:
        """Replace the whole text."""
        text = _valid(text)
        self.marked = text.startswith(_BOM)
        self._take(text[1:] if self.marked else text)

    def change(self, range_: types.Range, text: str) -> None:
        """Replace a range by a text. A range that ends before it begins is reversed."""
        start, end = sorted((self.offset(range_.start), self.offset(range_.end)))
        self._take(self.text[:start] + _valid(text) + self.text[end:])

    def _take(self, text: str) -> None:
        self.text = text
        self.source = Source(self.name, text)
        self.revision = next(_REVISIONS)

    def as_file(self) -> bytes:
        """Return the text as the bytes of a file."""
        return self.text.encode()

    @property
    def is_long(self) -> bool:
        """True if the text is too long to be read between two keystrokes."""
        return len(self.text) > LARGEST_AT_ONCE

    @property
    def is_too_large(self) -> bool:
        """True if the text is too long to be checked at all."""
        return len(self.text) > LARGEST_OPEN

    # ---------------------------------------------------------------------------------------------------- places

    def line_at(self, offset: int) -> int:
        """Return the line of an offset, from 0."""
        return self.source.position(offset)[0] - 1

    def offset(self, position: types.Position) -> int:
        """Return the offset of a position; a position beyond a line or the text counts as its end."""
        if position.line >= len(self.source.line_starts):
            return len(self.text)
        span = self.source.line_span(position.line + 1)
        units = position.character - (self.marked and position.line == 0)
        return span.start + characters_of(self.text[slice(*span)], units)

    def position(self, offset: int) -> types.Position:
        """Return the position of an offset."""
        offset = min(max(offset, 0), len(self.text))
        line, column = self.source.position(offset)
        units = units_of(self.text[offset - column + 1 : offset])
        return types.Position(line - 1, units + (self.marked and line == 1))

    def range(self, span: Span) -> types.Range:
        """Return the range of a span."""
        return types.Range(self.position(span.start), self.position(span.end))

    def point(self, line: int, column: int) -> int:
        """Return the offset of a line and column from 1, in characters, as diagnostics have them."""
        return min(self.source.offset(min(line, len(self.source.line_starts)), column), len(self.text))

    # ----------------------------------------------------------------------------------------------------- edits

    def difference(self, content: bytes) -> list[types.TextEdit]:
        """Return the edit that gives a file's content: one change from the first to the last differing line."""
        old, new = self.source.lines(), Source(self.name, content.decode("utf-8-sig")).lines()
        first = common_start(old, new)
        last = common_start(old[first:][::-1], new[first:][::-1])
        start = sum(map(len, old[:first]))
        replaced, text = "".join(old[first : len(old) - last]), "".join(new[first : len(new) - last])
        if replaced == text:
            return []
        return [types.TextEdit(self.range(Span(start, start + len(replaced))), text)]


# --------------------------------------------------------------------------------------------------------- addresses


def file_of(uri: str) -> Path | None:
    """Return the file of an address; None for an invalid address, or anything but a file on this machine."""
    if not uri.startswith("file:///") or "%00" in uri:
        return None
    try:
        path = to_fs_path(uri)
    except ValueError:
        return None
    return Path(path) if path and "\0" not in path else None


def address_of(path: Path) -> str:
    """Return the address of a file."""
    whole = os.path.abspath(path)  # noqa: PTH100 - links stay what they are called
    return from_fs_path(whole) or Path(whole).as_uri()


def _name_of(uri: str, language: str) -> str:
    """Return a name for a text that is in no file; its suffix gives the form."""
    name = uri.rpartition("/")[2].rpartition(":")[2][:100] or "untitled"
    return f"{name}.{language}" if language in ("json", "yaml") and not name.endswith(f".{language}") else name


# ---------------------------------------------------------------------------------------------------------- analyses

_REQUEST_FAILED = -32803
"""Code of the protocol for a request that cannot be fulfilled."""


def failed(message: str) -> JsonRpcException:
    """Return the answer to a request that was understood and cannot be fulfilled."""
    return JsonRpcException(message, _REQUEST_FAILED)


def value_text(value: float | str) -> str:
    """Return a number with at most ten digits, or a text in quotes."""
    return shown(value) if isinstance(value, str) else f"{value:.10g}"


@dataclass
class Analysis:
    """Analysis of one text of a document; it does not change with typing, so that another thread may make it.

    Attributes:
        document: the document.
        settings: settings of the check.
        unsaved: texts of all open decks.
        excluded: True if the configuration excludes the document.
        deck: the deck; empty until it is read, and for a text that is not a deck or too large.
        context: context of the rules; None as long as the deck is empty for that reason.
        found: findings; empty until the deck is checked.
        looked_at: files that the findings depend on.
    """

    document: OpenDocument
    settings: LintSettings
    unsaved: Mapping[str, Unsaved]
    excluded: bool = False
    deck: Deck = field(default_factory=lambda: Deck(""))
    context: LintContext | None = None
    found: tuple[Diagnostic, ...] = ()
    looked_at: frozenset[str] = frozenset()

    @contextmanager
    def reading(self) -> Iterator[None]:
        """Use the texts of open decks in place of files on the disk, and the settings, until the block ends."""
        with with_unsaved(self.unsaved), refusing_outside(lambda _folder: self.settings.no_outside):
            yield

    def read(self) -> Self:
        """Read the deck; its scene and its names are made on first use."""
        document, folder = self.document, self.document.path.parent if self.document.path else None
        is_deck = form_of(document.name) == KEYWORD or MARK in document.text  # other JSON and YAML files are not read
        if is_deck and not document.is_too_large:
            with self.reading():
                self.deck = read_deck(document.as_file(), document.name, units=self.settings.units, folder=folder)
                self.context = LintContext(self.deck, dialect=self.settings.dialect)
        return self

    def checked(self) -> Self:
        """Read and check the deck."""
        with self.reading(), recording_looks() as looks:
            try:
                self.read()
                findings = lint_context(self.context, self.settings.rules) if self.context else []
            except DeckError as error:
                findings = list(error.diagnostics)
        self.found = () if self.excluded else with_severities(findings, self.settings)
        self.looked_at = frozenset(looks)
        return self

    @property
    def is_text(self) -> bool:
        """True for keyword text; False for JSON, YAML and anything but a deck."""
        return isinstance(self.deck.origin, TextOrigin)

    @property
    def origin(self) -> TextOrigin:
        """Lines and places of a keyword text."""
        return cast("TextOrigin", self.deck.origin)

    @cached_property
    def scene(self) -> Scene:
        """Scene, as far as it can be resolved."""
        with self.reading():
            return (self.context or LintContext(self.deck)).scene

    @cached_property
    def names(self) -> list[Occurrence]:
        """Places where a set, a curve or a parameter is named."""
        return occurrences(self.deck)

    @cached_property
    def parameters(self) -> Parameters:
        """Evaluated parameters."""
        return Parameters(self.deck)

    def evaluated(self, equation: Equation) -> str:
        """Return the value of an equation in words, or why it has none."""
        try:
            value = self.parameters.evaluate(equation, Where())
        except NoValueError as reason:
            return f"no value: {reason}" if reason.problem else "no value: a parameter in it has none"
        return value_text(value)


@dataclass
class Decks:
    """Open documents by their addresses, with their analyses; configurations are read once for each folder."""

    documents: dict[str, OpenDocument] = field(default_factory=dict)
    faults: list[str] = field(default_factory=list)
    """Faults of configurations, to be shown once."""
    _analyses: dict[str, Analysis] = field(default_factory=dict)
    _configured: Settings = field(default_factory=nearest_settings)
    _shown: set[str] = field(default_factory=set)

    def open(self, uri: str, text: str, version: int, language: str) -> OpenDocument:
        """Add a document, or replace one that is open already."""
        self._analyses.pop(uri, None)
        document = self.documents[uri] = OpenDocument(uri, text, version, language)
        return document

    def close(self, uri: str) -> OpenDocument | None:
        """Forget a document."""
        self._analyses.pop(uri, None)
        return self.documents.pop(uri, None)

    def forget_configurations(self) -> None:
        """Read all configurations again, since one has changed."""
        self._configured = nearest_settings()
        self._shown.clear()
        self._analyses.clear()

    def forget(self, uri: str) -> None:
        """Analyse a document again, although its own text has not changed."""
        self._analyses.pop(uri, None)

    def begun(self, document: OpenDocument) -> Analysis:
        """Return an analysis of a document in its present state, not read yet."""
        settings, excluded = self._settings(document)
        opened = ((each.path, each) for each in self.documents.values())
        unsaved = {str(path.absolute()): Unsaved(each.revision, each.text.encode) for path, each in opened if path}
        return Analysis(copy(document), settings, unsaved, excluded)

    def keep(self, analysis: Analysis) -> None:
        """Keep an analysis of an open document for its text."""
        self._analyses[analysis.document.uri] = analysis

    def analysis(self, uri: str) -> Analysis | None:
        """Return the analysis of a document in its present state, read and perhaps not checked; None if not open."""
        document = self.documents.get(uri)
        if document is None:
            return None
        analysis = self._analyses.get(uri)
        if analysis is None or analysis.document.revision != document.revision:
            analysis = self.begun(document)
            with suppress(DeckError):
                analysis.read()
            self.keep(analysis)
        return analysis

    def at(self, path: Path) -> OpenDocument | None:
        """Return the open document of a file, or None."""
        name = os.path.abspath(path)  # noqa: PTH100 - LAST= may lead through other folders
        opened = (each for each in self.documents.values() if each.path is not None)
        return next((each for each in opened if os.path.abspath(str(each.path)) == name), None)  # noqa: PTH100 - as above

    def depends(self, uri: str, path: Path) -> bool:
        """Return True if the findings of an open deck depend on a file."""
        analysis = self._analyses.get(uri)
        return analysis is not None and os.path.abspath(path) in analysis.looked_at  # noqa: PTH100 - as `look` records them

    def _settings(self, document: OpenDocument) -> tuple[LintSettings, bool]:
        """Return the settings of a document, and True if its configuration excludes it.

        A faulty configuration is recorded and left out.
        """
        try:
            if document.path is not None:
                path = str(document.path)
                return self._configured.of(path), self._configured.configured.excludes(path)
        except (ConfigurationError, UnknownRule) as error:
            if str(error) not in self._shown:
                self._shown.add(str(error))
                self.faults.append(str(error))
        return LintSettings(select()), False
