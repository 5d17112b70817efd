"""The open decks, each with its findings and its scene, made once for a text, and the decks that depend on others."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from copy import copy
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Self

from pygls.exceptions import JsonRpcException

from mudline.basics.files import Unsaved, recording_looks, with_unsaved
from mudline.basics.outside import refusing_outside
from mudline.basics.patterns import matches
from mudline.checks.configuration import CallerSettings, Configuration, ConfigurationError
from mudline.checks.context import LintContext
from mudline.checks.engine import LintSettings, lint_context, read_deck
from mudline.checks.fixing import with_severities
from mudline.checks.registry import UnknownRule
from mudline.checks.settings import Settings, merged_settings, nearest_settings
from mudline.language.deck import MARK
from mudline.language.deck.forms import KEYWORD, form_of
from mudline.language.deck.model import Deck
from mudline.language.deck.parameters import NoValueError, Parameters
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import DeckError, Diagnostic, Where
from mudline.language.keywords.text import shown
from mudline.language.keywords.values import Equation
from mudline.model.scene.model import Scene
from mudline.tools.lsp.documents import Document
from mudline.tools.lsp.names import Occurrence, occurrences

_REQUEST_FAILED = -32803
"""The protocol's code for such an answer."""


def failed(message: str) -> JsonRpcException:
    """The answer to a request that was understood and cannot be fulfilled."""
    return JsonRpcException(message, _REQUEST_FAILED)


def value_text(value: float | str) -> str:
    """A number with ten digits at most, or a text in quotes."""
    return shown(value) if isinstance(value, str) else f"{value:.10g}"


@dataclass
class Analysis:
    """What is known of one text of a document, which another thread can find out: nothing in here changes with typing.

    `unsaved` are the texts of all open decks. `deck` is None until the text was read, and where it is not a deck, or
    too large; `found` is empty until it was checked. `looked_at` are the files that the findings depend on.
    """

    document: Document
    settings: LintSettings
    unsaved: Mapping[str, Unsaved]
    excluded: bool = False
    deck: Deck | None = None
    context: LintContext | None = None
    found: tuple[Diagnostic, ...] = ()
    looked_at: frozenset[str] = frozenset()

    @contextmanager
    def reading(self) -> Iterator[None]:
        """A block in which the texts of open decks hold before the files on the disk, and settings are heeded."""
        with with_unsaved(self.unsaved), refusing_outside(lambda _folder: self.settings.no_outside):
            yield

    def read(self) -> Self:
        """Read the deck; its scene and its names are found when somebody asks."""
        document, folder = self.document, self.document.path.parent if self.document.path else None
        is_deck = form_of(document.name) == KEYWORD or MARK in document.text  # of JSON and YAML only decks are read
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
                found = lint_context(self.context, self.settings.rules) if self.context else []
            except DeckError as error:
                found = list(error.diagnostics)
        self.found = () if self.excluded else with_severities(found, self.settings)
        self.looked_at = frozenset(looks)
        return self

    @property
    def origin(self) -> TextOrigin | None:
        """Lines and places of a keyword text; None for JSON, YAML and what is not a deck."""
        return self.context.text if self.context else None

    @cached_property
    def scene(self) -> Scene | None:
        """The scene, as far as it can be resolved."""
        with self.reading():
            return self.context.scene if self.context else None

    @cached_property
    def names(self) -> list[Occurrence]:
        """Every place where a set, a curve or a parameter is named."""
        return occurrences(self.deck) if self.deck else []

    @cached_property
    def parameters(self) -> Parameters | None:
        """The parameters, evaluated."""
        return Parameters(self.deck) if self.deck else None

    def evaluated(self, equation: Equation) -> str:
        """The value of an equation in words, or why it has none."""
        if self.parameters is None:
            return ""
        try:
            value = self.parameters.evaluate(equation, Where())
        except NoValueError as reason:
            return f"no value: {reason}" if reason.problem else "no value: a parameter in it has none"
        return value_text(value)

    @property
    def units(self) -> str:
        """The unit system of the deck."""
        return self.deck.units if self.deck else "user"


@dataclass
class Decks:
    """The open documents by their addresses, with their analyses; configurations are read once for a folder."""

    encoding: str = "utf-16"
    documents: dict[str, Document] = field(default_factory=dict)
    faults: list[str] = field(default_factory=list)
    """What is wrong with configurations, to be shown once."""
    _analyses: dict[str, Analysis] = field(default_factory=dict)
    _configured: Settings = field(default_factory=nearest_settings)
    _shown: set[str] = field(default_factory=set)

    def open(self, uri: str, text: str, version: int, language: str) -> Document:
        """Take up a document; one that is open already is replaced."""
        self._analyses.pop(uri, None)
        document = self.documents[uri] = Document(uri, text, version, language, self.encoding)
        return document

    def close(self, uri: str) -> Document | None:
        """Forget a document."""
        self._analyses.pop(uri, None)
        return self.documents.pop(uri, None)

    def forget_configurations(self) -> None:
        """Read all configurations again: one of them has changed."""
        self._configured = nearest_settings()
        self._shown.clear()
        self._analyses.clear()

    def forget(self, uri: str) -> None:
        """Analyse a document again, although its own text has not changed."""
        self._analyses.pop(uri, None)

    def begun(self, document: Document) -> Analysis:
        """An analysis of a document as it is now, of which nothing is read yet."""
        configuration, settings = self._settings(document)
        opened = [each for each in self.documents.values() if each.path]
        unsaved = {str(each.path.absolute()): Unsaved(each.revision, each.text.encode) for each in opened if each.path}
        exclude = configuration.words("exclude")
        excluded = exclude and document.path and matches(configuration.relative(str(document.path)), exclude)
        return Analysis(copy(document), settings, unsaved, bool(excluded))

    def keep(self, made: Analysis) -> None:
        """Keep an analysis of an open document for its text."""
        self._analyses[made.document.uri] = made

    def analysis(self, uri: str) -> Analysis | None:
        """The analysis of a document as it is now, read and perhaps not yet checked; None for one that is not open."""
        document = self.documents.get(uri)
        if document is None:
            return None
        found = self._analyses.get(uri)
        if found is None or found.document.revision != document.revision:
            found = self.begun(document)
            with suppress(DeckError):
                found.read()
            self.keep(found)
        return found

    def at(self, path: Path) -> Document | None:
        """The open document of a file."""
        name = os.path.abspath(path)  # noqa: PTH100 - LAST= may lead through other folders
        opened = (each for each in self.documents.values() if each.path is not None)
        return next((each for each in opened if os.path.abspath(str(each.path)) == name), None)  # noqa: PTH100 - as above

    def depends(self, uri: str, path: Path) -> bool:
        """Whether the findings of an open deck depend on a file."""
        found = self._analyses.get(uri)
        return found is not None and os.path.abspath(path) in found.looked_at  # noqa: PTH100 - as `look` records them

    def _settings(self, document: Document) -> tuple[Configuration, LintSettings]:
        """The configuration of a document and its settings; one with a fault is noted and left out."""
        if document.path is None:
            return Configuration(), merged_settings(Configuration(), CallerSettings())
        try:
            path = str(document.path)
            return self._configured.configured.of(path), self._configured.of(path)
        except (ConfigurationError, UnknownRule) as error:
            self._fault(str(error))
        return Configuration(), merged_settings(Configuration(), CallerSettings())

    def _fault(self, message: str) -> None:
        if message not in self._shown:
            self._shown.add(message)
            self.faults.append(message)
