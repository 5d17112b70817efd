"""What breaks the schema of a document, in words, each fault with its path."""

from __future__ import annotations

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from mudline.codes import DOC001, DOC002
from mudline.deck.document_places import DocumentPath, Places, locate
from mudline.deck.model import START, Range
from mudline.diagnostics import DeckError, Diagnostic
from mudline.keywords.text import cut, shown

MOST_TOLD = 1000
"""Faults told of one document."""

_SENTENCES = {
    "list_type": "expected a list",
    "model_type": "expected an object",
    "dict_type": "expected an object",
}
"""Pydantic's kinds of fault in our words; those of the deck's own values have their words already."""


def refusal(file: str, message: str, place: Range = START) -> DeckError:
    """Why a text is no document at all."""
    return DeckError([Diagnostic(file, DOC001.code, DOC001.slug, DOC001.severity, message, *place)])


def decoded(data: bytes, file: str, form: str) -> str:
    """The text of a JSON or YAML file; raises DeckError when it is not UTF-8."""
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        message = f"byte 0x{data[error.start]:02X} is not UTF-8: {form} files are"
        raise refusal(file, message, Range(line, 1, line, 1)) from error


def path_text(path: DocumentPath) -> str:
    """A path as people write it: `sections[0].blocks[2].curves[0].points`."""
    text = "".join(f"[{part}]" if isinstance(part, int) else f".{cut(part)}" for part in path)
    return text.removeprefix(".") or "the document"


class DocumentFaults:
    """Collects what breaks the schema."""

    def __init__(self) -> None:
        self.told: list[tuple[DocumentPath, str]] = []

    def add(self, path: DocumentPath, message: str) -> None:
        """One fault."""
        self.told.append((path, message))

    def extend(self, path: DocumentPath, error: ValidationError) -> None:
        """The faults of a model. A kind of record that pydantic names between angle brackets is no part of a path."""
        for fault in error.errors(include_url=False):
            inner = tuple(part for part in fault["loc"] if not str(part).startswith("<"))
            self.add((*path, *inner), _sentence(fault))

    def raise_any(self, file: str, places: Places) -> None:
        """DeckError with the places of all faults, when there are any."""
        if not self.told:
            return
        told = self.told[:MOST_TOLD]
        if len(self.told) > MOST_TOLD:
            told.append(((), f"{len(self.told) - MOST_TOLD} more faults: only the first are listed"))
        found = zip(told, locate(places, [path for path, _ in told]), strict=True)
        diagnostics = [
            Diagnostic(file, DOC002.code, DOC002.slug, DOC002.severity, f"{path_text(path)}: {message}", *place)
            for (path, message), place in found
        ]
        raise DeckError(sorted(diagnostics, key=lambda diagnostic: diagnostic.sort_key))


def _sentence(fault: ErrorDetails) -> str:
    match fault["type"]:
        case "missing":
            return "is missing"
        case "extra_forbidden":
            return "is not known here"
        case "told":
            return fault["msg"]
        case "literal_error":
            wanted = f"expected {fault['ctx']['expected']}"
        case kind:
            wanted = _SENTENCES.get(kind, fault["msg"])
    return f"{wanted}, found {described(fault['input'])}"


def described(value: object) -> str:
    """A value of a document in words, cut when long."""
    match value:
        case None | bool():
            return {None: "null", True: "true", False: "false"}[value]
        case str():
            return f"the text {shown(value)}"
        case list():
            return "a list"
        case dict():
            return "an object"
        case int() if abs(value) > 10**20:
            return "a whole number of many digits"
        case _:
            return f"the number {value!r}"
