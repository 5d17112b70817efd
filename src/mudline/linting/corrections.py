"""What may correct a fault from which other findings follow: a name that was meant, a `$SECTION` line, a value."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import chain

from mudline.codes.lines import SYN004, SYN005, SYN007, SYN008, SYN009, SYN010
from mudline.codes.references import REF007
from mudline.deck.reading import TextOrigin
from mudline.diagnostics import Problem, Severity, Span, Where
from mudline.keywords import catalogue
from mudline.syntax.edits import TextEdit
from mudline.syntax.rows import NUMBER
from mudline.syntax.tree import RawBlock, RawSection

_NAMES = (SYN004, SYN005, SYN008, SYN009, SYN010)


@dataclass(frozen=True, slots=True)
class Correction:
    """Edits that may correct a finding, and the part of the text that is read differently then.

    `message` is what the finding says where the correction holds, "" for its own message, and `place` where it is then,
    None for its own place. New findings tell against a correction that is `guessed`.
    """

    cause: Problem
    edits: tuple[TextEdit, ...]
    region: Span
    message: str = ""
    guessed: bool = False
    place: Span | None = None


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
    for found in alike.values():
        problem = min(found, key=lambda one: start_of(blocks.text, one))
        repairs = [one.repair.edits for one in found if one.repair is not None]
        edits = tuple(TextEdit(span, written) for span, written in sorted(chain.from_iterable(repairs)))
        first = edits[0].span
        region = blocks.section_at(first.start) if problem.code is SYN010 else blocks.block_at(first.start)
        yield Correction(problem, edits, region)


class Blocks:
    """The blocks of a text by their place, sorted out when somebody asks."""

    def __init__(self, text: TextOrigin) -> None:
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
        edits, words = _section_lines(run, "")
        if len(run) > 1:
            message = f"the line {words} is missing above this one: *{run[0][1]} stands before any $SECTION"
        else:
            message = ""
        yield Correction(first, edits, Span(run[0][0], end), message)
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
    return Correction(first, edits, Span(run[0][0], end), message)


def _section_lines(run: list[tuple[int, str]], current: str) -> tuple[tuple[TextEdit, ...], str]:
    """A line in front of each keyword of a run that does not belong in the section of the one before; the first."""
    edits: list[TextEdit] = []
    for head, keyword in run:
        sections = catalogue.sections_of(keyword) or ((current,) if current else ("MODEL",))
        if current not in sections:
            current = sections[0]
            edits.append(TextEdit(Span(head, head), f"${current}\n"))
    return tuple(edits), edits[0].text.strip() if edits else ""


# --------------------------------------------------------------------------------------------------------------- values

MOST_POINTS = 64
"""Points of a curve that are put in order."""

_ROW_NUMBER = re.compile(r"[ \t]*([0-9]{1,10})[ \t]*(?=,)")
_RIGID = re.compile(r"[ \t]*TYPE[ \t]*=[ \t]*(RIGID)[ \t\r\n]*", re.IGNORECASE)
_USER_UNITS = (".keyx", ".keyxu")
_OF_DENSITIES = ("UNT004", "UNT005", "UNT006")
"""Codes of rules that compare with the density of the water."""
_MASSES = (0.001, 1000.0)
"""Factors between units of mass that are exchanged: kilograms and tonnes."""


def value_corrections(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Return corrections of what was read as it stands and is at odds with the rest of the deck."""
    parts = (_numbers, _copies, _columns, _points, _law_lines, _rigid, _water)
    return chain.from_iterable(part(blocks, problems) for part in parts)


def _numbers(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """A number that is given twice: one of those that nothing has."""
    text = blocks.text
    missing = list(dict.fromkeys(one.lacks for one in problems if one.code.code in ("REF005", "REF006") and one.lacks))
    for problem in problems if missing else ():
        if problem.code is not REF007:
            continue
        line = line_at(text, start_of(text, problem))
        found = _ROW_NUMBER.match(text.source.unified, *line)
        for number in missing if found else ():
            if found and number in _between(text, line):
                message = f"number {found[1]} is given twice, and {number} is not defined: is this one {number}?"
                yield Correction(problem, (TextEdit(Span(*found.span(1)), number),), line, message, guessed=True)


def _between(text: TextOrigin, line: Span) -> set[str]:
    """The numbers that a row would have if it followed the row above it, or came before the one below it."""
    unified = text.source.unified
    above = _ROW_NUMBER.match(unified, *line_at(text, max(line.start - 1, 0)))
    below = _ROW_NUMBER.match(unified, *line_at(text, min(line.end + 1, len(unified))))
    after, before = (int(row[1]) if row else None for row in (above, below))
    return {str(each) for each in (after and after + 1, before and before - 1) if each}


def _copies(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Blocks of the model that stand there once more, word for word: without the copies."""
    text = blocks.text
    repeats = [one for one in problems if one.code.code in ("REF007", "REF016")]
    if not repeats:
        return
    unified = text.source.unified
    known: dict[str, RawBlock] = {}
    runs: list[list[tuple[RawBlock, RawBlock]]] = [[]]
    for name, block in blocks.blocks:
        written = unified[slice(*whole(block))].strip() if name == "MODEL" else ""
        if written and written in known:
            runs[-1].append((block, known[written]))
        elif runs[-1]:
            runs.append([])
        known.setdefault(written, block)
    for run in filter(None, runs):
        first, last = whole(run[0][0]), whole(run[-1][0])
        cause = next((one for one in repeats if first.start <= start_of(text, one) < last.end), None)
        if cause is None:
            continue
        begin, end = (text.source.position(at)[0] for at in (first.start, last.end - 1))
        original = text.source.position(run[0][1].head.span.start)[0]
        message = f"lines {begin} to {end} repeat the lines from {original} on word for word: remove them"
        edits = tuple(TextEdit(whole(block), "") for block, _ in run)
        yield Correction(cause, edits, Span(first.start, last.end), message)


# --------------------------------------------------------------------------------------------------------- curves


def _columns(_: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Curves with their columns exchanged."""
    for problem in problems:
        if problem.code.code == "CRV009" and problem.repair is not None:
            edits = tuple(TextEdit(span, written) for span, written in problem.repair.edits)
            yield Correction(problem, edits, Span(edits[0].span.start, edits[-1].span.end))


def _points(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Several findings about the shape of one curve: without the point of a large ratio, or with rising forces."""
    text = blocks.text
    of_curve: dict[Where, list[Problem]] = {}
    for problem in problems:
        where = problem.where
        if problem.code.code.startswith("CRV") and where is not None and "points" in where.path:
            curve = where._replace(path=where.path[: where.path.index("points")])
            of_curve.setdefault(curve, []).append(problem)
    for curve, found in of_curve.items():
        far = [one for one in found if one.code.code == "CRV010"]
        for problem in far if len(found) > 1 else ():
            line = line_at(text, start_of(text, problem))
            yield Correction(problem, (TextEdit(Span(line.start, line.end + 1), ""),), line)
        falling = [one for one in found if one.code.code == "CRV005"]
        if not far and len(falling) == 1 < len(found) and (edits := _rising(text, curve)):
            region = Span(edits[0].span.start, edits[-1].span.end)
            yield Correction(falling[0], edits, region, guessed=True)


def _rising(text: TextOrigin, curve: Where) -> tuple[TextEdit, ...]:
    """The points of a curve in their order, with its forces in rising order."""
    rows: list[tuple[Span, list[float]]] = []
    for number in range(MOST_POINTS + 1):
        span = text.span(curve.inside("points", number))
        if span is None or (rows and span.start <= rows[-1][0].start):
            break
        values = NUMBER.findall(text.source.unified[slice(*span)])
        if len(values) != 2:
            return ()
        rows.append((span, [float(value.upper().replace("D", "E")) for value in values]))
    if not 1 < len(rows) <= MOST_POINTS:
        return ()
    forces = sorted(force for _, (_, force) in rows)
    ratios = sorted(ratio for _, (ratio, _) in rows)
    return tuple(
        TextEdit(span, f"{ratio!r}, {force!r}") for (span, _), ratio, force in zip(rows, ratios, forces, strict=True)
    )


# ----------------------------------------------------------------------------------------------------------- laws


def _law_lines(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Lines of *SEABED PROPERTIES under another keyword: its line above them."""
    text = blocks.text
    for problem in problems:
        if problem.code.code == "SBD006" and problem.repair is not None:
            edits = tuple(TextEdit(span, written) for span, written in problem.repair.edits)
            yield Correction(problem, edits, line_at(text, edits[0].span.start))


def _rigid(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """A rigid seabed under extensions that need an elastic one: an elastic one."""
    text = blocks.text
    cause = next((one for one in problems if one.code.code == "EXT001"), None)
    if cause is None:
        return
    edits: list[TextEdit] = []
    for _, block in blocks.blocks:
        if block.name == "SEABED PROPERTIES":
            found = (_RIGID.fullmatch(text.source.unified, *leaf.span) for leaf in block.leaves)
            edits += [TextEdit(Span(*one.span(1)), "ELASTIC") for one in found if one]
    if edits:
        yield Correction(cause, tuple(edits), line_at(text, start_of(text, cause)), place=edits[0].span)


# ---------------------------------------------------------------------------------------------------------- units


def _water(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """In user units, values that do not fit the density of the water: that density in the other unit of mass."""
    text = blocks.text
    wrong = [one for one in problems if one.code.code.startswith("UNT")]
    cause = next((one for one in wrong if one.code.code in _OF_DENSITIES), None)
    if cause is None or len(wrong) < 2 or not text.source.name.lower().endswith(_USER_UNITS):
        return
    ocean = next((block for name, block in blocks.blocks if (name, block.name) == ("MODEL", "OCEAN")), None)
    values = list(NUMBER.finditer(text.source.unified, *whole(ocean))) if ocean else []
    if len(values) != 3:
        return
    density = values[1]
    place = Span(*density.span())
    for factor in _MASSES:
        other = f"{float(density[0]) * factor:.6g}"
        message = (
            f"the density {density[0]} of the water does not fit the rest of the deck, in which {other} would: "
            "write it in the deck's unit of mass"
        )
        edits = (TextEdit(place, other),)
        yield Correction(cause, edits, line_at(text, place.start), message, guessed=True, place=place)
