"""Reading of decks for checks: decks read before share their short blocks, so that a changed deck is read quickly."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from pathlib import Path

from mudline.language.deck.loading import load_bytes
from mudline.language.deck.model import Deck
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import Problem
from mudline.language.keywords.model import Block
from mudline.language.keywords.reader import ReadBlock, read_block, read_piece
from mudline.language.syntax.tree import RawBlock

_SHORT_BLOCK = 4096
"""Characters of the largest block that is remembered: decks of a project share their short blocks."""


class _Piece(str):
    """Text of a block, equal to any other with the same text; `raw` and `start` are those of the first one read."""

    __slots__ = ("raw", "start")

    raw: RawBlock
    start: int


@lru_cache(512)
def _read_piece(piece: _Piece, declared: type[Block], last: bool, older: bool) -> ReadBlock:  # noqa: ARG001, FBT001 - for the cache
    return read_piece(piece, piece.start, piece.raw, declared, last=last)


def read_once(text: str, raw: RawBlock, declared: type[Block], *, last: bool) -> ReadBlock:
    """Return the result of `read_block` for a block; blocks with the same text share their model."""
    start = raw.head.span.start
    end = (raw.leaves[-1] if raw.leaves else raw.head).span.end
    if end - start > _SHORT_BLOCK:
        return read_block(text, raw, declared, last=last)
    piece = _Piece(text[start:end])
    piece.raw, piece.start = raw, start
    known = _read_piece(piece, declared, last, raw.older)
    return known.at(text, start, [_reported_at(problem, start) for problem in known.problems] if known.problems else [])


def _reported_at(problem: Problem, by: int) -> Problem:
    span = problem.span and problem.span.moved(by)
    repair = problem.repair
    if repair is not None:
        repair = replace(repair, edits=tuple((place.moved(by), text) for place, text in repair.edits))
    return replace(problem, span=span, repair=repair)


def read_deck(
    data: bytes, name: str, *, form: str | None = None, units: str | None = None, folder: Path | None = None
) -> Deck:
    """Return the deck of a file's content; it must not be changed, as its models are shared with decks read before.

    Raises DeckError for a JSON or YAML file that holds no deck.
    """
    deck = load_bytes(data, name, form=form, units=units, folder=folder, read=read_once)
    if isinstance(deck.origin, TextOrigin):
        deck.origin.no_equations = "[" not in deck.origin.source.text
    return deck
