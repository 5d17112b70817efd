"""What may correct lines from which other findings follow: a `*KEYWORD` line, a name, a number, commas."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from itertools import chain, islice

from mudline.codes.fields import SYN002, SYN003
from mudline.codes.lines import SYN001, SYN004
from mudline.codes.references import REF007, REF009
from mudline.deck.reading import TextOrigin
from mudline.diagnostics import Problem, Severity, Span
from mudline.keywords import catalogue
from mudline.keywords.reader import read_block
from mudline.linting.corrections import Blocks, Correction, line_at, start_of
from mudline.syntax.edits import TextEdit
from mudline.syntax.source import Source
from mudline.syntax.tree import Kind, RawBlock, parse

MOST_KEYWORDS = 4
"""Keywords that are tried for the lines of a block."""

LONGEST_PIECE = 20_000
"""Characters of a block that are read to see which keyword its lines belong to."""

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


def line_corrections(text: TextOrigin, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Return corrections of lines that cannot be read as they stand."""
    if not any(one.code in _OF_FOREIGN_LINES for one in problems):
        return iter(())
    parts = (_tables, _keyword_lines, _names, _rows)
    return chain.from_iterable(part(text, problems) for part in parts)


# ------------------------------------------------------------------------------------------- *KEYWORD lines


def _keyword_lines(text: TextOrigin, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Lines in a block that read well as lines of another keyword: that keyword in front of them."""
    wanted = sorted(
        (start_of(text, one), number) for number, one in enumerate(problems) if one.code in _OF_FOREIGN_LINES
    )
    if not wanted:
        return
    for section in text.tree.sections:
        for block in section.blocks:
            end = (block.leaves or [block.head])[-1].span.end
            inside = [(at, number) for at, number in wanted if block.head.span.end <= at < end]
            if inside and any(problems[number].weight is Severity.ERROR for _, number in inside):
                yield from _missingline_at(text, section.name, block, problems[inside[0][1]], inside[0][0])


def _missingline_at(text: TextOrigin, section: str, block: RawBlock, cause: Problem, at: int) -> Iterator[Correction]:
    unified = text.source.unified
    end = block.leaves[-1].span.end
    line = unified.rfind("\n", 0, at) + 1
    settings = [leaf.span.start for leaf in block.leaves if leaf.kind is Kind.SETTING and leaf.span.start < line]
    first = next((leaf.span.start for leaf in block.leaves if leaf.kind not in (Kind.COMMENT, Kind.BLANK)), end)
    for place in (at for at in (line, *settings[-1:]) if at > first):  # the block has lines of its own before it
        read = _reads_as(text, section, block.name, unified[place:end])
        for keyword in islice(read, MOST_KEYWORDS):
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
    wrong = {
        line_at(text, start_of(text, one)).start: one for one in reversed(problems) if one.code in (SYN002, SYN003)
    }
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
        line = line_at(text, at)
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
                at, written = line_at(text, problem.span.start).start, f" {key}={name}\n"
            yield Correction(problem, (TextEdit(Span(at, at), written),), Blocks(text).block_at(at))


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
            span = line_at(text, span.start)
            make = _row
        else:
            continue
        written = text.source.unified[slice(*span)]
        alone = len(missing) == 1 and problem.code is SYN002
        for other in dict.fromkeys([*make(written), *(missing if alone else ())]):
            if other != written:
                yield Correction(problem, (TextEdit(span, other),), line_at(text, span.start))


def _missing_number(problem: Problem) -> str:
    found = _MISSING.search(problem.message) if problem.code.code in ("REF005", "REF006") else None
    return found[1] if found else ""


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
