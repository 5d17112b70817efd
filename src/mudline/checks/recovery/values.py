"""Typing errors in numbers and rows, and in names and numbers that are not defined."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace

from mudline.basics.spelling import Effort, meant_names
from mudline.checks.context import ROW_NUMBER, LintContext, also_in
from mudline.checks.recovery.lines import Blocks, Correction, start_of
from mudline.checks.rules.style import INDENTED_COMMENT
from mudline.language.codes.fields import SYN015
from mudline.language.codes.lines import SYN001
from mudline.language.codes.references import REF001, REF002, REF005, REF006, REF007, REF008, REF019
from mudline.language.deck.parameters import folded, name_key
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import Problem, Repair, Severity, Span, Where
from mudline.language.keywords.contents import names_given
from mudline.language.keywords.model import Block, Part, record_schema
from mudline.language.keywords.reader import schemas_of
from mudline.language.keywords.values import Kind, Names
from mudline.language.syntax.edits import TextEdit
from mudline.language.syntax.rows import NUMBER
from mudline.model.scene.curves import SceneCurve
from mudline.model.scene.references import CURVES, THINGS, undefined
from mudline.model.scene.rules.fields import undefined_curve
from mudline.model.scene.sets import ALL

_MISREAD = str.maketrans({"O": "0", "o": "0", "l": "1", "I": "1"})
_GAP = re.compile(r"(?<=[0-9.])(?:[ \t]+|[ \t]*;[ \t]*)(?=[-+.0-9])")
_HALVES = re.compile(r"([0-9]+),([0-9]+)")
LONGEST_ABOVE = 500
"""Number of characters that are searched above a number."""

_WHOLE = re.compile(r"(?<![0-9.])[0-9]+(?![0-9.])")
_UNIT = re.compile(r"[ \t]*[A-Za-z%]")


def numbers(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Yield corrections of numbers with a wrong letter on which other values depend, if the right number is clear."""
    for problem in problems:
        span = problem.span
        declared = blocks.declared_at(span.start) if span and problem.weight is Severity.ERROR else None
        if span is None or declared is None or not _is_known_by(blocks, declared, span):
            continue
        unified = blocks.text.source.unified
        for number in _read_as(unified[slice(*span)]):
            if number[1] or declared.facts.tells_units or _goes_on(unified, span.start, number[0]):
                yield Correction(
                    problem, (TextEdit(span, number[0]),), blocks.text.source.line_around(span.start), certain=True
                )


def _is_known_by(blocks: Blocks, declared: type[Block], span: Span) -> bool:
    """Return True if other values depend on a value: it is a whole number, or shows the units."""
    if declared.facts.tells_units:
        return True
    before = blocks.text.source.unified[blocks.text.source.line_around(span.start).start : span.start]
    key = before.partition("=")[0].strip().upper() if "=" in before else ""
    index = before.rpartition("=")[2].count(",")
    for slot in (slot for schema in schemas_of(declared) for slot in schema.slots if slot.key == key):
        columns = record_schema(slot.row).columns if slot.row else [slot]
        if columns[min(index, len(columns) - 1)].kind in (Kind.WHOLE, Kind.IDENT):
            return True
    return False


def _read_as(written: str) -> Iterator[tuple[str, bool]]:
    """Yield the numbers that a word with a wrong letter may be, and True if a digit replaces the letter (likely)."""
    translated = written.translate(_MISREAD)
    if translated != written and NUMBER.fullmatch(translated):
        yield translated, True
    if (begun := NUMBER.match(written)) and _UNIT.match(written, begun.end()):
        yield begun[0], False


def _goes_on(unified: str, at: int, number: str) -> bool:
    """Return True if a number follows a number of the two data lines above, as in ranges and rows of numbers."""
    lines = unified[max(at - LONGEST_ABOVE, 0) : unified.rfind("\n", 0, at) + 1].rsplit("\n", 3)[-3:]
    return number.isdecimal() and str(int(number) - 1) in _WHOLE.findall(" ".join(lines))


def rows(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Yield corrections that put commas instead of spaces or semicolons between the numbers of rows."""
    errors = [one for one in problems if one.weight is Severity.ERROR]
    for line, problem in blocks.first_of_lines(errors).items():
        written = blocks.text.source.unified[slice(*line)]
        if (replacement := _GAP.sub(", ", written)) != written:
            yield Correction(problem, (TextEdit(line, replacement),), line)


def indented_comments(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Yield corrections of comments with spaces before their C, which make them data: the spaces are removed."""
    unified = blocks.text.source.unified
    for line, problem in blocks.first_of_lines(problems).items():
        if problem.weight is Severity.ERROR and (comment := INDENTED_COMMENT.match(unified, line.start)):
            blanks = Span(line.start, line.start + len(comment[0]) - len(comment[0].lstrip(" \t")))
            message = f"{problem.message}; an indented line is data: if it is meant as a comment, put its C in column 1"
            yield Correction(problem, (TextEdit(blanks, ""),), line, message, does="put the C in column 1")


def decimal_commas(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Yield corrections that join two fields, in a row with the maximum number of fields, by a decimal point."""
    others = (one for one in blocks.deck.problems if one.code is not SYN015 and one.weight is Severity.ERROR)
    errors = set(map(blocks.line_of, others))
    for problem in problems:
        line = blocks.line_of(problem)
        if problem.span is None or line in errors:
            continue
        place = Span(problem.span.start, line.end)
        edit = TextEdit(place, _HALVES.sub(r"\1.\2", blocks.text.source.unified[slice(*place)]))
        repair = problem.repair or Repair("unsafe", f"write {edit.text.strip()}", (edit,))
        yield Correction(replace(problem, repair=repair), (edit,), line)


def scene_corrections(context: LintContext) -> Iterator[Correction]:
    """Yield corrections of names and numbers that the scene of a deck lacks; they need no trial."""
    text, scene = context.text, context.scene
    if text is None:
        return
    sets = {key: one.name for key, one in scene.set_table.named.items() if key != ALL}
    curves = {folded(one.name): one.name for one in scene.laws.curves if one.name and not one.embedment}
    used = {where for where, _ in _used_names(context, Names.CURVE)}
    nameless = [one for one in undefined_curve(scene) if one.where in used]
    lacking = [one for one in scene.noticed if one.lacks and one.code in (REF001, REF008)]
    effort = Effort()
    yield from _names(context, lacking, sets, (Names.SET, Names.SUBSET), effort)
    yield from _names(context, nameless, curves, (Names.CURVE,), effort)
    for kinds, code in ((CURVES, REF002), (THINGS, REF019)):
        for names in scene.context.names_of(kinds):
            lost = [*undefined(scene.context, [names.kind], code)]
            yield from _names(context, lost, names.known, (names.kind,), effort)
    yield from _numbers(context, text)
    yield from _given_twice(context, text)
    unlike = [one.lacks for one in nameless if not meant_names(one.lacks, curves, effort)]
    yield from _rows_without_name(context, text, unlike)


def _used_names(context: LintContext, *kinds: Names) -> Iterator[tuple[Where, str]]:
    """Return the names of some kinds that the fields of a deck use, with their places."""
    return ((place.where, place.name) for place in context.names if place.role == "names" and place.kind in kinds)


def _names(
    context: LintContext, problems: list[Problem], known: dict[str, str], kinds: tuple[Names, ...], effort: Effort
) -> Iterator[Correction]:
    """Yield corrections of names for which only one other name can be meant, in all their places."""
    alike: dict[str, list[Problem]] = {}
    for problem in problems:
        if problem.weight is Severity.ERROR:
            alike.setdefault(name_key(problem.lacks), []).append(problem)
    text = context.text
    if not alike or text is None:
        return
    places: dict[str, list[Where]] = {}
    for where, name in _used_names(context, *kinds):
        places.setdefault(name_key(name), []).append(where)
    for key, found in alike.items():
        near = meant_names(key, known, effort)
        if len(near) != 1:
            continue
        uses = places.get(key, [])
        spans = sorted({span for where in uses if (span := text.span(where))})
        corrected = known[near[0]]
        if not spans or any(_own_name(context, where) == near[0] for where in uses):
            continue
        first, *others = sorted(found, key=lambda one: start_of(text, one))
        message = f"{first.message}; {also_in(text, others)}" if others else ""
        edits = tuple(TextEdit(span, corrected) for span in spans)
        yield Correction(first, edits, spans[0], message, does=f"write {corrected}")


def _own_name(context: LintContext, where: Where) -> str:
    """Return the folded name that the record around a place defines, "" if it defines none."""
    record = context.scene.context.written.at(where._replace(path=where.path[:2]))
    names = (name for _, name in names_given(record, Names.SET, "defines")) if isinstance(record, Part) else ()
    return name_key(next(iter(names), ""))


def _numbers(context: LintContext, text: TextOrigin) -> Iterator[Correction]:
    """Yield corrections of unreadable numbers of nodes and elements that can only be one undefined number."""
    for where, candidates in context.scene.context.excused.items():
        span = text.span(where)
        cause = next((one for one in context.deck.problems if span and one.span == span), None)
        if span is not None and cause is not None and len(candidates) == 1:
            number = str(min(candidates))
            message = f"{cause.message} (did you mean {number}?)"
            yield Correction(cause, (TextEdit(span, number),), span, message, does=f"write {number}")


def _given_twice(context: LintContext, text: TextOrigin) -> Iterator[Correction]:
    """Yield corrections of repeated numbers, if a neighbouring row shows that an undefined number is meant."""
    noticed = context.scene.noticed
    lacking = {one.lacks for one in noticed if one.lacks and one.code in (REF005, REF006)}
    for problem in noticed if lacking else ():
        if problem.code is not REF007 or text.span_of(problem) is None:
            continue
        line = text.place(problem).line
        spans = (text.source.line_span(number) for number in (line, line - 1, line + 1))
        own, above, below = (ROW_NUMBER.match(text.source.unified, *span) for span in spans)
        candidates = {str(int(row[1]) + step) for row, step in ((above, 1), (below, -1)) if row} & lacking
        if own and len(candidates) == 1:
            number, span = candidates.pop(), Span(*own.span(1))
            lacking.discard(number)
            message = f"number {own[1]} is given twice, and {number} is not defined: is this one {number}?"
            yield Correction(problem, (TextEdit(span, number),), span, message, does=f"write {number}")


def _rows_without_name(context: LintContext, text: TextOrigin, curves: list[str]) -> Iterator[Correction]:
    """Yield a line with an undefined curve, or with an unused set, above points that begin again."""
    for curve in context.scene.laws.curves:
        point = _begins_again(curve)
        if not point or (curve.embedment and curve.whole):
            continue
        names = _unused_set(context) if curve.embedment else curves
        span = text.span(curve.point(point)) if names else None
        if span is None:
            continue
        line = f"{'SET' if curve.embedment else 'CURVE'}={names.pop(0)}"
        start = text.source.line_around(span.start).start
        edit = TextEdit(Span(start, start), f" {line}\n")
        message = f"the points begin again here: the line {line} seems to be missing above this one"
        yield Correction(Problem(SYN001, message, span), (edit,), span, does=f"write {line}")


def _unused_set(context: LintContext) -> list[str]:
    """Return the name of the only set that is not used."""
    used = {name_key(name) for _, name in _used_names(context, Names.SET, Names.SUBSET)}
    named = context.scene.set_table.named
    sets = [set_.name for key, set_ in named.items() if key not in used and set_.where is not None]
    return sets if len(sets) == 1 else []


def _begins_again(curve: SceneCurve) -> int:
    """Return the point of a curve that goes back to its first ratio, if both parts rise; 0 for other curves."""
    ratios = curve.points[:, 0].tolist()
    back = [at for at in range(1, len(ratios)) if ratios[at] <= ratios[at - 1]]
    again = len(back) == 1 and ratios[back[0]] == ratios[0] and min(back[0], len(ratios) - back[0]) > 1
    return back[0] if again else 0
