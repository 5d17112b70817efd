"""A deck as a document of plain values: the form behind JSON and YAML."""

from __future__ import annotations

from typing import Any

from mudline.deck.model import Deck, Opaque, Section
from mudline.keywords.listing import AS_TABLES
from mudline.keywords.model import Block, Comment

FORMAT = "mudline-deck/1"
UNITS = ("metric", "imperial", "user")

Document = dict[str, Any]


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
    values = block.model_dump(exclude={"keyword"}, exclude_unset=True, context=AS_TABLES)
    return {"keyword": block.keyword, **values}


def _comments(comments: list[Comment]) -> Document:
    return {"comments": [comment.model_dump() for comment in comments]} if comments else {}
