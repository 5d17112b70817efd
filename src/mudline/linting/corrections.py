"""What may correct a fault from which other findings follow: a name, a line that is missing, a number."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice

from mudline.codes.fields import SYN002, SYN003
from mudline.codes.lines import SYN001, SYN004, SYN005, SYN007, SYN008, SYN009, SYN010
from mudline.codes.references import REF007, REF009
from mudline.deck.reading import TextOrigin
from mudline.diagnostics import Problem, Severity, Span
from mudline.keywords import catalogue
from mudline.keywords.reader import read_block
from mudline.linting.rule import LintContext
from mudline.syntax.edits import TextEdit
from mudline.syntax.source import Source
from mudline.syntax.tree import Kind, RawBlock, parse

MOST_ALTERNATIVES = 4
"""Corrections of one finding that are tried."""

LONGEST_PIECE = 20_000
"""Characters of a block that are read to see which keyword its lines belong to."""

_NAMES = (SYN004, SYN005, SYN008, SYN009, SYN010)
_OF_FOREIGN_LINES = (SYN001, SYN002, SYN003, SYN004, REF007, REF009)
"""What the lines of another keyword give in a block."""
_MISREAD = str.maketrans({"O": "0", "o": "0", "l": "1", "I": "1"})
_NUMBER = re.compile(r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[EeDd][-+]?[0-9]+)?")
_CURVE_NAMES = {"EMBEDMENT": "SET", "SEABED STIFFNESS": "CURVE"}
"""Keywords of points, and the setting that names the curve."""
_NAMED_POINT = re.compile(r"[ \t]*([^-+.,=0-9 \t][^,=\n]*?)[ \t]*,[ \t]*([-+.0-9][^\n\r]*?)[ \t\r]*")
_LACKS_NAME = re.compile(r"expected (CURVE|SET)= before this line|(SET|CURVE)= has no value")
_UNDEFINED = re.compile(r"'([^']+)' is not defined")
_MISSING = re.compile(r"(?:node|element) ([0-9]+)\b[^;]* is not defined")


@dataclass(frozen=True, slots=True)
class Correction:
    """Edits that may correct a finding, and the part of the text that is read differently then.

    `message` is what the finding says if other findings follow from it; "" for its own message. A correction that is
    `guessed` must bring no new finding.
    """

    cause: Problem
    edits: tuple[TextEdit, ...]
    region: Span
    message: str = ""
    guessed: bool = False


def corrections(context: LintContext, problems: Sequence[Problem]) -> list[list[Correction]]:
    """Return for each finding that may be a cause the corrections of it, in the order of the text."""
    text = context.text
    if text is None:
        return []
    found = [*_misspelt(text, problems), *_sections(text, problems)]
    if any(one.code in _OF_FOREIGN_LINES for one in problems):
        found += _tables(text, problems)
        found += _keyword_lines(text, problems)
        found += _names(text, problems)
        found += _rows(text, problems)
    by_cause: dict[int, list[Correction]] = {}
    for correction in sorted(found, key=lambda one: one.edits[0].span):
        by_cause.setdefault(id(correction.cause), []).append(correction)
    return [alternatives[:MOST_ALTERNATIVES] for alternatives in by_cause.values()]


def _start(text: TextOrigin, problem: Problem) -> int:
    """Where a problem begins in the text, -1 where it has no place there."""
    span = problem.span or (text.span(problem.where) if problem.where else None)
    return -1 if span is None else span.start


def _misspelt(text: TextOrigin, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Names for which another one was meant."""
    blocks = _Blocks(text)
    for problem in problems:
        if problem.code not in _NAMES or problem.repair is None:
            continue
        edits = tuple(TextEdit(span, written) for span, written in problem.repair.edits)
        first = edits[0].span
        region = blocks.section_at(first.start) if problem.code is SYN010 else blocks.block_at(first.start)
        yield Correction(problem, edits, region)


class _Blocks:
    """The blocks of a text by their place."""

    def __init__(self, text: TextOrigin) -> None:
        self.end = len(text.source.unified)
        tree = text.tree
        self.heads = [section.head.span.start if section.head else 0 for section in (tree.preamble, *tree.sections)]
        self.blocks = [(section.name, block) for section in (tree.preamble, *tree.sections) for block in section.blocks]
        self.starts = sorted([*self.heads, *(block.head.span.start for _, block in self.blocks)])

    def block_at(self, offset: int) -> Span:
        """From the head of the block (or section) around an offset to the next one."""
        return self._around(self.starts, offset)

    def section_at(self, offset: int) -> Span:
        """From the head of the section around an offset to the next one."""
        return self._around(self.heads, offset)

    def _around(self, starts: list[int], offset: int) -> Span:
        at = bisect_right(starts, offset)
        return Span(starts[at - 1] if at else 0, starts[at] if at < len(starts) else self.end)


# ------------------------------------------------------------------------------------------- $SECTION lines


def _sections(text: TextOrigin, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Blocks that stand before their section, or in another one: a `$SECTION` line in front of each run of them."""
    outside = {_start(text, one): one for one in problems if one.code is SYN007}
    elsewhere = {_start(text, one): one for one in problems if one.code is SYN008}
    tree = text.tree
    heads = [trimmed_start(text, block) for block in tree.preamble.blocks]
    if run := [(head, block.name) for head, block in zip(heads, tree.preamble.blocks, strict=True) if head in outside]:
        end = tree.sections[0].head.span.start if tree.sections and tree.sections[0].head else _Blocks(text).end
        first = outside[run[0][0]]
        edits, words = _section_lines(run, "")
        if len(run) > 1:
            message = f"the line {words} is missing above this one: *{run[0][1]} stands before any $SECTION"
        else:
            message = ""
        yield Correction(first, edits, Span(run[0][0], end), message)
    for section in tree.sections:
        placed = [(trimmed_start(text, block), block.name) for block in section.blocks]
        for first, behind in _runs(placed, elsewhere):
            yield _moved(text, elsewhere[placed[first][0]], section.name, placed[first:behind], placed[behind:])


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


def trimmed_start(text: TextOrigin, block: RawBlock) -> int:
    """Where the name of a block begins: behind the blanks of its line."""
    line = text.source.unified[slice(*block.head.span)]
    return block.head.span.start + len(line) - len(line.lstrip(" \t"))


def _moved(
    text: TextOrigin, first: Problem, section: str, run: list[tuple[int, str]], behind: list[tuple[int, str]]
) -> Correction:
    """A run of blocks in a section of their own; the section goes on behind them."""
    edits, words = _section_lines(run, section)
    end = _Blocks(text).section_at(run[0][0]).end
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


# ------------------------------------------------------------------------------------------- *KEYWORD lines


def _keyword_lines(text: TextOrigin, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Lines in a block that read well as lines of another keyword: that keyword in front of them."""
    wanted = sorted((_start(text, one), number) for number, one in enumerate(problems) if one.code in _OF_FOREIGN_LINES)
    if not wanted:
        return
    for section in text.tree.sections:
        for block in section.blocks:
            end = (block.leaves or [block.head])[-1].span.end
            inside = [(at, number) for at, number in wanted if block.head.span.end <= at < end]
            if inside and any(problems[number].weight is Severity.ERROR for _, number in inside):
                yield from _missing_line(text, section.name, block, problems[inside[0][1]], inside[0][0])


def _missing_line(text: TextOrigin, section: str, block: RawBlock, cause: Problem, at: int) -> Iterator[Correction]:
    unified = text.source.unified
    end = block.leaves[-1].span.end
    line = unified.rfind("\n", 0, at) + 1
    settings = [leaf.span.start for leaf in block.leaves if leaf.kind is Kind.SETTING and leaf.span.start < line]
    first = next((leaf.span.start for leaf in block.leaves if leaf.kind not in (Kind.COMMENT, Kind.BLANK)), end)
    for place in (at for at in (line, *settings[-1:]) if at > first):  # the block has lines of its own before it
        read = _reads_as(text, section, block.name, unified[place:end])
        for keyword in islice(read, MOST_ALTERNATIVES):
            message = f"this line and those below it read as *{keyword}: that line seems to be missing above them"
            if place < line:
                number = text.source.position(place)[0]
                message = (
                    f"the lines from line {number} on read as *{keyword}: that line seems to be missing above them"
                )
            edit = TextEdit(Span(place, place), f"*{keyword}\n")
            yield Correction(cause, (edit,), Span(place, end), message, guessed=True)


def _reads_as(text: TextOrigin, section: str, own: str, lines: str) -> Iterator[str]:
    """The keywords of a section that take some lines as they stand.

    Numbers alone fit several keywords: they are those of one that the deck lacks.
    """
    given = {block.name for each in text.tree.sections for block in each.blocks}
    piece = lines if len(lines) <= LONGEST_PIECE else lines[: lines.rfind("\n", 0, LONGEST_PIECE) + 1]
    first = piece.split("\n", 1)[0].strip(" \t*").upper()
    for keyword in catalogue.read_keywords():
        declared = catalogue.block_class(section, keyword)
        if declared is None or keyword in (own, first):
            continue
        source = Source.from_bytes(f"${section}\n*{keyword}\n{piece}".encode(errors="replace"), "")
        raw = parse(source).sections[0].blocks[0]
        if keyword in given and not any(leaf.kind is Kind.SETTING for leaf in raw.leaves):
            continue
        read = read_block(source.unified, raw, declared, last=False)
        if not read.lost and not any(one.weight is Severity.ERROR for one in read.problems):
            yield keyword


# ------------------------------------------------------------------------------------------- names and rows


def _tables(text: TextOrigin, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Points with the name of their set or curve in front, as a graphical interface shows them."""
    wrong = {_line(text, _start(text, one)).start: one for one in reversed(problems) if one.code in (SYN002, SYN003)}
    for block in (block for section in text.tree.sections for block in section.blocks if block.name in _CURVE_NAMES):
        edits: list[TextEdit] = []
        cause, first = None, ""
        known = ""
        for span in _lines(text, block):
            named = _NAMED_POINT.fullmatch(text.source.unified, *span) if span.start in wrong else None
            if named is None:
                continue
            name, point = named.groups()
            head = "" if name == known else f" {_CURVE_NAMES[block.name]}={name}\n"
            edits.append(TextEdit(span, f"{head} {point}"))
            if cause is None:
                cause, first = wrong[span.start], f"write {head.strip()} on a line of its own, and {point} below it"
            known = name
        if cause is not None:
            message = f"rows of a name and a point, as a graphical interface shows them: {first}"
            yield Correction(cause, tuple(edits), Span(block.head.span.start, block.leaves[-1].span.end), message)


def _lines(text: TextOrigin, block: RawBlock) -> Iterator[Span]:
    """The lines of a block below its head, without their ends."""
    at = block.head.span.end
    end = (block.leaves or [block.head])[-1].span.end
    while at < end:
        line = _line(text, at)
        yield line
        at = text.source.unified.find("\n", at) + 1 or end


def _names(text: TextOrigin, problems: Sequence[Problem]) -> Iterator[Correction]:
    """A setting without its name, or points in front of it: the names that nothing defines."""
    missing = {"SET": _undefined(problems, "REF001"), "CURVE": _undefined(problems, "REF002")}
    for problem in problems:
        found = _LACKS_NAME.match(problem.message) if problem.code in (SYN001, SYN003) else None
        if found is None or problem.span is None:
            continue
        key = found[1] or found[2]
        for name in missing[key]:
            at, written = problem.span.end, name
            if found[1]:
                at, written = _line(text, problem.span.start).start, f" {key}={name}\n"
            yield Correction(problem, (TextEdit(Span(at, at), written),), _Blocks(text).block_at(at))


def _undefined(problems: Sequence[Problem], code: str) -> list[str]:
    """The names that findings of a code say are not defined."""
    found = (_UNDEFINED.search(one.message) for one in problems if one.code.code == code)
    return list(dict.fromkeys(name[1] for name in found if name))


def _rows(text: TextOrigin, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Numbers and rows with a slip of the pen: what they were to be, as far as that can be seen."""
    missing = list(dict.fromkeys(found for one in problems if (found := _missing_number(one))))
    if not any(one.code.code.startswith("REF") for one in problems):
        return
    for problem in problems:
        make: Callable[[str], list[str]]
        span = problem.span
        if span is None or problem.weight is not Severity.ERROR:
            continue
        if problem.code is SYN002:
            make = _numbers
        elif problem.code in (SYN001, SYN003):
            span = _line(text, span.start)
            make = _row
        else:
            continue
        written = text.source.unified[slice(*span)]
        alone = len(missing) == 1 and problem.code is SYN002
        for other in dict.fromkeys([*make(written), *(missing if alone else ())]):
            if other != written:
                yield Correction(problem, (TextEdit(span, other),), _line(text, span.start))


def _missing_number(problem: Problem) -> str:
    found = _MISSING.search(problem.message) if problem.code.code in ("REF005", "REF006") else None
    return found[1] if found else ""


def _line(text: TextOrigin, offset: int) -> Span:
    """The line around an offset, without its end."""
    unified = text.source.unified
    end = unified.find("\n", offset)
    end = len(unified) if end < 0 else end
    return Span(unified.rfind("\n", 0, offset) + 1, end - (unified[end - 1 : end] == "\r"))


def _numbers(written: str) -> list[str]:
    """The numbers that a word with a wrong letter may be."""
    translated = written.translate(_MISREAD)
    found = [translated] if _NUMBER.fullmatch(translated) else []
    if begun := _NUMBER.match(written):
        found.append(begun[0])
    return found


def _row(written: str) -> list[str]:
    """The numbers of a line, with commas between them."""
    found = _NUMBER.findall(written)
    return [f" {', '.join(found)}"] if len(found) > 1 else []
