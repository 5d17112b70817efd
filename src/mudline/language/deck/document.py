"""Deck as a document of plain values, the form behind JSON and YAML, and back; JSON Schema of that form."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, field, replace
from functools import cache
from typing import Any, cast

from pydantic import BaseModel, TypeAdapter, ValidationError
from pydantic.json_schema import models_json_schema

from mudline.basics.units import UNITS
from mudline.language.deck import MARK
from mudline.language.deck.faults import Faults, Locate, document_path, refusal, respelt
from mudline.language.deck.keyword_text import is_faulty, raw_places, sampled, to_keyword
from mudline.language.deck.model import START, Deck, Opaque, Origin, Range, Section
from mudline.language.deck.reading import TextOrigin, read_source
from mudline.language.diagnostics import DeckError, Problem, Where
from mudline.language.keywords import catalogue
from mudline.language.keywords.contents import is_read, is_refused
from mudline.language.keywords.faults import DocumentPath, shown
from mudline.language.keywords.fields import Comment
from mudline.language.keywords.model import Block
from mudline.language.keywords.table import AS_TABLES, plain
from mudline.language.keywords.text import hint
from mudline.language.keywords.values import Text
from mudline.language.syntax.source import Source
from mudline.language.syntax.tree import canonical_name, mark_of

FORMAT = f"{MARK}1"

Document = dict[str, Any]


def to_document(deck: Deck) -> Document:
    """Return the deck as dicts and lists, its tables as they are; empty values are left out.

    A file name that is not UTF-8 is escaped: JSON and YAML cannot hold its bytes. Raises DeckError for what reading
    would refuse: a value out of range, a raw line that opens a block.
    """
    _require_readable(deck)
    return _document(deck)


def _require_readable(deck: Deck) -> None:
    """Read the document of a deck, with few rows in the tables of blocks that have no value out of range."""

    def locate(path: DocumentPath) -> Range:
        section, block, *_ = (*(part for part in path[:4] if isinstance(part, int)), -1, -1)
        return deck.place(Where(section, block))

    light = sampled(deck)
    for one, whole in zip(light.sections, deck.sections, strict=True):
        pairs = zip(one.blocks, whole.blocks, strict=True)
        one.blocks = [block if is_refused(block) else each for each, block in pairs]
    _DocumentReader(plain(_document(light)), deck.file, locate).read()


def _document(deck: Deck) -> Document:
    source = deck.source.encode("utf-8", "backslashreplace").decode()
    document: Document = {"format": FORMAT, "source": source, "units": deck.units}
    if deck.preamble:
        document["preamble"] = deck.preamble
    document |= _comments(deck.comments)
    document["sections"] = [_section(section) for section in deck.sections]
    return document


def _section(section: Section) -> Document:
    document: Document = {"name": section.name} | _comments(section.comments)
    if section.lines:
        document["lines"] = section.lines
    document["blocks"] = [
        {"keyword": block.keyword, **block.model_dump(exclude={"keyword"}, exclude_unset=True, context=AS_TABLES)}
        for block in section.blocks
    ]
    return document


def _comments(comments: list[Comment]) -> Document:
    return {"comments": [comment.model_dump() for comment in comments]} if comments else {}


class DocumentOrigin(Origin):
    """Places of a deck's values in a JSON or YAML text. A document is read completely or refused."""

    takes_edits = False

    def __init__(self, locate: Locate) -> None:
        self.locate = locate

    def place(self, problem: Problem) -> Range:
        """Return lines and columns of a problem."""
        if problem.where is None:
            return START
        section, block, path = problem.where
        if path[:1] == ("lines",):  # a document has no places within a line
            path = path[:2]
        elif path[-3:-2] == ("text",):
            path = path[:-2]
        return self.locate(document_path(Where(section, block, path)))


@dataclass
class LinesOrigin(TextOrigin):
    """Places in the keyword text of the values of a document whose blocks `raw` are lines.

    `document` knows the places in the file.
    """

    takes_edits = False
    document: Origin = field(default_factory=Origin)
    raw: Collection[Where] = ()

    def place_in_file(self, problem: Problem) -> Range:
        """Lines and columns of a problem in the document: of the line, where a block has lines."""
        where = self.where(problem)
        return START if where is None else self.document.place(replace(problem, span=None, where=where))

    def where(self, problem: Problem) -> Where | None:
        """Return the place of a problem among the values and lines of the document."""
        where, span = problem.where, problem.span
        if span is None and where is not None and where._replace(path=()) in self.raw:
            span = self.span(where)
        if span is not None:
            line = self._line(span.start)
            own = where is not None and where.path and where[:2] == line[:2] and not line.path
            where = where if own else line
        return where

    def _line(self, offset: int) -> Where:
        """The line of a block, a section or the preamble that an offset of the text is in, else the block."""
        spot = self.tree.at(offset)
        line, first = (self.source.position(place)[0] for place in (offset, spot.span.start))
        if spot.where.section < 0:
            return Where(path=("preamble", line - 1))
        if line > first and (spot.block is None or spot.where in self.raw):
            return spot.where.inside("lines", line - first - 1)
        return spot.where


def read_as_text(deck: Deck) -> Deck:
    """Return the deck of a document as it is read from its keyword text; findings have their places in the document.

    What a keyword text cannot say is returned as it is.
    """
    try:
        return _read_as_text(deck)
    except DeckError:
        return deck


def _read_as_text(deck: Deck, *, as_lines: bool = False) -> Deck:
    text = to_keyword(deck, as_lines=as_lines)
    read = read_source(Source.from_bytes(text.encode(), deck.source or deck.file), units=deck.units)
    origin = cast("TextOrigin", read.origin)
    origin = LinesOrigin(origin.tree, origin.read, document=deck.origin, raw=frozenset(raw_places(deck)))
    return replace(read, file=deck.file, source=deck.source, folder=deck.folder, origin=origin)


def decoded(data: bytes, file: str, form: str) -> str:
    """Return the text of a JSON or YAML file; raises DeckError if it is not UTF-8."""
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        before = Source("", error.object[: error.start].decode())
        line, column = before.position(len(before.text))
        message = f"byte 0x{error.object[error.start]:02X} is not UTF-8, which {form} has to be: save the file as UTF-8"
        raise refusal(file, message, Range(line, column, line, column + 1)) from error


def from_document(document: object, file: str, locate: Locate) -> Deck:
    """Return the deck of a document; raises DeckError with path and place of each violation of the schema."""
    return _DocumentReader(document, file, locate).read()


@cache
def _adapter(kind: Any) -> TypeAdapter[Any]:
    return TypeAdapter(kind)


class _DocumentReader:
    def __init__(self, document: object, file: str, locate: Locate) -> None:
        self.document = document
        self.faults = Faults(file, locate, document)
        self.deck = Deck(file, origin=DocumentOrigin(locate))

    def read(self) -> Deck:
        document = self._format()
        deck = self.deck
        self._only(document, ("format", "source", "units", "preamble", "comments", "sections"), ())
        deck.source = self._checked(str, document.get("source", ""), ("source",), "")
        deck.units = document.get("units", "user")
        if deck.units not in tuple(UNITS):  # it may be a list
            self.faults.add(("units",), f"expected one of {', '.join(UNITS)}, found {shown(deck.units)}")
        deck.preamble = self._lines(document.get("preamble", []), ("preamble",), "$")
        deck.comments = self._checked(list[Comment], document.get("comments", []), ("comments",), [])
        sections = document.get("sections")
        if isinstance(sections, list):
            for index, item in enumerate(sections):
                deck.sections.append(self._section(item, index))
        else:
            self.faults.add(("sections",), "expected a list of sections")
        self.faults.raise_any()
        if deck.preamble or deck.comments or any(map(_has_lines, deck.sections)):
            deck = self._as_text()
        self.faults.raise_respelt(deck)
        return deck

    def _as_text(self) -> Deck:
        """Return the deck as read from its keyword text, which gives comments and lines their places and findings.

        Raises DeckError if keyword text cannot express the deck, for a deck that has a block with a model as lines.
        """
        deck = self.deck
        try:
            read = _read_as_text(deck, as_lines=True)
        except DeckError:
            blocks = deck.every_block()
            if any(type(block) is Opaque and catalogue.block_class(name, block.keyword) for _, name, block in blocks):
                raise
            return deck
        origin = cast("LinesOrigin", read.origin)
        if any(map(is_faulty, origin.read.values())):
            return read
        problems = [replace(each, span=None, where=origin.where(each), repair=None) for each in read.problems]
        return replace(read, origin=deck.origin, problems=problems)

    def _format(self) -> dict[str, Any]:
        if isinstance(self.document, dict):
            name = self.document.get("format")
            if name == FORMAT:
                return self.document
            self.faults.add(("format",), f"expected {FORMAT!r}, found {shown(name)}")
        else:
            name = type(self.document).__name__
            self.faults.add((), f"expected an object whose format is {FORMAT!r}, found {name}")
        self.faults.raise_any()
        raise AssertionError

    def _only(self, mapping: dict[str, Any], known: tuple[str, ...], path: DocumentPath) -> None:
        for key in mapping:
            if key not in known:
                self.faults.add((*path, key), f"unknown key: expected {', '.join(known)}")

    def _checked(self, kind: Any, value: object, path: DocumentPath, otherwise: Any) -> Any:
        """Return the value validated as a type; `otherwise` if it is invalid."""
        try:
            return _adapter(kind).validate_python(value, strict=True)
        except ValidationError as error:
            self.faults.extend(path, error)
            return otherwise

    def _lines(self, value: object, path: DocumentPath, openers: str) -> list[str]:
        """Return raw lines; a line that opens a section or a block is a fault."""
        lines: list[str] = self._checked(list[Text], value, path, [])
        for index, line in enumerate(lines):
            mark = mark_of(line)
            if mark and mark in openers:
                self.faults.add((*path, index), f"a line that begins with {mark} opens a section or a block")
        return lines

    def _section(self, item: object, index: int) -> Section:
        path: DocumentPath = ("sections", index)
        section = Section("")
        if not isinstance(item, dict):
            self.faults.add(path, "expected a section: an object with name and blocks")
            return section
        self._only(item, ("name", "lines", "comments", "blocks"), path)
        section.name = canonical_name("$" + self._checked(Text, item.get("name"), (*path, "name"), ""))
        section.lines = self._lines(item.get("lines", []), (*path, "lines"), "$*")
        section.comments = self._checked(list[Comment], item.get("comments", []), (*path, "comments"), [])
        blocks = item.get("blocks")
        if not isinstance(blocks, list):
            self.faults.add((*path, "blocks"), "expected a list of blocks")
            return section
        for number, block in enumerate(blocks):
            read = self._block(section.name, block, (*path, "blocks", number))
            if read is not None:
                section.blocks.append(read)
        return section

    def _block(self, section: str, item: object, path: DocumentPath) -> Block | Opaque | None:
        if not isinstance(item, dict) or not isinstance(item.get("keyword"), str):
            self.faults.add(path, "expected a block: an object with its keyword")
            return None
        declared = None if "lines" in item else catalogue.block_class(section, item["keyword"])
        if declared is None and "lines" not in item:
            message = f"*{item['keyword']} in ${section} has no model: expected its raw lines under `lines`"
            near = catalogue.meant_in(item["keyword"], section)
            declared = catalogue.block_class(section, near) if near else None
            if declared is None:
                self.faults.add(path, message)
                return None
            self.faults.respell((*path, "keyword"), f"{message}{hint(near)}")
            item = {**item, "keyword": near}
        try:
            if declared:
                return declared.model_validate(item)
            block = Opaque.model_validate(item)
        except ValidationError as error:
            if declared and (corrected := respelt(item, declared, error)):
                for inner, message in corrected[1]:
                    self.faults.respell((*path, *inner), message)
                return corrected[0]
            self.faults.extend(path, error)
            return None
        block.keyword = canonical_name("*" + block.keyword)
        self._lines(block.lines, (*path, "lines"), "$*")
        return block


def _has_lines(section: Section) -> bool:
    """Return True if a section has comments, unread lines, or a name that is not known."""
    has_lines = section.lines or section.comments or section.name not in catalogue.SECTIONS
    return bool(has_lines) or any(isinstance(block, Opaque) or not is_read(block) for block in section.blocks)


def json_schema() -> dict[str, Any]:
    """Return the schema: document, sections, every block with a model, the block without a model.

    The schema does not restrict keywords to their sections, since a deck may hold a keyword in the wrong section.
    """
    blocks = catalogue.block_classes()
    models: list[type[BaseModel]] = [*blocks, Opaque, Comment]
    schemas, schema = models_json_schema([(model, "validation") for model in models], ref_template="#/$defs/{model}")
    references = {model: schemas[model, "validation"] for model in models}
    for block in blocks:
        definition = schema["$defs"][references[block]["$ref"].rsplit("/", 1)[1]]
        definition["required"] = sorted({"keyword", *definition.get("required", [])})
        definition["description"] = block.summary
    raw = schema["$defs"][references[Opaque]["$ref"].rsplit("/", 1)[1]]
    raw["description"] = (
        "the lines of a keyword without a model, or of a block that cannot be read: as they are written"
    )
    comments = {"type": "array", "items": references[Comment]}
    line = TypeAdapter(Text).json_schema()
    lines = {"type": "array", "items": line}
    section = _object(
        {
            "name": {**line, "description": "section name without the $"},
            "lines": {**lines, "description": "stray lines before the first keyword"},
            "comments": comments,
            "blocks": {
                "type": "array",
                "items": {"anyOf": [references[model] for model in models if model is not Comment]},
            },
        },
        required=("name", "blocks"),
    )
    document = _object(
        {
            "format": {"const": FORMAT},
            "source": {"type": "string", "description": "name of the file that the deck was read from"},
            "units": {"enum": list(UNITS)},
            "preamble": {**lines, "description": "lines before the first section"},
            "comments": comments,
            "sections": {"type": "array", "items": {"$ref": "#/$defs/Section"}},
        },
        required=("format", "sections"),
    )
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "mudline deck",
        **document,
        "$defs": {**schema["$defs"], "Section": section},
    }


def _object(properties: dict[str, Any], required: tuple[str, ...]) -> dict[str, Any]:
    return {"type": "object", "properties": properties, "required": list(required), "additionalProperties": False}
