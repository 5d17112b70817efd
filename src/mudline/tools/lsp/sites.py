"""Place in a deck: the section, the block, the field and its value."""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass
from typing import cast

from mudline.language.deck.model import Opaque
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import Span, Where
from mudline.language.keywords import catalogue
from mudline.language.keywords.model import Block, FieldSpec, Part
from mudline.language.keywords.reader import schemas_of
from mudline.language.syntax.fields import canonical_key, read_line
from mudline.language.syntax.tree import Leaf, LeafKind, RawBlock, RawSection, SyntaxTree
from mudline.tools.lsp.decks import Analysis


@dataclass(frozen=True, slots=True)
class Spot:
    """Section and block in whose lines an offset lies, with their numbers; -1 and None outside any section or block."""

    section: int = -1
    block: int = -1
    raw_section: RawSection | None = None
    raw: RawBlock | None = None

    @property
    def where(self) -> Where:
        """The place among the values."""
        return Where(self.section, self.block)

    @property
    def declared(self) -> type[Block] | None:
        """The declaration of the block's keyword in this section."""
        if self.raw is None or self.raw_section is None:
            return None
        return catalogue.block_class(self.raw_section.name, self.raw.name)

    @property
    def leaf(self) -> Leaf | None:
        """The line that opens the block, or else the section."""
        if self.raw is not None:
            return self.raw.head
        return self.raw_section.head if self.raw_section else None


def spot(tree: SyntaxTree, offset: int) -> Spot:
    """Return the section and block at an offset; a block begins at its first character, and ends before the next."""
    heads = [section.head.span.start if section.head else 0 for section in tree.sections]
    at = bisect_right(heads, offset) - 1
    if at < 0:
        return Spot()
    section = tree.sections[at]
    number = bisect_right([block.head.span.start for block in section.blocks], offset) - 1
    return Spot(at, number, section, section.blocks[number] if number >= 0 else None)


def leaf_at(here: Spot, offset: int) -> Leaf | None:
    """Return the line, or run of lines, of a block at an offset."""
    leaves = [here.raw.head, *here.raw.leaves] if here.raw else []
    at = bisect_right([leaf.span.start for leaf in leaves], offset) - 1
    return leaves[at] if at >= 0 else None


@dataclass(frozen=True, slots=True)
class Site:
    """A value of a deck: its place, its field, and the value as read (None if it could not be read)."""

    where: Where
    span: Span
    slot: FieldSpec
    value: object


def site(analysis: Analysis, offset: int) -> Site | None:
    """Return the value at an offset, also if its KEY= is there."""
    origin = analysis.origin
    if origin is None:
        return None
    here = spot(origin.tree, offset)
    read = origin.read.get((here.section, here.block))
    leaf = leaf_at(here, offset)
    if read is None or leaf is None or leaf.kind is LeafKind.COMMENT:
        return None
    block = analysis.deck.sections[here.section].blocks[here.block]
    if type(block) is Opaque:
        return None
    place = read.places.at(offset)
    if place is not None:
        path, span = place
        slot, value = cast("Block", block).at(path)
        if slot is not None and not isinstance(value, Part | list):
            return Site(here.where.inside(*path), span, slot, value)
    return _of_key(origin, here, leaf, offset)


def _of_key(origin: TextOrigin, here: Spot, leaf: Leaf, offset: int) -> Site | None:
    """Return the setting whose KEY= is at an offset."""
    declared = here.declared
    if declared is None or leaf.kind not in (LeafKind.SETTING, LeafKind.UNDECIDED):
        return None
    for group in read_line(origin.source.unified, leaf.span, slashes=declared.slashes).groups:
        end = group.fields[0].span.start if group.fields else group.span.end
        if group.key and group.span.start <= offset <= end:
            slot = slot_of_key(declared, group.key)
            return Site(here.where, Span(group.span.start, end), slot, None) if slot else None
    return None


def slot_of_key(declared: type[Block], key: str) -> FieldSpec | None:
    """Return the field of a KEY= of a keyword; of several records with this key, that of the first."""
    name = canonical_key(key)
    return next((schema.keys[name] for schema in schemas_of(declared) if name in schema.keys), None)
