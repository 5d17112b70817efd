"""Faults of a document against its schema, each with its path and its place in the file."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Sequence
from copy import deepcopy
from typing import Any, NoReturn

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from mudline.basics.limits import LONGEST_MESSAGE, MOST_REPORTED
from mudline.basics.short_repr import cut, printable
from mudline.basics.spelling import meant_names
from mudline.language.codes import DOC001, DOC002
from mudline.language.deck.model import START, Deck, Range
from mudline.language.diagnostics import MORE, DeckError, Diagnostic, Where
from mudline.language.keywords.faults import DocumentPath, fault_in_words, holds, path_in, path_text, shown
from mudline.language.keywords.model import Block, Part, record_schema
from mudline.language.keywords.text import hint

Locate = Callable[[DocumentPath], Range]


def refusal(file: str, message: str, place: Range = START) -> DeckError:
    """Why a text is not a document at all."""
    return DeckError([Diagnostic(file, DOC001.code, DOC001.slug, DOC001.severity, message, *place)])


def document_path(where: Where) -> DocumentPath:
    """The path of a place in a document."""
    section, block, path = where
    start: DocumentPath = () if section < 0 else ("sections", section)
    return (*start, *(() if block < 0 else ("blocks", block)), *path)


class MisspeltDeckError(DeckError):
    """A document in which only names are misspelt; `meant` is the deck with those that were meant."""

    def __init__(self, diagnostics: Sequence[Diagnostic], meant: Deck) -> None:
        super().__init__(diagnostics)
        self.meant = meant

    def __reduce__(self) -> tuple[type[DeckError], tuple[tuple[Diagnostic, ...]]]:
        return DeckError, (self.diagnostics,)


class Faults:
    """Collects the faults of a document; when there are too many, it is refused at once."""

    def __init__(self, file: str, locate: Locate, document: object) -> None:
        self.file = file
        self.locate = locate
        self.document = document
        self.found: list[tuple[Range, str]] = []
        self.respelt = 0

    def add(self, path: DocumentPath, message: str) -> None:
        """One fault; raises DeckError when it is one too many."""
        if len(self.found) == MOST_REPORTED:
            self.found.append((self.locate(path), MORE))
            self._refuse()
        self.found.append((self.locate(path), f"{path_text(path)}: {message}"))

    def extend(self, path: DocumentPath, error: ValidationError) -> None:
        """The faults of a model; of a choice between forms, those of the form that fits best."""
        known: dict[DocumentPath, list[ErrorDetails]] = {}
        placed = [((*path, *fault["loc"]), fault) for fault in error.errors(include_url=False)]
        steps = {loc: self._alternatives(loc, len(path), fault["type"]) for loc, fault in placed}
        unfit = _unfit(placed, steps)
        for loc, fault in placed:
            if all(loc[: step + 1] not in unfit for step in steps[loc]):
                real = tuple(part for index, part in enumerate(loc) if index not in steps[loc])
                known.setdefault(real, []).append(fault)
        deepest = max(known, key=len)
        around = {inner[:length] for inner in known for length in range(len(inner))}
        for inner, faults in known.items():
            if inner not in around or inner == deepest:
                self.add(inner, fault_in_words(faults))

    def respell(self, path: DocumentPath, message: str) -> None:
        """A fault of spelling, in spite of which the rest is read as it was meant."""
        self.respelt += 1
        self.add(path, message)

    def raise_any(self) -> None:
        """DeckError when there were any, unless all are of spelling."""
        if len(self.found) > self.respelt:
            self._refuse()

    def raise_respelt(self, meant: Deck) -> None:
        """MisspeltDeckError when there were faults of spelling; `meant` is the deck without them."""
        if self.found:
            raise MisspeltDeckError(self._diagnosed(), meant)

    def _refuse(self) -> NoReturn:
        raise DeckError(self._diagnosed())

    def _diagnosed(self) -> list[Diagnostic]:
        kind = DOC002.code, DOC002.slug, DOC002.severity
        messages = ((place, printable(cut(words, LONGEST_MESSAGE))) for place, words in self.found)
        found = (Diagnostic(self.file, *kind, message, *place, blocks=True) for place, message in messages)
        return sorted(found, key=lambda diagnostic: diagnostic.sort_key)

    def _alternatives(self, loc: DocumentPath, given: int, kind: str) -> set[int]:
        """Which steps of a path, behind the given ones, are names of alternatives that pydantic puts in."""
        found: set[int] = set()
        value: Any = self.document
        for index, part in enumerate(loc):
            if holds(value, part):
                value = value[part]
            elif isinstance(value, str) and isinstance(part, int):
                pass  # a row or a cell of a table that is a text
            elif index >= given and (kind != "missing" or index < len(loc) - 1):
                found.add(index)
        return found


def _unfit(placed: list[tuple[DocumentPath, ErrorDetails]], steps: dict[DocumentPath, set[int]]) -> set[DocumentPath]:
    """The alternatives whose mandatory key is missing, where another one has all of its mandatory keys."""
    lacking: dict[DocumentPath, bool] = {}
    for loc, fault in placed:
        for step in steps[loc]:
            below = [index for index in range(step + 1, len(loc)) if index not in steps[loc]]
            wrong = not below or (len(below) == 1 and fault["type"] == "missing")
            lacking[loc[: step + 1]] = wrong or lacking.get(loc[: step + 1], False)
    choices = {inner[:-1] for inner, wrong in lacking.items() if not wrong}
    return {inner for inner, wrong in lacking.items() if wrong and inner[:-1] in choices}


_QUOTED = re.compile(r"'([^']*)'")


Misspelt = list[tuple[DocumentPath, str]]


def respelt(given: dict[str, Any], declared: type[Block], error: ValidationError) -> tuple[Block, Misspelt] | None:
    """The block that a document means, and what is misspelt; None where more is wrong in it than that."""
    meant = deepcopy(given)
    faults: Misspelt = []
    for fault in error.errors(include_url=False):
        path = path_in(given, fault["loc"])
        holder = _inside(meant, path[:-1])
        last = path[-1] if path else ""
        if fault["type"] == "extra_forbidden" and isinstance(holder, dict) and last in holder:
            if name := _near(str(last), _keys(declared, path[:-1]) - holder.keys()):
                holder[name] = holder.pop(last)
                faults.append((path, f"unknown key{hint(name)}"))
        elif fault["type"] == "literal_error" and isinstance(holder, dict) and isinstance(holder.get(last), str):
            expected = fault["ctx"]["expected"]
            if name := _near(holder[last], _QUOTED.findall(expected)):
                faults.append((path, f"expected {expected}, found {shown(holder[last])}{hint(name)}"))
                holder[last] = name
    try:
        return (declared.model_validate(meant), faults) if faults else None
    except ValidationError:
        return None


def _inside(value: Any, path: DocumentPath) -> object:
    for step in path:
        if not holds(value, step):
            return None
        value = value[step]
    return value


def _near(word: str, known: Collection[str]) -> str:
    """The one name that was meant by a word, or ""."""
    folded = {name.casefold(): name for name in known}
    near = meant_names(word.casefold(), folded)
    return folded[near[0]] if len(near) == 1 else ""


def _keys(part: type[Part], path: DocumentPath) -> set[str]:
    """The keys that an object of a document may have at a path of a block."""
    parts: list[type[Part]] = [part]
    for step in path:
        if isinstance(step, str):
            slots = [slot for each in parts for slot in record_schema(each).slots if slot.json == step]
            parts = [inner for slot in slots for inner in slot.parts]
    return {slot.json for each in parts for slot in record_schema(each).slots}
