"""Names that are misspelt, left out, or stand where they do not belong: of keywords, settings, sets and curves."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from functools import cache
from itertools import chain

from mudline.codes.fields import SYN002, SYN003
from mudline.codes.lines import SYN001, SYN004, SYN005, SYN008, SYN009, SYN010, SYN013, SYN014
from mudline.diagnostics import Problem, Span
from mudline.keywords import catalogue
from mudline.keywords.model import Block, Setting, record_schema
from mudline.keywords.reader import all_keys
from mudline.keywords.values import Names
from mudline.linting.recovery.blocks import (
    Blocks,
    Correction,
    also_in,
    behind,
    data_of,
    line_at,
    lines_of,
    recovers_from,
    start_of,
    whole,
)
from mudline.syntax.edits import TextEdit
from mudline.syntax.rows import read_number
from mudline.syntax.tree import Kind, RawBlock

MOST_SETTINGS = 8
"""Settings of a block that may be the values of one row."""

_DIGITS = re.compile(r"[0-9]+")
_NAMED_POINT = re.compile(r"[ \t]*([^-+.,=0-9 \t][^,=\n]*?)[ \t]*,[ \t]*([-+.0-9][^\n\r]*?)[ \t\r]*")
_LACKS_NAME = re.compile(r"expected ([A-Z]+)= before this line|([A-Z]+)= has no value")


@recovers_from(SYN004, SYN005, SYN008, SYN009, SYN010)
def misspelt(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Names for which another one was meant; one that is misspelt several times is corrected everywhere."""
    alike: dict[tuple[str, str], list[Problem]] = {}
    for problem in problems:
        if problem.repair is not None:
            alike.setdefault((problem.code.code, problem.message), []).append(problem)
    text = blocks.text
    for found in alike.values():
        problem = min(found, key=lambda one: start_of(text, one))
        repairs = [one.repair.edits for one in found if one.repair is not None]
        edits = tuple(TextEdit(span, written) for span, written in sorted(chain.from_iterable(repairs)))
        first = edits[0].span
        region = blocks.section_at(first.start) if problem.code is SYN010 else blocks.block_at(first.start)
        others = [one for one in found if one is not problem]
        message = f"{problem.message}; {also_in(text, others)}" if others else ""
        does = problem.repair.message if problem.repair else ""
        if all(_differs(text.source.unified[slice(*edit.span)], edit.text) for edit in edits):
            yield Correction(problem, edits, region, message, does, joins=edits[0].text.startswith("C "))


def _differs(written: str, meant: str) -> bool:
    """Whether a name differs in more than its digits from the one that was meant: they tell things of a kind apart."""
    return _DIGITS.sub("", meant).casefold() != _DIGITS.sub("", written).casefold()


# ------------------------------------------------------------------------------------------------ points and their name


@cache
def key_of_points(declared: type[Block]) -> tuple[str, Names | None]:
    """The setting above the points of a curve that names it, and what the name is one of; "" for other keywords."""
    for slot in record_schema(declared).slots:
        for record in map(record_schema, slot.record.values()):
            about = record.slots[0].about if record.table and record.slots else None
            if isinstance(about, Setting) and (kind := about.names or about.defines):
                return about.key, kind
    return "", None


@recovers_from(SYN002, SYN003)
def points_with_names(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Points with the name of their set or curve in front, as a graphical interface shows them."""
    text = blocks.text
    wrong = {line_at(text, start_of(text, one)).start: one for one in reversed(problems)}
    for block, declared in blocks.declared():
        key, _ = key_of_points(declared)
        edits: list[TextEdit] = []
        cause, first, known = None, "", ""
        for span in lines_of(text, block) if key else ():
            named = _NAMED_POINT.fullmatch(text.source.unified, *span) if span.start in wrong else None
            if named is None:
                continue
            name, point = named.groups()
            head = "" if name == known else f" {key}={name}\n"
            edits.append(TextEdit(span, f"{head} {point}"))
            if cause is None:
                cause, first = wrong[span.start], f"write {head.strip()} on a line of its own, and {point} below it"
            known = name
        if cause is not None:
            message = f"rows of a name and a point, as a graphical interface shows them: {first}"
            yield Correction(cause, tuple(edits), whole(block), message)


@recovers_from(SYN001, SYN003)
def lacking_names(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """A setting without its name, or points in front of it: the names that nothing defines."""
    text = blocks.text
    unclaimed: dict[Names, list[str]] = {}
    for problem in problems:
        found = _LACKS_NAME.match(problem.message)
        declared = blocks.declared_at(problem.span.start) if found and problem.span else None
        if found is None or problem.span is None or declared is None:
            continue
        key = found[1] or found[2]
        kind = _defined_by(declared, key)
        names = unclaimed.setdefault(kind, [*blocks.missing(kind)]) if kind else []
        if found[1] and not names and (moved := _name_below(blocks, problem, key)):
            yield moved
        if names:
            name = names.pop(0)
            at, written = problem.span.end, name
            if found[1]:
                at, written = line_at(text, problem.span.start).start, f" {key}={name}\n"
            yield Correction(problem, (TextEdit(Span(at, at), written),), line_at(text, problem.span.start))


@cache
def _defined_by(declared: type[Block], key: str) -> Names | None:
    """What a setting of a keyword gives a new thing its name of."""
    records = (record for slot in record_schema(declared).slots for record in slot.record.values())
    slots = (record_schema(record).keys.get(key) for record in records)
    return next((slot.about.defines for slot in slots if slot), None)


def _name_below(blocks: Blocks, problem: Problem, key: str) -> Correction | None:
    """The first line with a name below points without one: above them."""
    text = blocks.text
    at = start_of(text, problem)
    block = blocks.raw_at(at)
    for leaf in block.leaves if block else ():
        if leaf.span.start < at or leaf.kind is not Kind.SETTING:
            continue
        line = line_at(text, leaf.span.start)
        written = text.source.unified[slice(*line)]
        if written.partition("=")[0].strip().upper() != key:
            break
        last, first = (_first_number(blocks, each) for each in (line.start - 1, behind(text, line)))
        if last is not None and first is not None and first < last:
            break  # the points below it are of a curve of their own
        begin = line_at(text, at).start
        message = f"{written.strip()} in line {text.source.position(line.start)[0]} stands below its points: move it up"
        edits = (
            TextEdit(Span(begin, begin), f"{written}\n"),
            TextEdit(Span(line.start, behind(text, line)), ""),
        )
        return Correction(problem, edits, Span(begin, line.end), message)
    return None


def _first_number(blocks: Blocks, offset: int) -> float | None:
    """The first number of the line around an offset, None for other lines."""
    words = blocks.text.source.unified[slice(*line_at(blocks.text, offset))].split(",")
    return read_number(words[0].strip())


@recovers_from(SYN014)
def cut_off(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """A file that ends behind the keyword of curves: those that nothing defines."""
    names = blocks.missing(Names.CURVE)
    for problem in problems if names else ():
        at = start_of(blocks.text, problem)
        block, declared = blocks.raw_at(at), blocks.declared_at(at)
        if block is None or declared is None or block.leaves or key_of_points(declared)[1] is not Names.CURVE:
            continue
        key, _ = key_of_points(declared)
        curves = "".join(f"\n {key}={name}\n 0.0, 0.0\n 1.0, 100000.0" for name in names)
        edit = TextEdit(Span(blocks.end, blocks.end), f"{curves}\n")
        yield Correction(problem, (edit,), whole(block), certain=True)


# ----------------------------------------------------------------------------------- settings that were meant otherwise


@recovers_from(SYN004, SYN013)
def other_settings(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Settings that were meant otherwise: CURVE= for SET=, data read as a comment, KEY= where a row belongs."""
    text = blocks.text
    for problem in problems:
        at = start_of(text, problem)
        block, declared = blocks.raw_at(at), blocks.declared_at(at)
        if block is None or declared is None:
            continue
        line = line_at(text, at)
        key, _, value = text.source.unified[slice(*line)].strip().partition("=")
        name, _ = key_of_points(declared)
        if (
            name
            and key.strip().upper() in _names_of_curves() - {name}
            and _first_number(blocks, behind(text, line)) is not None
        ):
            yield Correction(problem, (TextEdit(line, f" {name}={value.strip()}"),), whole(block))
        elif problem.code is SYN004 and not all_keys(declared) and (row := _as_row(blocks, block)):
            edits = (TextEdit(Span(block.leaves[0].span.start, whole(block).end), f" {row}\n"),)
            message = f"*{block.name} takes no KEY= at all: write the values as a row, {row}"
            yield Correction(problem, edits, whole(block), message)


@cache
def _names_of_curves() -> frozenset[str]:
    """The settings that name the set or the curve of points."""
    read = filter(None, map(catalogue.declared, catalogue.read_keywords()))
    return frozenset(
        key for declared in read if declared.facts.defines == "curves" and (key := key_of_points(declared)[0])
    )


def _as_row(blocks: Blocks, block: RawBlock) -> str:
    """The values of a block of settings alone, as a row; "" for other blocks."""
    lines = data_of(block.leaves)
    if len(lines) > MOST_SETTINGS or any(leaf.kind is not Kind.SETTING for leaf in lines):
        return ""
    written = (blocks.text.source.unified[slice(*leaf.span)] for leaf in lines)
    return ", ".join(line.partition("=")[2].strip() for line in written)
