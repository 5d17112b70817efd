"""Open decks with their findings and scenes, made once for each text, and the decks that depend on others."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from copy import copy
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Self, cast

from pygls.exceptions import JsonRpcException

from mudline.basics.files import Unsaved, recording_looks, with_unsaved
from mudline.basics.outside import refusing_outside
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
from mudline.language.diagnostics import DeckError, Diagnostic, Where
from mudline.language.keywords.text import shown
from mudline.language.keywords.values import Equation
from mudline.model.scene.model import Scene
from mudline.tools.lsp.documents import OpenDocument
from mudline.tools.lsp.places import Occurrence, occurrences

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
