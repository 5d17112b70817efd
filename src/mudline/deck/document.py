"""A deck as a document of plain values, the form behind JSON and YAML, and back."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from mudline.deck.document_faults import DocumentFaults
from mudline.deck.document_places import DocumentOrigin, DocumentPath, Places
from mudline.deck.model import Deck, Opaque, Section, Title
from mudline.keywords import catalogue
from mudline.keywords.model import DOCUMENT, Block, Comment
from mudline.keywords.values import Text

FORMAT = "mudline-deck/1"

Document = dict[str, Any]


class SectionDocument(BaseModel):
    """A section; its blocks are read one by one, as their keywords tell what they hold."""

    model_config = ConfigDict(extra="forbid")
    name: Title
    comments: list[Comment] = Field(default_factory=list)
    lines: Annotated[list[Text], Field(description="stray lines before the first keyword")] = Field(
        default_factory=list
    )
    blocks: list[Any]


class DeckDocument(BaseModel):
    """The document as a whole."""

    model_config = ConfigDict(extra="forbid")
    format: Literal["mudline-deck/1"]
    source: Annotated[Text, Field(description="name of the file that the deck was read from")] = ""
    units: Literal["metric", "imperial", "user"] = "user"
    preamble: Annotated[list[Text], Field(description="lines before the first section")] = Field(default_factory=list)
    comments: list[Comment] = Field(default_factory=list)
    sections: list[SectionDocument]


def to_document(deck: Deck) -> Document:
    """The deck as dicts and lists; empty things are left out."""
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
    values = block.model_dump(exclude_unset=True)
    return {"keyword": values.pop("keyword"), **values}


def _comments(comments: list[Comment]) -> Document:
    return {"comments": [comment.model_dump() for comment in comments]} if comments else {}


def from_document(document: object, file: str, places: Places) -> Deck:
    """The deck of a document; raises DeckError with the path and place of everything that breaks the schema."""
    faults = DocumentFaults()
    deck = Deck(file, origin=DocumentOrigin(places))
    try:
        whole = DeckDocument.model_validate(document, context=DOCUMENT)
    except ValidationError as error:
        faults.extend((), error)
        faults.raise_any(file, places)
    deck.source, deck.units, deck.preamble, deck.comments = whole.source, whole.units, whole.preamble, whole.comments
    for index, section in enumerate(whole.sections):
        blocks = [
            _read_block(section.name, given, ("sections", index, "blocks", number), faults)
            for number, given in enumerate(section.blocks)
        ]
        known = [block for block in blocks if block is not None]
        deck.sections.append(Section(section.name, known, section.comments, section.lines))
    faults.raise_any(file, places)
    return deck


def _read_block(section: str, given: object, path: DocumentPath, faults: DocumentFaults) -> Block | Opaque | None:
    keyword = given.get("keyword") if isinstance(given, dict) else None
    if not isinstance(given, dict) or not isinstance(keyword, str):
        faults.add(path, "expected a block: an object with its `keyword`")
        return None
    declared = catalogue.block_class(section, keyword)
    if declared is None and "lines" not in given:
        faults.add(path, f"*{keyword} in ${section} has no model: expected its raw lines as `lines`")
        return None
    try:
        return (declared or Opaque).model_validate(given, context=DOCUMENT)
    except ValidationError as error:
        faults.extend(path, error)
        return None
