"""Keyword text to a deck: sections, known and unknown keywords, comments that belong to what follows them."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import PurePath

from mudline.codes import SYN007, SYN008, SYN009, SYN010, SYN011
from mudline.deck.model import Deck, Opaque, Section
from mudline.deck.text_origin import TextOrigin
from mudline.deck.truncation import told_as_cut
from mudline.deck.units import units_of
from mudline.diagnostics import Code, Problem, Severity, Span, Where
from mudline.keywords import catalogue
from mudline.keywords.contents import ambiguous_comment
from mudline.keywords.model import Block, Comment
from mudline.keywords.reader import read_block
from mudline.keywords.text import cut, either, suggestion
from mudline.syntax.fields import trimmed
from mudline.syntax.source import Source
from mudline.syntax.tree import Kind, Leaf, RawBlock, RawSection, SyntaxTree, parse

_SPACE = (Kind.BLANK, Kind.COMMENT, Kind.UNDECIDED)


def read_source(source: Source, *, units: str | None = None) -> Deck:
    """The deck of a keyword text, as far as it can be read; what was wrong is in its `problems`."""
    reader = _Reader(parse(source))
    deck = reader.read()
    deck.units = units or units_of(deck)
    return deck


class _Reader:
    def __init__(self, tree: SyntaxTree) -> None:
        self.tree = tree
        self.text = tree.source.unified
        self.origin = TextOrigin(tree)
        self.problems: list[Problem] = list(tree.source.problems)
        self.deck = Deck(tree.source.name, PurePath(tree.source.name).name, origin=self.origin)
        ending = tree.sections[-1].blocks if tree.sections else []
        self.last = ending[-1] if ending else None

    def read(self) -> Deck:
        if self.tree.source.readable:
            self._preamble(self.tree.preamble)
        for index, raw in enumerate(self.tree.sections):
            self._section(index, raw)
        self.deck.problems = told_as_cut(self.problems, self.text)
        return self.deck

    def _lines(self, span: Span) -> list[str]:
        """Lines without their ends."""
        return self.text[slice(*span)].replace("\r\n", "\n").removesuffix("\n").split("\n")

    def _preamble(self, preamble: RawSection) -> None:
        """What stands before the first section is kept as it is."""
        self._stray(preamble.leaves, "before the first section")
        for block in preamble.blocks:
            belongs = self._belongs(block.name) or "such as $MODEL"
            message = f"*{cut(block.name)} stands before any $SECTION: put it in its section, {belongs}"
            self.problems.append(Problem(SYN007, message, trimmed(self.text, *block.head.span)))
        first = self.tree.sections[0].head if self.tree.sections else None
        end = first.span.start if first else len(self.text)
        self.deck.preamble = self._lines(Span(0, end)) if end else []

    def _belongs(self, keyword: str) -> str:
        sections = catalogue.sections_of(keyword)
        return either(f"${name}" for name in sections) if sections else ""

    def _stray(self, leaves: Sequence[Leaf], where: str) -> None:
        """One finding for all data lines of a place, and one for each line that may be a comment."""
        self.problems += [ambiguous_comment(self.text, leaf.span) for leaf in leaves if leaf.kind is Kind.UNDECIDED]
        data = [leaf.span for leaf in leaves if leaf.kind not in _SPACE]
        if not data:
            return
        count = sum(len(self._lines(span)) for span in data)
        lines = "1 line" if count == 1 else f"{count} lines"
        message = f"{lines} {where} under no keyword: not read. A title can stand in a comment, C and a blank"
        first = data[0]
        end = self.text.find("\n", *first)
        self.problems.append(Problem(SYN011, message, trimmed(self.text, first.start, end if end >= 0 else first.end)))

    # -------------------------------------------------------------------------------------------------- sections

    def _section(self, index: int, raw: RawSection) -> None:
        section = Section(raw.name)
        self.deck.sections.append(section)
        if raw.head:
            self.origin.heads[Where(index)] = trimmed(self.text, *raw.head.span)
        if raw.name not in catalogue.SECTIONS:
            self._unknown(SYN010, "section $", raw.name, catalogue.SECTIONS, Where(index))
        self._stray(raw.leaves, f"of ${cut(raw.name)}")
        for leaf in raw.leaves:
            lines = self._lines(leaf.span)
            if leaf.kind in (Kind.COMMENT, Kind.UNDECIDED):
                section.comments.append(Comment(before=0, text=lines[0][1:]))
            elif leaf.kind is not Kind.BLANK:
                section.lines += lines
        for number, block in enumerate(raw.blocks):
            where = Where(index, number)
            self.origin.heads[where] = trimmed(self.text, *block.head.span)
            declared = catalogue.block_class(section.name, block.name)
            if declared is None:
                self._opaque(section, where, block)
            else:
                self._block(section, where, block, declared)

    def _unknown(self, code: Code, kind: str, name: str, known: Sequence[str], where: Where) -> None:
        hint = suggestion(name, known)
        message = f"{kind}{cut(name)} is not known{hint}: it is kept as it is"
        self.problems.append(Problem(code, message, None, Severity.WARNING if hint else None, where))

    def _block(self, section: Section, where: Where, raw: RawBlock, declared: type[Block]) -> None:
        """A block with a model. Comments behind its last line belong to what follows: a block, or a section."""
        read = read_block(self.text, raw, declared, last=raw is self.last)
        self.origin.read[where.section, where.block] = read
        self.problems += read.problems
        section.blocks.append(read.model)
        ends_section = raw is self.tree.sections[where.section].blocks[-1]
        target = self.deck.comments if ends_section else section.comments
        before = where.section + 1 if ends_section else where.block + 1
        target += [Comment(before=before, text=text) for text in read.trailing]

    def _opaque(self, section: Section, where: Where, raw: RawBlock) -> None:
        """A block without a model: its lines are kept."""
        lines = [line for leaf in raw.leaves for line in self._lines(leaf.span)]
        section.blocks.append(Opaque(keyword=raw.name, lines=lines))
        sections = catalogue.sections_of(raw.name)
        if sections is None:
            self._unknown(SYN009, "keyword *", raw.name, catalogue.keywords(), where)
        elif sections and section.name not in sections and section.name in catalogue.SECTIONS:
            message = f"*{raw.name} does not belong in ${section.name}: it belongs in {self._belongs(raw.name)}"
            self.problems.append(Problem(SYN008, message, None, None, where))
