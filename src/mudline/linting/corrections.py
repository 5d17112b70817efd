"""What may correct a fault from which other findings follow: a name that was meant, a `$SECTION` line, a value."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain

from mudline.codes.contact import SBD006
from mudline.codes.lines import SYN004, SYN005, SYN007, SYN008, SYN009, SYN010
from mudline.codes.references import REF007
from mudline.deck.model import Deck, Opaque
from mudline.deck.reading import TextOrigin
from mudline.diagnostics import Blocks as Blocking
from mudline.diagnostics import Problem, Repair, Severity, Span, Where
from mudline.keywords import catalogue
from mudline.keywords.values import Names
from mudline.linting.rules.references import REF016
from mudline.scene.references import given_names
from mudline.scene.sets import set_key
from mudline.syntax.edits import TextEdit
from mudline.syntax.fields import trimmed
from mudline.syntax.tree import Kind, RawBlock, RawSection

_DIGITS = re.compile(r"[0-9]+")
_NAMES = (SYN004, SYN005, SYN008, SYN009, SYN010)


@dataclass(frozen=True, slots=True)
class Correction:
    """Edits that may correct a finding, and the part of the text that is read differently then.

    `message` is what the finding says where the correction holds, "" for its own message, and `place` where it is then,
    None for its own place. One that is `certain` needs no trial; one that `joins` makes its lines part of the block
    above.
    """

    cause: Problem
    edits: tuple[TextEdit, ...]
    region: Span
    message: str = ""
    place: Span | None = None
    certain: bool = False
    joins: bool = False


def start_of(text: TextOrigin, problem: Problem) -> int:
    """Where a problem begins in the text, -1 where it has no place there."""
    span = problem.span or (text.span(problem.where) if problem.where else None)
    return -1 if span is None else span.start


def line_at(text: TextOrigin, offset: int) -> Span:
    """The line around an offset, without its end."""
    unified = text.source.unified
    end = unified.find("\n", offset)
    end = len(unified) if end < 0 else end
    return Span(unified.rfind("\n", 0, offset) + 1, end - (unified[end - 1 : end] == "\r"))


def misspelt(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Names for which another one was meant; one that is misspelt several times is corrected everywhere."""
    alike: dict[tuple[str, str], list[Problem]] = {}
    for problem in problems:
        if problem.code in _NAMES and problem.repair is not None:
            alike.setdefault((problem.code.code, problem.message), []).append(problem)
    text = blocks.text
    for found in alike.values():
        problem = min(found, key=lambda one: start_of(blocks.text, one))
        repairs = [one.repair.edits for one in found if one.repair is not None]
        edits = tuple(TextEdit(span, written) for span, written in sorted(chain.from_iterable(repairs)))
        first = edits[0].span
        region = blocks.section_at(first.start) if problem.code is SYN010 else blocks.block_at(first.start)
        words = ""
        if others := [one for one in found if one is not problem]:
            repair = problem.repair and replace(problem.repair, edits=tuple((each.span, each.text) for each in edits))
            problem = replace(problem, repair=repair)
            words = f"{problem.message}; {also_in(text, others)}"
        if all(_is_near(text, edit) for edit in edits):
            yield Correction(problem, edits, region, words, joins=edits[0].text.startswith("C "))


def also_in(text: TextOrigin, others: Sequence[Problem]) -> str:
    """Where else the same is found, in words."""
    *lines, last = sorted({text.place(one).line for one in others})
    if not lines:
        return f"the same in line {last}"
    return f"the same in {len(lines) + 1} more lines, the last of them line {last}"


def _is_near(text: TextOrigin, edit: TextEdit) -> bool:
    """Whether a name differs in more than its digits from the one that was meant: they tell things of a kind apart."""
    written = text.source.unified[slice(*edit.span)]
    return _DIGITS.sub("", edit.text).casefold() != _DIGITS.sub("", written).casefold()


class Blocks:
    """The blocks of a deck's text by their place, sorted out when somebody asks."""

    def __init__(self, deck: Deck, text: TextOrigin) -> None:
        self.deck = deck
        self.text = text
        self.end = len(text.source.unified)

    @cached_property
    def _sections(self) -> tuple[RawSection, ...]:
        return (self.text.tree.preamble, *self.text.tree.sections)

    @cached_property
    def blocks(self) -> list[tuple[str, RawBlock]]:
        """All of them, each with the name of its section."""
        return [(section.name, block) for section in self._sections for block in section.blocks]

    @cached_property
    def keywords(self) -> set[str]:
        """The names of all blocks."""
        return {block.name for _, block in self.blocks}

    @cached_property
    def _heads(self) -> list[int]:
        return [section.head.span.start if section.head else 0 for section in self._sections]

    @cached_property
    def _block_starts(self) -> list[int]:
        return [block.head.span.start for _, block in self.blocks]

    @cached_property
    def _starts(self) -> list[int]:
        return sorted([*self._heads, *self._block_starts])

    def block_at(self, offset: int) -> Span:
        """From the head of the block (or section) around an offset to the next one."""
        return self._around(self._starts, offset)

    def raw_at(self, offset: int) -> RawBlock | None:
        """The block whose lines are around an offset, None above the first one and below the last line of one."""
        at = bisect_right(self._block_starts, offset)
        block = self.blocks[at - 1][1] if at else None
        return block if block is not None and offset < whole(block).end else None

    def section_name(self, offset: int) -> str:
        """The name of the section around an offset, "" before the first."""
        return self._sections[max(bisect_right(self._heads, offset) - 1, 0)].name

    @cached_property
    def missing_sets(self) -> list[str]:
        """The names of sets that are used and nothing defines."""
        blocks = self.deck.blocks("ELEMENT SETS")
        defined = {set_key(each.name) for _, block in blocks for each in block.sets if each.name}
        return self._missing(Names.SET, {*defined, "all"})

    @cached_property
    def missing_curves(self) -> list[str]:
        """The names of curves that are used and nothing defines."""
        blocks = self.deck.blocks("SEABED STIFFNESS")
        return self._missing(
            Names.CURVE, {set_key(each.name) for _, block in blocks for each in block.curves if each.name}
        )

    def _missing(self, what: Names, defined: set[str]) -> list[str]:
        given = (name for _, _, name in given_names(self.deck, what))
        return list(dict.fromkeys(name for name in given if name and set_key(name) not in defined))

    def section_at(self, offset: int) -> Span:
        """From the head of the section around an offset to the next one."""
        return self._around(self._heads, offset)

    def _around(self, starts: list[int], offset: int) -> Span:
        at = bisect_right(starts, offset)
        return Span(starts[at - 1] if at else 0, starts[at] if at < len(starts) else self.end)


def whole(block: RawBlock) -> Span:
    """From the head of a block to the end of its last line."""
    return Span(block.head.span.start, (block.leaves or [block.head])[-1].span.end)


# ------------------------------------------------------------------------------------------- $SECTION lines


def missing_sections(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Blocks that stand before their section, or in another one: a `$SECTION` line in front of each run of them."""
    text = blocks.text
    outside = {start_of(text, one): one for one in problems if one.code is SYN007}
    elsewhere = {start_of(text, one): one for one in problems if one.code is SYN008 and one.weight is Severity.ERROR}
    tree = text.tree
    heads = [head_start(text, block) for block in tree.preamble.blocks]
    if run := [(head, block.name) for head, block in zip(heads, tree.preamble.blocks, strict=True) if head in outside]:
        end = tree.sections[0].head.span.start if tree.sections and tree.sections[0].head else blocks.end
        first = outside[run[0][0]]
        if run[0][1] in catalogue.SECTIONS:
            star = Span(run[0][0], run[0][0] + 1)
            message = f"*{run[0][1]} is no keyword: write ${run[0][1]}"
            yield Correction(first, (TextEdit(star, "$"),), Span(star.start, end), message, certain=True)
            return
        edits, words = _section_lines(run, "")
        if len(run) > 1:
            message = f"the line {words} is missing above this one: *{run[0][1]} stands before any $SECTION"
        else:
            message = ""
        yield Correction(first, edits, Span(run[0][0], end), message, certain=True)
    for section in tree.sections:
        placed = [(head_start(text, block), block.name) for block in section.blocks]
        for begin, behind in _runs(placed, elsewhere):
            yield _moved(blocks, elsewhere[placed[begin][0]], section.name, placed[begin:behind], placed[behind:])


def _runs(placed: list[tuple[int, str]], elsewhere: dict[int, Problem]) -> Iterator[tuple[int, int]]:
    """Where runs of misplaced blocks that belong in one section begin and end, as indices in `placed`.

    Keywords of which the section is not known do not end a run.
    """
    number = 0
    while number < len(placed):
        head, keyword = placed[number]
        first = number
        number += 1
        if head not in elsewhere:
            continue
        behind = number
        target = _section_of(keyword)
        while number < len(placed):
            head, keyword = placed[number]
            if catalogue.sections_of(keyword) and not (head in elsewhere and _section_of(keyword) == target):
                break
            number += 1
            behind = number if head in elsewhere else behind
        yield first, behind if number < len(placed) else number


def _section_of(keyword: str) -> str:
    """The section where a keyword mostly stands."""
    return (catalogue.sections_of(keyword) or ("MODEL",))[0]


def head_start(text: TextOrigin, block: RawBlock) -> int:
    """Where the name of a block begins: behind the blanks of its line."""
    line = text.source.unified[slice(*block.head.span)]
    return block.head.span.start + len(line) - len(line.lstrip(" \t"))


def _moved(
    blocks: Blocks, first: Problem, section: str, run: list[tuple[int, str]], behind: list[tuple[int, str]]
) -> Correction:
    """A run of blocks in a section of their own; the section goes on behind them."""
    edits, words = _section_lines(run, section)
    end = blocks.section_at(run[0][0]).end
    if behind:
        end = behind[0][0]
        edits = (*edits, TextEdit(Span(end, end), f"${section}\n"))
    others = len(run) - 1
    message = ""
    if others:
        nor = "nor does the keyword" if others == 1 else f"nor do the {others} keywords"
        message = (
            f"*{run[0][1]} does not belong in ${section}, {nor} below it: "
            f"the line {words} seems to be missing above this one"
        )
    return Correction(first, edits, Span(run[0][0], end), message, certain=True)


def _section_lines(run: list[tuple[int, str]], current: str) -> tuple[tuple[TextEdit, ...], str]:
    """A line in front of each keyword of a run that does not belong in the section of the one before; the first."""
    edits: list[TextEdit] = []
    for head, keyword in run:
        sections = catalogue.sections_of(keyword) or ((current,) if current else ("MODEL",))
        if current not in sections:
            current = sections[0]
            edits.append(TextEdit(Span(head, head), f"${current}\n"))
    return tuple(edits), edits[0].text.strip() if edits else ""


# --------------------------------------------------------------------------------------------------------------- copies

_DEFINES = {"NODE": REF007, "ELEMENT": REF007, "ELEMENT SETS": REF016}


def copies(blocks: Blocks) -> Iterator[Correction]:
    """Blocks of the model that stand there once more, word for word: without the copies."""
    model = [block for name, block in blocks.blocks if name == "MODEL"]
    names = [block.name for block in model if block.name in _DEFINES]
    if len(set(names)) == len(names):
        return
    unified = blocks.text.source.unified
    known: dict[str, RawBlock] = {}
    runs: list[list[tuple[RawBlock, RawBlock]]] = [[]]
    for block in model:
        written = unified[slice(*whole(block))].strip()
        if written in known:
            runs[-1].append((block, known[written]))
        elif runs[-1]:
            runs.append([])
        known.setdefault(written, block)
    for run in runs:
        defining = next((block for block, _ in run if block.name in _DEFINES and block.leaves), None)
        if defining is not None:
            yield _without(blocks, run, defining)


def _without(blocks: Blocks, run: list[tuple[RawBlock, RawBlock]], defining: RawBlock) -> Correction:
    """The text without a run of copies; `defining` is the first of them that defines something."""
    text = blocks.text
    first, last = whole(run[0][0]), whole(run[-1][0])
    begin, end = (text.source.position(at)[0] for at in (first.start, last.end - 1))
    original = run[0][1].head.span.start
    message = f"lines {begin} to {end} repeat the lines from {text.source.position(original)[0]} on word for word"
    severity = None if blocks.section_at(original) == blocks.section_at(first.start) else Severity.WARNING
    code = _DEFINES[defining.name]
    rows = next((leaf for leaf in defining.leaves if leaf.kind not in (Kind.COMMENT, Kind.BLANK)), defining.leaves[0])
    place = trimmed(text.source.unified, *line_at(text, rows.span.start))
    cause = Problem(code, f"{message}: remove them", place, severity, blocks=Blocking.NEVER)
    edits = tuple(TextEdit(whole(block), "") for block, _ in run)
    return Correction(cause, edits, Span(first.start, last.end), certain=True)


# ----------------------------------------------------------------------------------------------------------------- laws

_LAW = re.compile(r"^[ \t]*TYPE[ \t]*=[ \t]*(?:ELASTIC|RIGID)[ \t]*$", re.IGNORECASE | re.MULTILINE)


def stray_laws(blocks: Blocks) -> Iterator[Correction]:
    """Lines of *SEABED PROPERTIES in blocks that are passed through: its keyword line above them."""
    text = blocks.text
    for number, section in enumerate(blocks.deck.sections):
        for index, block in enumerate(section.blocks):
            if type(block) is not Opaque or section.name not in (catalogue.sections_of(block.keyword) or ()):
                continue
            if not any(map(_LAW.match, block.lines)):
                continue
            found = _LAW.search(text.source.unified, text.heads[Where(number, index)].end)
            if found:
                message = (
                    f"*{block.keyword} has no such line: begin *SEABED PROPERTIES above it, else no seabed law applies"
                )
                place = Span(found.start(), found.start())
                repair = Repair(
                    "unsafe", "begin *SEABED PROPERTIES above this line", ((place, "*SEABED PROPERTIES\n"),)
                )
                cause = Problem(SBD006, message, Span(*found.span()), repair=repair)
                edit = TextEdit(place, "*SEABED PROPERTIES\n")
                yield Correction(cause, (edit,), blocks.block_at(place.start), certain=True)
