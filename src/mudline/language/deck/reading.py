"""Reading of keyword text: sections, keywords, comments that belong to the following line, and the unit system."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass, field, replace
from pathlib import PurePath

from mudline.basics.limits import MOST_REPORTED
from mudline.basics.short_repr import counted, short_repr
from mudline.language.codes.fields import SYN002, SYN006
from mudline.language.codes.lines import SYN007, SYN008, SYN009, SYN010, SYN011, SYN012, SYN014
from mudline.language.deck.model import START, Deck, Opaque, Origin, Range, Section
from mudline.language.deck.parameters import Parameters
from mudline.language.diagnostics import MORE, Code, Problem, Severity, Span, Where
from mudline.language.keywords import catalogue
from mudline.language.keywords.catalogue import meant_in, meant_section, words_behind
from mudline.language.keywords.fields import Comment
from mudline.language.keywords.parsed import piece_of
from mudline.language.keywords.reader import BlockReader, ReadBlock, read_block
from mudline.language.keywords.text import TOO_WIDE, hint, instead
from mudline.language.syntax.fields import trimmed
from mudline.language.syntax.source import Source
from mudline.language.syntax.tree import Leaf, LeafKind, RawBlock, RawSection, SyntaxTree, parse

_DATA = re.compile(r"[-+.,\d\s]+(?:[eEdD][-+]?\d+[-+.,\d\s]*)*$|\s*[A-Z][A-Z ]*=")
"""Line of numbers, or a setting: not a title."""


_DEEPLINES = frozenset({"SOIL", "TRENCH"})
"""Keywords of another program, whose columns are separated by spaces."""
_SPACED = re.compile(r"[ \t]*[-+.\d][-+.\deE]*[ \t]+[-+.\d]")
"""Row of numbers that are separated by spaces."""
_NUMBERS = re.compile(r"(?=.*[,\d])(?:[,* ]++|[-+.\d][-+.\dED]*+)*+")
"""Rest of a line that begins with asterisks in place of a number: numbers, or asterisks behind a comma."""


def _meant(name: str, near: str) -> str:
    behind = ", with nothing after the name" if near and words_behind(name, near) else ""
    return f" (did you mean {near}{behind}?)" if near else ""


def _belongs(keyword: str) -> str:
    sections = catalogue.sections_of(keyword)
    return " or ".join(f"${name}" for name in sections) if sections else "such as $MODEL"


@dataclass
class TextOrigin(Origin):
    """Places of the values of a deck in its text."""

    tree: SyntaxTree
    read: dict[tuple[int, int], ReadBlock] = field(default_factory=dict)
    no_equations: bool = False
    source: Source = field(init=False)

    __repr__ = short_repr

    def __post_init__(self) -> None:
        self.source = self.tree.source

    def span(self, where: Where) -> Span | None:
        """Return the span of a value; without one that of its block or section."""
        block = self.read.get((where.section, where.block))
        if where.path[:1] == ("lines",):  # of a block without a model
            first = self.tree.sections[where.section].blocks[where.block].leaves[0].span.start
            line = self.source.line_span(self.source.position(first)[0] + int(where.path[1]))
            return piece_of(self.source.unified, line, where.path[2:])
        if block is not None and where.path:
            return block.places.find(where.path)
        return self.head(where)

    def head(self, where: Where) -> Span | None:
        """Return the span of the line that begins the section or block of a place; None if there is none."""
        sections = self.tree.sections
        if not 0 <= where.section < len(sections):
            return None
        section = sections[where.section]
        if where.block >= len(section.blocks):
            return None
        leaf = section.head if where.block < 0 else section.blocks[where.block].head
        return trimmed(self.source.unified, *leaf.span) if leaf else None

    def lines_of(self, where: Where) -> list[str]:
        """Return the lines of a block below its first one, without their ends."""
        leaves = self.tree.sections[where.section].blocks[where.block].leaves
        return [line for leaf in leaves for line in _lines(self.source.unified, leaf.span)]

    def span_of(self, problem: Problem) -> Span | None:
        """Return the span of a problem; None if it has no place in the text."""
        return problem.span or (self.span(problem.where) if problem.where else None)

    def place(self, problem: Problem) -> Range:
        """Return lines and columns of a problem."""
        span = self.span_of(problem)
        if span is None:
            return START
        return Range(*self.source.position(span.start), *self.source.position(max(span.start, span.end)))

    def lost(self, section: int, block: int, *, kept: bool = True) -> int:
        """Return the number of lines of a block that could not be used at all, with or without those it keeps."""
        read = self.read.get((section, block))
        return 0 if read is None else read.lost if kept else read.lost - read.kept

    def written(self, where: Where) -> bool:
        """Return True if the file contains exactly this value."""
        block = self.read.get((where.section, where.block))
        return block is not None and block.own.has(where.path)


def read_source(source: Source, *, units: str | None = None, read: BlockReader = read_block) -> Deck:
    """Return the deck of a keyword text, as far as it can be read; its faults are in `problems`."""
    return _DeckReader(parse(source), read).read(units)


def _lines(text: str, span: Span) -> list[str]:
    """Return the lines of a piece of text, without their ends."""
    lines = text[slice(*span)].replace("\r\n", "\n").removesuffix("\n").split("\n")
    return [line.removesuffix("\r") for line in lines]


class _DeckReader:
    def __init__(self, tree: SyntaxTree, read: BlockReader) -> None:
        self.tree = tree
        self.read_block = read
        self.text = tree.source.unified
        self.origin = TextOrigin(tree)
        self.problems: list[Problem] = list(tree.source.problems)
        self.reported: Counter[str] = Counter()
        self.older = tree.source.name.lower().endswith(".das")
        self.deck = Deck(tree.source.name, PurePath(tree.source.name).name, origin=self.origin)

    def read(self, units: str | None) -> Deck:
        self._preamble()
        for index, raw in enumerate(self.tree.sections):
            self._section(index, raw)
        self._truncated()
        self._with_control_characters()
        self.deck.problems = self.problems
        self.deck.units = units or units_of(self.deck)
        return self.deck

    def _preamble(self) -> None:
        preamble = self.tree.preamble
        if self.tree.source.readable:
            self._stray(
                preamble.leaves, "before the first section", title=bool(self.tree.sections) and not preamble.blocks
            )
        if foreign := self._of_deeplines():
            place = trimmed(self.text, *foreign.head.span)
            message = (
                f"this seems to be a deck of DeepLines: it has *{foreign.name.split()[0]} and no $SECTION, and its "
                "values are separated only by spaces; mudline does not read such decks"
            )
            self.problems.append(Problem(SYN007, message, place))
        for block in preamble.blocks if not foreign else ():
            span = trimmed(self.text, *block.head.span)
            if self._reports(SYN007, span, None):
                message = f"*{block.name} stands before any $SECTION: put it in its section, {_belongs(block.name)}"
                self.problems.append(Problem(SYN007, message, span))
        self.deck.preamble = _lines(self.text, preamble.span) if preamble.span.end else []

    def _of_deeplines(self) -> RawBlock | None:
        """Return a block of DeepLines, in a text without sections and commas: *SOIL, *TRENCH, or spaced rows."""
        blocks = self.tree.preamble.blocks if not self.tree.sections and "," not in self.text else []
        own = [block for block in blocks if block.name.partition(" ")[0] in _DEEPLINES]
        spaced = [block for block in blocks if any(_SPACED.match(self.text, *leaf.span) for leaf in block.leaves)]
        return own[0] if own else spaced[0] if len(spaced) > 1 else None

    def _stray(self, leaves: list[Leaf], where: str, *, title: bool = False) -> None:
        """Report all data lines of a place in one finding; they may be a `title` if no line looks like data."""
        data = [leaf for leaf in leaves if leaf.kind not in (LeafKind.BLANK, LeafKind.COMMENT)]
        if data:
            first = data[0].span
            end = self.text.find("\n", *first)
            count = sum(len(_lines(self.text, leaf.span)) for leaf in data)
            place = trimmed(self.text, first.start, first.end if end < 0 else end)
            title = title and not any(_DATA.match(line) for leaf in data for line in _lines(self.text, leaf.span))
            lines = counted(count, "line")
            message = f"{lines} {where} under no keyword: not read; write a title as a comment, C and a space"
            if self._reports(SYN011, place, None):
                self.problems.append(Problem(SYN011, message, place, Severity.INFO if title else None))

    def _section(self, index: int, raw: RawSection) -> None:
        section = Section(raw.name)
        self.deck.sections.append(section)
        known = raw.name in catalogue.SECTIONS
        if not known:
            self._unknown_section(raw.name, Where(index))
        self._stray(raw.leaves, f"of ${raw.name}", title=not known)
        for leaf in raw.leaves:
            line = _lines(self.text, leaf.span)
            if leaf.kind is LeafKind.COMMENT:
                section.comments.append(Comment(before=0, text=line[0][1:]))
            elif leaf.kind is not LeafKind.BLANK:
                section.lines += line
        for block in raw.blocks:
            self._block(section, index, block)

    def _block(self, section: Section, index: int, raw: RawBlock) -> None:
        number = len(section.blocks)
        declared = catalogue.block_class(section.name, raw.name)
        if declared is None:
            self._opaque(section, Where(index, number), raw)
            return
        tree = self.tree
        final = tree.sections[-1].blocks
        last = bool(final) and raw is final[-1]
        raw.older = self.older
        read = self.read_block(self.text, raw, declared, last=last)
        head = trimmed(self.text, *raw.head.span) if last and not raw.leaves else None
        empty = head and not read.problems and head.end == len(self.text)
        if empty and set(declared.model_fields) - {"keyword", "comments"}:
            message = f"the file ends after *{raw.name}: it seems to be cut off, add what is missing"
            self.problems.append(Problem(SYN014, message, head, Severity.WARNING))
        self.problems += read.problems
        if read.opaque:
            self._opaque(section, Where(index, number), raw)
            return
        self.origin.read[index, number] = read
        section.blocks.append(read.model)
        if read.trailing:
            ends = raw is tree.sections[index].blocks[-1]
            target = self.deck.comments if ends else section.comments
            before = index + 1 if ends else number + 1
            target += [Comment(before=before, text=text) for text in read.trailing]

    def _opaque(self, section: Section, where: Where, raw: RawBlock) -> None:
        section.blocks.append(Opaque(keyword=raw.name, lines=self.origin.lines_of(where)))
        head, known = trimmed(self.text, *raw.head.span), catalogue.keywords()
        if head.end == len(self.text) and raw.name not in known and any(each.startswith(raw.name) for each in known):
            message = f"the file ends inside *{raw.name}: it seems to be cut off, add what is missing"
            self.problems.append(Problem(SYN014, message, head))
            return
        self._no_model(raw, section.name, where)

    def _unknown_section(self, name: str, where: Where) -> None:
        """Report a section that is not in the catalogue."""
        if not self._reports(SYN010, None, where):
            return
        near = "" if catalogue.sections_of(name) else meant_section(name)
        instead_ = f"*{name}" if catalogue.sections_of(name) else f"${near}" if near else ""
        suggested = f" (did you mean *{name}?)" if catalogue.sections_of(name) else _meant(name, near)
        message = f"section ${name} is not known{suggested}: it is passed through unchanged"
        self._misspelt(SYN010, message, where, instead_)

    def _no_model(self, raw: RawBlock, section: str, where: Where) -> None:
        """Report a block that is passed through, unless its keyword is known and allowed in the section."""
        keyword = raw.name
        sections = catalogue.sections_of(keyword)
        if sections is None:
            if self._reports(SYN009, None, where):
                near = catalogue.meant_keyword(self.text, raw, section)
                message = f"keyword *{keyword} is not known{_meant(keyword, near)}: it is passed through unchanged"
                replacement = f"*{near}" if catalogue.entries(near) else ""
                if keyword.startswith("*"):
                    rest = keyword.lstrip("* ")
                    if _NUMBERS.fullmatch(rest):
                        message = f"*{keyword[:40]} ends the block before it: {TOO_WIDE}, write the number itself"
                        self.problems.append(Problem(SYN009, message, None, Severity.ERROR, where))
                        return
                    message = f"*{keyword[:40]} ends the block before it: begin a comment with C and a space"
                    replacement = f"C {rest}"
                self._misspelt(SYN009, message, where, replacement)
        elif (
            sections
            and section not in sections
            and section in catalogue.SECTIONS
            and self._reports(SYN008, None, where)
        ):
            near = meant_in(keyword, section)
            message = f"*{keyword} does not belong in ${section}{hint(near)}: it belongs in {_belongs(keyword)}"
            head = self.origin.head(where)
            repair = instead(f"*{near}", head) if head and near else None
            certain = section in catalogue.CERTAIN_SECTIONS and (near or catalogue.has_certain_section(keyword))
            self.problems.append(Problem(SYN008, message, None, None if certain else Severity.INFO, where, repair))

    def _misspelt(self, code: Code, message: str, where: Where, replacement: str) -> None:
        """Report an unknown name: a warning if a known name was probably meant."""
        head = self.origin.head(where)
        repair = instead(replacement, head) if head else None
        self.problems.append(Problem(code, message, None, Severity.WARNING if replacement else None, where, repair))

    def _reports(self, code: Code, span: Span | None, where: Where | None) -> bool:
        """Count a finding of a code; return True if it is reported: the wrong kind of file has one on each line."""
        self.reported[code.code] += 1
        count = self.reported[code.code]
        if count == MOST_REPORTED + 1:
            self.problems.append(Problem(code, MORE, span, None, where))
        return count <= MOST_REPORTED

    def _truncated(self) -> None:
        """Report a file that was probably cut: its last token has a fault, and its last line end is missing."""
        end = len(self.text.rstrip(" \t"))
        if self.text.endswith("\n") or not self.problems:
            return
        for index, problem in enumerate(self.problems):
            span = problem.span
            unclosed = problem.code is SYN006
            if span is None or problem.code not in (SYN002, SYN006) or (span.end != end and not unclosed):
                continue
            if unclosed and "\n" in self.text[span.start :]:
                continue
            piece = self.text[span.start : end]
            if unclosed or piece[-1:] in "+-.eEdD" or piece in ("=", "=["):
                message = f"the file ends inside {piece!r}: it seems to be cut off, add what is missing"
                self.problems[index] = replace(problem, code=SYN014, message=message)

    def _with_control_characters(self) -> None:
        """Name the control character in the message of a value that cannot be read because of it."""
        for control in [each for each in self.problems if each.code is SYN012 and each.span]:
            for index, problem in enumerate(self.problems):
                span = problem.span
                if problem.code is SYN002 and span and control.span and span.start <= control.span.start < span.end:
                    self.problems[index] = replace(problem, message=f"{problem.message}; {control.message}")
                    self.problems.remove(control)
                    break


_SUFFIXES = {".keyxm": "metric", ".keyxi": "imperial"}
GRAVITIES = {"metric": 9.81, "imperial": 32.2}


def units_of(deck: Deck) -> str:
    """Return "metric", "imperial" or "user": by suffix, else `*UNITS`, else the gravity of `*OCEAN` within 2 %.

    A file of user units is not metric if the density of its water is in t/m3: its forces are then in kN.
    """
    suffix = PurePath(deck.source).suffix.lower()
    if suffix in _SUFFIXES:
        return _SUFFIXES[suffix]
    for _, block in deck.blocks("UNITS", "ANALYSIS"):
        if block.units:
            return str(block.units).lower()
    gravity = _of_ocean(deck, "gravity")
    system = next((name for name, g in GRAVITIES.items() if gravity and abs(gravity - g) <= 0.02 * g), "user")
    if system == "metric" and suffix == ".keyx":
        density = _of_ocean(deck, "density")
        return "user" if density is not None and _TONNES[0] <= density <= _TONNES[1] else system
    return system


_TONNES = (0.9, 1.3)
"""Densities of water and brines in t/m3."""


def _of_ocean(deck: Deck, name: str) -> float | None:
    """Return a value of the last `*OCEAN` that has it, evaluated; None if there is none."""
    parameters = Parameters(deck)
    values = [parameters.number(getattr(ocean, name)) for _, ocean in deck.blocks("OCEAN")]
    return next((value for value in reversed(values) if value is not None), None)
