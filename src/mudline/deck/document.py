"""A deck as a document of plain values, the form behind JSON and YAML, and back, with the path of every fault."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from pydantic import TypeAdapter, ValidationError

from mudline.codes import DOC001, DOC002
from mudline.deck.model import START, Deck, Opaque, Range, Section
from mudline.diagnostics import DeckError, Diagnostic, Problem, Where
from mudline.keywords import catalogue
from mudline.keywords.listing import AS_TABLES
from mudline.keywords.model import Block, Comment
from mudline.syntax.tree import canonical_name

FORMAT = "mudline-deck/1"
UNITS = ("metric", "imperial", "user")

Document = dict[str, Any]
DocumentPath = tuple[str | int, ...]
Locate = Callable[[DocumentPath], Range]

_COMMENTS = TypeAdapter(list[Comment])
_LINES = TypeAdapter(list[str])


def to_document(deck: Deck) -> Document:
    """The deck as dicts and lists, its tables as listings; empty things are left out."""
    document: Document = {"format": FORMAT, "source": deck.source, "units": deck.units}
    if deck.preamble:
        document["preamble"] = deck.preamble
    document |= _comments(deck.comments)
    document["sections"] = [_section(section) for section in deck.sections]
    return document


def _section(section: Section) -> Document:
    document: Document = {"name": section.name} | _comments(section.comments)
    if section.lines:
        document["lines"] = section.lines
    document["blocks"] = [_block(block) for block in section.blocks]
    return document


def _block(block: Block | Opaque) -> Document:
    values = block.model_dump(exclude_unset=True, context=AS_TABLES)
    return {"keyword": values.pop("keyword"), **values}


def _comments(comments: list[Comment]) -> Document:
    return {"comments": [comment.model_dump() for comment in comments]} if comments else {}


@dataclass
class DocumentOrigin:
    """Where the values of a deck stand in a JSON or YAML text."""

    locate: Locate

    def place(self, problem: Problem) -> Range:
        """Lines and columns of a problem."""
        if problem.where is None:
            return START
        section, block, path = problem.where
        start: DocumentPath = () if section < 0 else ("sections", section)
        return self.locate(start + (() if block < 0 else ("blocks", block)) + path)

    def damaged(self, where: Where) -> bool:
        """A document is whole or refused."""
        return False

    def lost(self, section: int, block: int) -> int:
        """A document is whole or refused."""
        return 0

    def written(self, where: Where) -> bool:
        """Values that are absent are None in the models."""
        return True


def refusal(file: str, message: str, place: Range = START) -> DeckError:
    """Why a text is no document at all."""
    return DeckError([Diagnostic(file, DOC001.code, DOC001.slug, DOC001.severity, message, *place)])


def _holds(value: object, part: str | int) -> bool:
    """Whether a document has something at a key or an index."""
    if isinstance(value, dict):
        return part in value
    return isinstance(value, list) and isinstance(part, int) and part < len(value)


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
    text = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in path)
    return text.removeprefix(".") or "the document"


class _Faults:
    """Collects what breaks the schema, with its place in the file."""

    def __init__(self, file: str, locate: Locate, document: object) -> None:
        self.deck = Deck(file)
        self.locate = locate
        self.document = document
        self.places: dict[int, Range] = {}
        self.problems: list[Problem] = []

    def add(self, path: DocumentPath, message: str) -> None:
        """One fault."""
        problem = Problem(DOC002, f"{path_text(path)}: {message}")
        self.places[id(problem)] = self.locate(path)
        self.problems.append(problem)

    def extend(self, path: DocumentPath, error: ValidationError) -> None:
        """The faults of a model; of a choice between forms, those of the form that fits best."""
        known: dict[DocumentPath, list[str]] = {}
        for fault in error.errors(include_url=False):
            inner = self._real_path((*path, *fault["loc"]))
            if fault["type"] != "is_instance_of":
                known.setdefault(inner, []).append(fault["msg"].removeprefix("Value error, "))
        deepest = max(known, key=len)
        for inner, messages in known.items():
            if not any(other != inner and other[: len(inner)] == inner for other in known) or inner == deepest:
                self.add(inner, "; or ".join(dict.fromkeys(messages)))

    def _real_path(self, loc: DocumentPath) -> DocumentPath:
        """The path without the names of alternatives that pydantic puts in."""
        found: list[str | int] = []
        value: Any = self.document
        for part in loc:
            if _holds(value, part):
                value = value[part]
            elif part != loc[-1] or not isinstance(value, dict):
                continue
            found.append(part)
        return tuple(found)

    def place(self, problem: Problem) -> Range:
        """Lines and columns of a fault."""
        return self.places[id(problem)]

    def raise_any(self) -> None:
        """DeckError when there were any."""
        if self.problems:
            self.deck.origin = _Placed(self.place)
            raise DeckError(self.deck.diagnose(self.problems))


class _Placed(DocumentOrigin):
    def __init__(self, place: Callable[[Problem], Range]) -> None:
        super().__init__(lambda _: START)
        self._place = place

    def place(self, problem: Problem) -> Range:
        return self._place(problem)


def from_document(document: object, file: str, locate: Locate) -> Deck:
    """The deck of a document; raises DeckError with the path and place of everything that breaks the schema."""
    faults = _Faults(file, locate, document)
    if not isinstance(document, dict) or document.get("format") != FORMAT:
        found = document.get("format") if isinstance(document, dict) else type(document).__name__
        faults.add(("format",) if isinstance(document, dict) else (), f"expected {FORMAT!r}, found {found!r}")
        faults.raise_any()
        raise AssertionError
    _only(document, ("format", "source", "units", "preamble", "comments", "sections"), (), faults)
    deck = Deck(file, origin=DocumentOrigin(locate))
    deck.source = _text(document.get("source", ""), ("source",), faults)
    deck.units = document.get("units", "user")
    if deck.units not in UNITS:
        faults.add(("units",), f"expected one of {', '.join(UNITS)}, found {deck.units!r}")
    deck.preamble = _checked(_LINES, document.get("preamble", []), ("preamble",), faults)
    deck.comments = _checked(_COMMENTS, document.get("comments", []), ("comments",), faults)
    sections = document.get("sections")
    if isinstance(sections, list):
        deck.sections = [_read_section(found, ("sections", i), faults) for i, found in enumerate(sections)]
    else:
        faults.add(("sections",), "expected a list of sections")
    faults.raise_any()
    return deck


def _only(given: dict[str, Any], known: tuple[str, ...], path: DocumentPath, faults: _Faults) -> None:
    for key in given:
        if key not in known:
            faults.add((*path, key), f"unknown key: expected {', '.join(known)}")


def _text(value: object, path: DocumentPath, faults: _Faults) -> str:
    if isinstance(value, str):
        return value
    faults.add(path, f"expected a text, found {value!r}")
    return ""


def _checked(adapter: TypeAdapter[Any], value: object, path: DocumentPath, faults: _Faults) -> Any:
    try:
        return adapter.validate_python(value, strict=True)
    except ValidationError as error:
        faults.extend(path, error)
        return []


def _read_section(given: object, path: DocumentPath, faults: _Faults) -> Section:
    if not isinstance(given, dict):
        faults.add(path, "expected a section: an object with name and blocks")
        return Section("")
    _only(given, ("name", "lines", "comments", "blocks"), path, faults)
    section = Section(canonical_name("$" + _text(given.get("name"), (*path, "name"), faults)))
    section.lines = _checked(_LINES, given.get("lines", []), (*path, "lines"), faults)
    section.comments = _checked(_COMMENTS, given.get("comments", []), (*path, "comments"), faults)
    blocks = given.get("blocks")
    if not isinstance(blocks, list):
        faults.add((*path, "blocks"), "expected a list of blocks")
        return section
    for index, block in enumerate(blocks):
        read = _read_block(section.name, block, (*path, "blocks", index), faults)
        if read is not None:
            section.blocks.append(read)
    return section


def _read_block(section: str, given: object, path: DocumentPath, faults: _Faults) -> Block | Opaque | None:
    if not isinstance(given, dict) or not isinstance(given.get("keyword"), str):
        faults.add(path, "expected a block: an object with its keyword")
        return None
    declared = None if "lines" in given else catalogue.block_class(section, given["keyword"])
    if declared is None and "lines" not in given:
        faults.add(path, f"*{given['keyword']} in ${section} has no model: expected its raw lines under `lines`")
        return None
    try:
        return (declared or Opaque).model_validate(given)
    except ValidationError as error:
        faults.extend(path, error)
        return None
