"""Deck as a document of plain values, the form behind JSON and YAML, and back; JSON Schema of that form."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

from pydantic import BaseModel, TypeAdapter, ValidationError
from pydantic.json_schema import models_json_schema

from mudline.basics.quantities import UNIT_SYSTEMS
from mudline.language.codes import DOC002
from mudline.language.deck import MARK
from mudline.language.deck.document_text import read_as_text
from mudline.language.deck.faults import Faults, Locate, document_path, refusal, respelt
from mudline.language.deck.faulty_blocks import is_faulty
from mudline.language.deck.keyword_text import sampled
from mudline.language.deck.likeness import RawLines
from mudline.language.deck.model import START, Deck, Opaque, Origin, Range, Section
from mudline.language.deck.reading import Findings
from mudline.language.diagnostics import Problem, Severity, Where
from mudline.language.keywords import catalogue
from mudline.language.keywords.contents import is_read, is_refused
from mudline.language.keywords.faults import DocumentPath, shown
from mudline.language.keywords.fields import Comment
from mudline.language.keywords.model import Block
from mudline.language.keywords.reader import read_block
from mudline.language.keywords.table import AS_TABLES, Table
from mudline.language.keywords.text import hint
from mudline.language.keywords.values import Text
from mudline.language.keywords.writer import block_lines
from mudline.language.syntax.source import Source
from mudline.language.syntax.tree import Leaf, LeafKind, canonical_name, mark_of, parse

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
        return deck.place(Problem(DOC002, "", where=Where(section, block)))

    light = sampled(deck)
    for one, whole in zip(light.sections, deck.sections, strict=True):
        pairs = zip(one.blocks, whole.blocks, strict=True)
        one.blocks = [block if is_refused(block) else each for each, block in pairs]
    _DocumentReader(_plain(_document(light)), deck.file, locate).read()


def _plain(value: Any) -> Any:
    """A document with its tables as lists."""
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, Table):
        return value.rows()
    return [_plain(item) for item in value] if isinstance(value, list) else value


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
    document["blocks"] = [_block(block) for block in section.blocks]
    return document


def _block(block: Block | Opaque) -> Document:
    values = block.model_dump(exclude={"keyword"}, exclude_unset=True, context=AS_TABLES)
    return {"keyword": block.keyword, **values}


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
        self.findings = Findings(self.deck.problems)
        self.unreadable: list[Problem] = []
        """Faults of blocks that are given as lines."""

    def read(self) -> Deck:
        document = self._format()
        deck = self.deck
        self._only(document, ("format", "source", "units", "preamble", "comments", "sections"), ())
        deck.source = self._checked(str, document.get("source", ""), ("source",), "")
        deck.units = document.get("units", "user")
        if deck.units not in UNIT_SYSTEMS:
            self.faults.add(("units",), f"expected one of {', '.join(UNIT_SYSTEMS)}, found {shown(deck.units)}")
        deck.preamble = self._lines(document.get("preamble", []), ("preamble",), "$")
        if deck.preamble:
            self._stray(deck.preamble, "before the first section", Where(path=("preamble",)))
        deck.comments = self._checked(list[Comment], document.get("comments", []), ("comments",), [])
        sections = document.get("sections")
        if isinstance(sections, list):
            for index, item in enumerate(sections):
                deck.sections.append(self._section(item, index))
        else:
            self.faults.add(("sections",), "expected a list of sections")
        self.faults.raise_any()
        normalise_comments(deck)
        if self.unreadable:
            deck = self._from_lines()
        self.faults.raise_respelt(deck)
        return deck

    def _from_lines(self) -> Deck:
        """The deck read as its keyword text, as lines of a block are at fault."""
        self.deck.problems += self.unreadable
        deck = read_as_text(self.deck)
        if deck is self.deck:  # a keyword text cannot say it
            for problem in self.unreadable:
                self.faults.add(document_path(problem.where or Where()), problem.message)
            self.faults.raise_any()
        return deck

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

    def _stray(self, lines: list[str], words: str, where: Where) -> tuple[list[str], list[str]]:
        """Report lines under no keyword or in no section; return the data lines and the texts of comments."""
        text = "\n".join(lines)
        tree = parse(Source("", text)).preamble

        def place(leaf: Leaf) -> Where:
            return where._replace(path=(*where.path, text.count("\n", 0, leaf.span.start)))

        def inner(leaf: Leaf) -> list[str]:
            return text[slice(*leaf.span)].removesuffix("\n").split("\n")

        data = [leaf for leaf in tree.leaves if leaf.kind not in (LeafKind.BLANK, LeafKind.COMMENT)]
        stray = [line for leaf in data for line in inner(leaf)]
        if data:
            self.findings.stray(len(stray), words, None, place(data[0]))
        for block in tree.blocks:
            self.findings.before_sections(block.name, None, place(block.head))
        return stray, [inner(leaf)[0][1:] for leaf in tree.leaves if leaf.kind is LeafKind.COMMENT]

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
        if section.name not in catalogue.SECTIONS:
            self.findings.unknown_section(section.name, Where(index))
        if section.lines:
            section.lines, texts = self._stray(section.lines, f"of ${section.name}", Where(index, -1, ("lines",)))
            section.comments[:0] = [Comment(before=0, text=text) for text in texts]
        blocks = item.get("blocks")
        if not isinstance(blocks, list):
            self.faults.add((*path, "blocks"), "expected a list of blocks")
            return section
        for number, block in enumerate(blocks):
            read = self._block(section.name, block, (*path, "blocks", number))
            if isinstance(read, Opaque):
                read = self._with_model(read, section, Where(index, number, ("lines",)))
            elif read is not None and not is_read(read):
                lines = [*block_lines(read)][1:]
                read = self._with_model(Opaque(keyword=read.keyword, lines=lines), section, Where(index, number))
            if read is not None:
                section.blocks.append(read)
        return section

    def _with_model(self, block: Opaque, section: Section, where: Where) -> Block | Opaque:
        """Return the model that raw lines describe, read like keyword text, if the keyword has a model.

        `where` is the block, or its lines if the document gives the block as raw lines.
        """
        declared = catalogue.block_class(section.name, block.keyword)
        source = Source("", "\n".join(["$S", f"*{block.keyword}", *block.lines, ""]))
        raw = parse(source).sections[0].blocks[0]
        lines = RawLines(source.text, raw)
        if declared is None:
            self.findings.no_model(block.keyword, section.name, where._replace(path=()), lines)
            return block
        read = read_block(source.text, raw, declared, last=False)
        if read.opaque:
            self.findings.no_model(block.keyword, section.name, where._replace(path=()), lines)
        faulty = bool(where.path) and is_faulty(read)
        if faulty and not any(one.weight is Severity.ERROR for one in read.problems):
            self.unreadable.append(Problem(DOC002, "a value that a document does not hold", where=where))
        for problem in read.problems:
            line = source.position(problem.span.start)[0] if problem.span else 0
            inside = where.inside(max(line - 3, 0)) if where.path else where
            placed = replace(problem, span=None, where=inside, repair=None)
            if problem.weight is not Severity.ERROR:
                self.deck.problems.append(placed)
            elif faulty:
                self.unreadable.append(placed)
            else:
                self.faults.add(document_path(inside), problem.message)
        if read.opaque or faulty:
            return block
        section.comments[:0] = [Comment(before=where.block + 1, text=text) for text in read.trailing]
        return read.model

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
                for inner, message in corrected.faults:
                    self.faults.respell((*path, *inner), message)
                return corrected.block
            self.faults.extend(path, error)
            return None
        block.keyword = canonical_name("*" + block.keyword)
        self._lines(block.lines, (*path, "lines"), "$*")
        return block


def normalise_comments(deck: Deck) -> None:
    """Move comments to the owner that keyword text would give them; the written deck stays the same.

    Comments before the first section become lines of the preamble. Comments behind a block without a model become lines
    of the block. Comments at the end of a section move before the next section. An index beyond the last item means
    behind the last item.
    """
    waiting = sorted(deck.comments, key=lambda comment: comment.before)[::-1]
    deck.comments = []
    while waiting and (waiting[-1].before == 0 or not deck.sections):
        deck.preamble.append(f"C{waiting.pop().text}")
    for number, section in enumerate(deck.sections, 1):
        following = _normalise_section(section)
        while waiting and (waiting[-1].before <= number or number == len(deck.sections)):
            following.append(waiting.pop().text)
        last = section.blocks[-1] if section.blocks else None
        if last is None:
            section.comments += [Comment(before=0, text=text) for text in following]
        elif isinstance(last, Opaque):
            last.lines += [f"C{text}" for text in following]
        else:
            deck.comments += [Comment(before=number, text=text) for text in following]


def _normalise_section(section: Section) -> list[str]:
    """Move the comments of a section to their owners; return the texts behind the last block."""
    following: list[str] = []
    comments = sorted(section.comments, key=lambda comment: comment.before)
    section.comments = []
    for comment in comments:
        before = min(comment.before, len(section.blocks))
        owner = section.blocks[before - 1] if before else None
        if before and before == len(section.blocks):
            following.append(comment.text)
        elif isinstance(owner, Opaque):
            owner.lines.append(f"C{comment.text}")
        else:
            section.comments.append(Comment(before=before, text=comment.text))
    return following


DIALECT = "https://json-schema.org/draft/2020-12/schema"
_REFERENCE = "#/$defs/{model}"


def json_schema() -> dict[str, Any]:
    """Return the schema: document, sections, every block with a model, the block without a model.

    The schema does not restrict keywords to their sections, since a deck may hold a keyword in the wrong section.
    """
    blocks = catalogue.block_classes()
    models: list[type[BaseModel]] = [*blocks, Opaque, Comment]
    schemas, schema = models_json_schema([(model, "validation") for model in models], ref_template=_REFERENCE)
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
            "units": {"enum": list(UNIT_SYSTEMS)},
            "preamble": {**lines, "description": "lines before the first section"},
            "comments": comments,
            "sections": {"type": "array", "items": {"$ref": "#/$defs/Section"}},
        },
        required=("format", "sections"),
    )
    return {
        "$schema": DIALECT,
        "title": "mudline deck",
        **document,
        "$defs": {**schema["$defs"], "Section": section},
    }


def _object(properties: dict[str, Any], required: tuple[str, ...]) -> dict[str, Any]:
    return {"type": "object", "properties": properties, "required": list(required), "additionalProperties": False}
