"""The open decks, each with its findings and its scene, made once for a text, and the decks that depend on others."""

from __future__ import annotations

import os
import time
from collections.abc import Iterator
from contextlib import AbstractContextManager
from dataclasses import field
from functools import cached_property, partial
from pathlib import Path

from pygls.exceptions import JsonRpcException

from mudline.deck import MARK
from mudline.deck.forms import KEYWORD, form_of
from mudline.deck.model import Deck
from mudline.deck.parameters import NoValueError, Parameters
from mudline.deck.reading import TextOrigin
from mudline.diagnostics import DeckError, Diagnostic, Where
from mudline.files import Unsaved, recording_looks, with_unsaved
from mudline.keywords.text import shown
from mudline.keywords.values import Equation
from mudline.lean import dataclass
from mudline.linting.configuration import Configuration, ConfigurationError, Given, Search
from mudline.linting.engine import LintSettings, lint_context, read_deck
from mudline.linting.fixing import with_severities
from mudline.linting.registry import UnknownRule, code_fault
from mudline.linting.rule import LintContext
from mudline.linting.settings import hidden_codes, merged_settings
from mudline.lsp.documents import Document
from mudline.lsp.names import Occurrence, occurrences
from mudline.patterns import matches
from mudline.scene.model import Scene

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
    """What is known of one text of a document.

    `deck` is None where the text is not a deck, or too large. `looked_at` are the files that the findings depend on.
    """

    document: Document
    revision: int
    settings: LintSettings
    deck: Deck | None = None
    context: LintContext | None = None
    found: tuple[Diagnostic, ...] = ()
    looked_at: frozenset[str] = frozenset()
    seconds: float = 0.0
    excluded: bool = False

    @property
    def origin(self) -> TextOrigin | None:
        """Lines and places of a keyword text; None for JSON, YAML and what is not a deck."""
        return self.context.text if self.context else None

    @cached_property
    def scene(self) -> Scene | None:
        """The scene, as far as it can be resolved."""
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
    _search: Search = field(default_factory=lambda: Search(code_fault))
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
        self._search = Search(code_fault)
        self._shown.clear()
        self._analyses.clear()

    def forget(self, uri: str) -> None:
        """Analyse a document again, although its own text has not changed."""
        self._analyses.pop(uri, None)

    def is_current(self, uri: str) -> bool:
        """Whether the analysis of a document is that of its text."""
        found = self._analyses.get(uri)
        return found is not None and found.revision == found.document.revision

    def last(self, uri: str) -> Analysis | None:
        """The last analysis of a document, of whatever text."""
        return self._analyses.get(uri)

    def analysis(self, uri: str) -> Analysis | None:
        """The analysis of a document as it is now; None for one that is not open. Never fails for content."""
        document = self.documents.get(uri)
        if document is None:
            return None
        found = self._analyses.get(uri)
        if found is None or found.revision != document.revision:
            found = self._analyses[uri] = self._made(document)
        return found

    def at(self, path: Path) -> Document | None:
        """The open document of a file."""
        name = os.path.abspath(path)  # noqa: PTH100 - LAST= may lead through other folders
        opened = (each for each in self.documents.values() if each.path is not None)
        return next((each for each in opened if os.path.abspath(str(each.path)) == name), None)  # noqa: PTH100 - as above

    def reading(self) -> AbstractContextManager[None]:
        """A block in which the texts of open decks hold before the files on the disk."""
        return with_unsaved(
            {
                str(each.path.absolute()): Unsaved(each.revision, partial(Document.as_file, each))
                for each in self.documents.values()
                if each.path
            }
        )

    def dependents(self, path: Path) -> Iterator[str]:
        """The addresses of the open decks whose findings depend on a file."""
        name = os.path.abspath(path)  # noqa: PTH100 - as `look` records them
        for uri, found in self._analyses.items():
            if name in found.looked_at:
                yield uri

    def _made(self, document: Document) -> Analysis:
        configuration, settings = self._settings(document)
        made = Analysis(document, document.revision, settings)
        if document.is_too_large or not _is_deck(document):
            return made
        made.excluded = _excluded(configuration, document)
        begun = time.process_time()
        folder = document.path.parent if document.path else None
        with self.reading(), recording_looks() as looks:
            try:
                made.deck = read_deck(document.as_file(), document.name, units=settings.units, folder=folder)
                made.context = LintContext(made.deck, dialect=settings.dialect)
                found = lint_context(made.context, settings.rules)
            except DeckError as error:
                found = list(error.diagnostics)
        made.found = () if made.excluded else with_severities(found, settings)
        made.looked_at = frozenset(looks)
        made.seconds = time.process_time() - begun
        return made

    def _settings(self, document: Document) -> tuple[Configuration, LintSettings]:
        """The configuration of a document and its settings; one with a fault is noted and left out."""
        if document.path is None:
            return Configuration(), merged_settings(Configuration(), Given())
        try:
            found = self._search.nearest(document.path.parent)
            return found, merged_settings(found, Given(), hidden_codes(found, str(document.path)))
        except OSError as error:
            self._fault(f"{error.filename}: the configuration cannot be read: {error.strerror or error}")
        except (ConfigurationError, UnknownRule) as error:
            self._fault(str(error))
        return Configuration(), merged_settings(Configuration(), Given())

    def _fault(self, message: str) -> None:
        if message not in self._shown:
            self._shown.add(message)
            self.faults.append(message)


def _is_deck(document: Document) -> bool:
    """Whether a text is to be read: of JSON and YAML only decks."""
    return form_of(document.name) == KEYWORD or MARK in document.text


def _excluded(found: Configuration, document: Document) -> bool:
    exclude = found.words("exclude")
    return bool(exclude and document.path and matches(found.relative(str(document.path)), exclude))
