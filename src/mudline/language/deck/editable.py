"""Decks for use in programs: finding, adding and removing blocks, and copying decks."""

from __future__ import annotations

from collections.abc import Iterator
from copy import deepcopy
from dataclasses import replace
from itertools import chain
from typing import Any, Self

from pydantic.fields import FieldInfo

from mudline.basics.arguments import expect, expect_word
from mudline.basics.short_repr import UnknownNameError
from mudline.language.deck.model import Deck, Opaque, Section
from mudline.language.deck.reading import TextOrigin, read_source
from mudline.language.deck.writing import keyword_file
from mudline.language.diagnostics import Where
from mudline.language.keywords import catalogue
from mudline.language.keywords.fields import Comment
from mudline.language.keywords.model import Block
from mudline.language.keywords.text import hint
from mudline.language.syntax.source import Source
from mudline.language.syntax.tree import canonical_name


class EditableDeck(Deck):
    """Deck whose blocks can be found by keyword or class, and changed; `TypedDeck` adds their types."""

    def blocks(self, keyword: str | type[Block], section: str | None = None) -> Iterator[tuple[Where, Any]]:
        """Return the blocks of a keyword, given by name or class, each with its place, in the order of the file.

        Without `section`, the sections where the keyword belongs are searched; a keyword that belongs in `MODEL` is
        searched only there. Blocks whose lines are not read are left out.
        """
        expect(keyword, "keyword", (str, type), "a str or a class of mudline.keywords")
        name = _name_of(keyword)
        if section is None:
            known = catalogue.sections_of(name) or ("MODEL",)
            sections = ("MODEL",) if "MODEL" in known and isinstance(keyword, str) else known
        else:
            expect(section, "section", str, "a str")
            sections = (section,)
        blocks = chain.from_iterable(Deck.blocks(self, name, place) for place in sections)
        return ((where, block) for where, block in blocks if isinstance(keyword, str) or type(block) is keyword)

    def block(self, keyword: str | type[Block], section: str | None = None) -> Any:
        """Return the only block of a keyword, given by its name or its class.

        Raises UnknownNameError, a KeyError, if there is none, and ValueError if there are several.
        """
        blocks = [block for _, block in self.blocks(keyword, section)]
        name = _name_of(keyword)
        if len(blocks) > 1:
            raise ValueError(f"the deck has {len(blocks)} blocks of *{name}: go through deck.blocks({name!r})")
        if not blocks:
            if any(block.keyword == name for _, _, block in self.every_block()):
                raise UnknownNameError(f"the lines of *{name} are not read: the deck keeps them as they are")
            known = catalogue.sections_of(name) is not None
            near = "" if known else catalogue.suggest_keyword(name)
            raise UnknownNameError(f"the deck has no *{name}{hint(near)}")
        return blocks[0]

    def add(self, block: Block, section: str | None = None) -> None:
        """Add a block at the end of the last section where it belongs; the section is created if there is none.

        Raises ValueError for a section where the block does not belong.
        """
        expect(block, "block", Block, "a block, such as mudline.keywords.Ocean(depth=100)")
        belongs = type(block).sections
        if section is not None:
            expect_word(section, "section", belongs, f"{' or '.join(belongs)}, where *{block.keyword} belongs")
        names = (section,) if section else belongs
        target = next((item for item in reversed(self.own_sections) if item.name in names), None)
        if target is None:
            order = catalogue.SECTIONS.index
            before = [
                item.name in catalogue.SECTIONS and order(item.name) > order(names[0]) for item in self.own_sections
            ]
            at = before.index(True) if True in before else len(before)
            target = Section(names[0])
            self.sections.insert(at, target)
            self.comments[:] = [_moved(item, 1) if item.before > at else item for item in self.comments]
        target.blocks.append(block)

    def remove(self, what: str | Block | Opaque) -> None:
        """Remove a block, or all blocks of a keyword; comments stay.

        Raises UnknownNameError for a keyword that the deck lacks, and ValueError for a block that is not in the deck.
        """
        expect(what, "what", (str, Block, Opaque), "a block or a keyword")
        keyword = _name_of(what) if isinstance(what, str) else ""
        gone = 0
        for section in self.own_sections:
            for number in range(len(section.blocks) - 1, -1, -1):
                block = section.blocks[number]
                if block is what or block.keyword == keyword:
                    del section.blocks[number]
                    section.comments[:] = [_moved(c, -1) if c.before > number else c for c in section.comments]
                    gone += 1
        if not gone and isinstance(what, str):
            raise UnknownNameError(f"the deck has no *{keyword}")
        if not gone:
            raise ValueError("the block is not in the deck: take it from deck.block or deck.blocks")

    def copy(self) -> Self:
        """Return a copy; changes of the copy leave this deck unchanged."""
        own = {name: deepcopy(getattr(self, name)) for name in ("sections", "comments", "preamble")}
        return replace(self, **own, problems=[*self.problems])

    def placed(self) -> Self:
        """Return the deck with the places of its blocks: after blocks were added or removed, those of the written text.

        Raises DeckError for values that keyword text cannot express.
        """
        origin = self.origin
        if not isinstance(origin, TextOrigin):
            return self
        read = [[block.name for block in section.blocks] for section in origin.tree.sections]
        if read == [[block.keyword for block in section.blocks] for section in self.own_sections]:
            return self
        again = read_source(Source.from_bytes(keyword_file(self), self.file), units=self.units)
        return replace(self, origin=again.origin, problems=again.problems)


def _name_of(keyword: str | type[Block]) -> str:
    if isinstance(keyword, str):
        return canonical_name(f"*{keyword.removeprefix('*')}")
    fields: dict[str, FieldInfo] = getattr(keyword, "model_fields", {})
    if "keyword" not in fields or not isinstance(fields["keyword"].default, str):
        raise ValueError(f"{keyword.__name__} is not a keyword: expected a class of mudline.keywords")
    return fields["keyword"].default


def _moved(comment: Comment, by: int) -> Comment:
    return comment.model_copy(update={"before": comment.before + by})
