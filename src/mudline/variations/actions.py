"""ADD and REMOVE of a variation: which blocks go, and what lines come."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, cast

from mudline.codes import EXP001
from mudline.deck.model import Deck
from mudline.deck.reading import TextOrigin
from mudline.diagnostics import Problem, Severity, Where
from mudline.keywords import catalogue
from mudline.keywords.text import shown, suggestion
from mudline.scene.deck_values import find_file
from mudline.syntax.source import Source
from mudline.syntax.tree import Kind, canonical_name, parse
from mudline.variations.model import Action, Addition, Removal
from mudline.variations.names import unquoted

if TYPE_CHECKING:
    from mudline.keywords.library.variation import VariedBlock

_PLANNING = "PREPROCESSOR"
"""The section of keywords that say what the decks are; they do not come and go themselves."""

_LARGEST = 64 * 2**20


class RefusedError(Exception):
    """An action that cannot be done; the message says why."""


def action_of(deck: Deck, varied: VariedBlock, where: Where) -> Action | Problem:
    """What an ACTION= line does to a deck that was read from text, or why it cannot."""
    try:
        keyword = _keyword(varied)
        section = _section(deck, varied, keyword)
        if varied.action == "REMOVE":
            return _removal(deck, keyword, section)
        return _addition(deck, varied, keyword, section)
    except RefusedError as reason:
        return Problem(EXP001, str(reason), None, None, where)


def _keyword(varied: VariedBlock) -> str:
    keyword = canonical_name("*" + ",".join(unquoted(word) for word in varied.keyword))
    if _PLANNING in (catalogue.sections_of(keyword) or ()):
        raise RefusedError(f"*{keyword} says what the decks are: a variation cannot add or remove it")
    return keyword


def _section(deck: Deck, varied: VariedBlock, keyword: str) -> str:
    """The section of an action, which the deck has."""
    there = [section.name for section in deck.sections]
    if varied.section is not None:
        name = canonical_name("$" + unquoted(varied.section).removeprefix("$"))
    else:
        belongs = catalogue.sections_of(keyword) or ()
        if len(belongs) != 1:
            known = " or ".join(f"${name}" for name in belongs)
            raise RefusedError(f"say where *{keyword} belongs with SECTION={f' ({known})' if known else ''}")
        name = belongs[0]
    if name not in there:
        raise RefusedError(f"the deck has no section ${name}{suggestion(name, there)} for *{keyword}")
    return name


def _removal(deck: Deck, keyword: str, section: str) -> Removal:
    blocks = [
        (index, number, block.keyword)
        for index, found in enumerate(deck.sections)
        if found.name == section
        for number, block in enumerate(found.blocks)
    ]
    gone = frozenset((index, number) for index, number, name in blocks if name == keyword)
    if not gone:
        hint = suggestion(keyword, {name for _, _, name in blocks})
        raise RefusedError(f"${section} has no *{keyword}{hint} that could be removed")
    return Removal(gone)


def _addition(deck: Deck, varied: VariedBlock, keyword: str, section: str) -> Addition:
    last = max(index for index, found in enumerate(deck.sections) if found.name == section)
    if varied.file is None:
        return Addition(last, f"*{keyword}\n")
    if deck.folder is None:
        raise RefusedError(f"FILE={varied.file} stands beside the deck, which came from standard input")
    path = find_file(deck.folder, varied.file)
    if path is None:
        raise RefusedError(f"there is no file {shown(unquoted(varied.file))} beside the deck")
    text = _block_text(_content(path, varied.file), keyword)
    try:
        text.encode(cast("TextOrigin", deck.origin).source.encoding)
    except UnicodeEncodeError as error:
        raise RefusedError(f"{varied.file} holds {text[error.start]!r}, which the encoding of the deck lacks") from None
    return Addition(last, text)


def _content(path: Path, name: str) -> Source:
    try:
        if path.stat().st_size > _LARGEST:
            raise RefusedError(f"{name} is larger than {_LARGEST // 2**20} MiB: is it a block of a deck?")
        source = Source.from_bytes(path.read_bytes(), name)
    except OSError as error:
        raise RefusedError(f"{name} cannot be read: {(error.strerror or str(error)).lower()}") from error
    faults = [problem.message for problem in source.problems if problem.weight is Severity.ERROR]
    if faults:
        raise RefusedError(f"{name}: {faults[0]}")
    return source


def _block_text(source: Source, keyword: str) -> str:
    """The lines of a file as blocks of a keyword, the head put before them where the file has none."""
    tree = parse(source)
    if tree.sections:
        raise RefusedError(f"{source.name} opens the section ${tree.sections[0].name}: only the block is wanted")
    others = [block.name for block in tree.preamble.blocks if block.name != keyword]
    if others:
        raise RefusedError(f"{source.name} holds *{others[0]}, expected *{keyword} only")
    text = source.unified.replace("\r\n", "\n")
    text = text if text.endswith("\n") or not text else f"{text}\n"
    if all(leaf.kind in (Kind.BLANK, Kind.COMMENT) for leaf in tree.preamble.leaves) and tree.preamble.blocks:
        return text
    return f"*{keyword}\n{text}"
