"""Numbers and rows with a typing error."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace

from mudline.checks.recovery.blocks import Blocks, Correction, line_at, recovers_from, start_of
from mudline.checks.rules.style_lines import INDENTED_COMMENT
from mudline.language.codes.fields import SYN002, SYN003, SYN015
from mudline.language.codes.lines import SYN001
from mudline.language.diagnostics import Problem, Repair, Severity, Span
from mudline.language.keywords.model import Block, record_schema
from mudline.language.keywords.reader import schemas_of
from mudline.language.keywords.values import Kind
from mudline.language.syntax.edits import TextEdit
from mudline.language.syntax.rows import NUMBER

_MISREAD = str.maketrans({"O": "0", "o": "0", "l": "1", "I": "1"})
_GAP = re.compile(r"(?<=[0-9.])(?:[ \t]+|[ \t]*;[ \t]*)(?=[-+.0-9])")
_HALVES = re.compile(r"([0-9]+),([0-9]+)")
LONGEST_ABOVE = 500
"""Characters that are looked through above a number."""

_WHOLE = re.compile(r"(?<![0-9.])[0-9]+(?![0-9.])")
_UNIT = re.compile(r"[ \t]*[A-Za-z%]")


@recovers_from(SYN002)
def numbers(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Numbers by which other values are known, with a wrong letter: what they were to be, where that can be seen."""
    for problem in problems:
        span = problem.span
        declared = blocks.declared_at(span.start) if span and problem.weight is Severity.ERROR else None
        if span is None or declared is None or not _is_known_by(blocks, declared, span):
            continue
        unified = blocks.text.source.unified
        for other in _read_as(unified[slice(*span)]):
            if other[1] or declared.facts.tells_units or _goes_on(unified, span.start, other[0]):
                yield Correction(problem, (TextEdit(span, other[0]),), line_at(blocks.text, span.start), certain=True)


def _is_known_by(blocks: Blocks, declared: type[Block], span: Span) -> bool:
    """Whether other values are known by a value: it is a whole number, or says what the units are."""
    if declared.facts.tells_units:
        return True
    before = blocks.text.source.unified[line_at(blocks.text, span.start).start : span.start]
    key = before.partition("=")[0].strip().upper() if "=" in before else ""
    index = before.rpartition("=")[2].count(",")
    for slot in (slot for schema in schemas_of(declared) for slot in schema.slots if slot.key == key):
        columns = record_schema(slot.row).columns if slot.row else [slot]
        if columns[min(index, len(columns) - 1)].kind in (Kind.WHOLE, Kind.IDENT):
            return True
    return False


def _read_as(written: str) -> Iterator[tuple[str, bool]]:
    """The numbers that a word with a wrong letter may be: with a digit in its place, which is likely, or without it."""
    translated = written.translate(_MISREAD)
    if translated != written and NUMBER.fullmatch(translated):
        yield translated, True
    if (begun := NUMBER.match(written)) and _UNIT.match(written, begun.end()):
        yield begun[0], False


def _goes_on(unified: str, at: int, number: str) -> bool:
    """Whether a number is one more than another one of the two data lines above, as in ranges and rows of numbers."""
    lines = unified[max(at - LONGEST_ABOVE, 0) : unified.rfind("\n", 0, at) + 1].rsplit("\n", 3)[-3:]
    return number.isdecimal() and str(int(number) - 1) in _WHOLE.findall(" ".join(lines))


@recovers_from(SYN001, SYN003)
def rows(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Rows with blanks or semicolons between their numbers: commas there."""
    for problem in problems:
        if problem.span is None or problem.weight is not Severity.ERROR:
            continue
        line = line_at(blocks.text, problem.span.start)
        written = blocks.text.source.unified[slice(*line)]
        if (other := _GAP.sub(", ", written)) != written:
            yield Correction(problem, (TextEdit(line, other),), line)


@recovers_from(SYN001, SYN002, SYN003)
def indented_comments(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Comments with blanks before their C, which make them data: without these blanks."""
    unified = blocks.text.source.unified
    lines = {line_at(blocks.text, start_of(blocks.text, one)).start: one for one in reversed(problems)}
    for start, problem in lines.items():
        if problem.weight is Severity.ERROR and (found := INDENTED_COMMENT.match(unified, start)):
            blanks = Span(start, start + len(found[0]) - len(found[0].lstrip(" \t")))
            words = "an indented line is data: if it is meant as a comment, put its C in column 1"
            message, line = f"{problem.message}; {words}", line_at(blocks.text, start)
            yield Correction(problem, (TextEdit(blanks, ""),), line, message, does="put the C in column 1")


@recovers_from(SYN015)
def decimal_commas(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Fields that are the halves of one number, in a row that has as many as it may have: a point between them."""
    text = blocks.text
    others = (one for one in blocks.deck.problems if one.code is not SYN015 and one.weight is Severity.ERROR)
    errors = {line_at(text, start_of(text, one)) for one in others}
    for problem in problems:
        line = line_at(text, start_of(text, problem))
        if problem.span is None or line in errors:
            continue
        place = Span(problem.span.start, line.end)
        edit = TextEdit(place, _HALVES.sub(r"\1.\2", text.source.unified[slice(*place)]))
        repair = problem.repair or Repair("unsafe", f"write {edit.text.strip()}", ((edit.span, edit.text),))
        yield Correction(replace(problem, repair=repair), (edit,), line)
