"""Names and numbers that the resolved deck uses and nothing defines: those that were meant, where that is known."""

from __future__ import annotations

from collections.abc import Iterator

from mudline.basics.spelling import Effort, meant_names
from mudline.checks.context import LintContext
from mudline.checks.recovery.blocks import ROW_NUMBER, Correction, also_in, behind, line_at, start_of
from mudline.language.codes.lines import SYN001
from mudline.language.codes.references import REF001, REF005, REF006, REF007, REF008
from mudline.language.deck.parameters import folded
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import Problem, Severity, Span, Where
from mudline.language.keywords.model import Part
from mudline.language.keywords.naming import names_given
from mudline.language.keywords.values import Names
from mudline.language.syntax.edits import TextEdit
from mudline.model.scene.force_curves import SceneCurve
from mudline.model.scene.names import CURVES, THINGS, names_of, undefined
from mudline.model.scene.references import used_names
from mudline.model.scene.rules.laws import REF002, undefined_curve
from mudline.model.scene.rules.names import REF019
from mudline.model.scene.sets import ALL, set_key


def corrections(context: LintContext) -> Iterator[Correction]:
    """The corrections of a deck, of which no trial is needed."""
    text, scene = context.text, context.scene
    if text is None:
        return
    sets = {key: one.name for key, one in scene.set_table.named.items() if key != ALL}
    curves = {folded(one.name): one.name for one in scene.laws.curves if one.named and not one.embedment}
    used = {where for where, _ in used_names(context.deck, Names.CURVE)}
    nameless = [one for one in undefined_curve(scene) if one.where in used]
    lacking = [one for one in scene.noticed if one.lacks and one.code in (REF001, REF008)]
    effort = Effort()
    yield from _names(context, lacking, sets, (Names.SET, Names.SUBSET), effort)
    yield from _names(context, nameless, curves, (Names.CURVE,), effort)
    for kinds, code in ((CURVES, REF002), (THINGS, REF019)):
        for kind, names in names_of(scene.context, kinds).items():
            known = {key: given[0].name for key, given in names.defined.items()}
            yield from _names(context, [*undefined(scene.context, [kind], code)], known, (kind,), effort)
    yield from _numbers(context, text)
    yield from _given_twice(context, text)
    unlike = [one.lacks for one in nameless if not meant_names(one.lacks, curves, effort)]
    yield from _rows_without_name(context, text, unlike)


def _names(
    context: LintContext, problems: list[Problem], known: dict[str, str], kinds: tuple[Names, ...], effort: Effort
) -> Iterator[Correction]:
    """Names for which one other name alone was meant: it in all their places."""
    alike: dict[str, list[Problem]] = {}
    for problem in problems:
        if problem.weight is Severity.ERROR:
            alike.setdefault(set_key(problem.lacks), []).append(problem)
    text = context.text
    if not alike or text is None:
        return
    places: dict[str, list[Where]] = {}
    for where, name in used_names(context.deck, *kinds):
        places.setdefault(set_key(name), []).append(where)
    for key, found in alike.items():
        near = meant_names(key, known, effort)
        if len(near) != 1:
            continue
        uses = places.get(key, [])
        spans = sorted({span for where in uses if (span := text.span(where))})
        meant = known[near[0]]
        if not spans or any(_own_name(context, where) == near[0] for where in uses):
            continue
        first, *others = sorted(found, key=lambda one: start_of(text, one))
        message = f"{first.message}; {also_in(text, others)}" if others else ""
        edits = tuple(TextEdit(span, meant) for span in spans)
        yield Correction(first, edits, spans[0], message, does=f"write {meant}")


def _own_name(context: LintContext, where: Where) -> str:
    """The folded name of what the record around a place defines, "" where it defines nothing."""
    record = context.scene.context.as_written(where._replace(path=where.path[:2]))
    names = (name for _, name in names_given(record, Names.SET, "defines")) if isinstance(record, Part) else ()
    return set_key(next(iter(names), ""))


def _numbers(context: LintContext, text: TextOrigin) -> Iterator[Correction]:
    """Numbers of nodes and elements that cannot be read, and may be one alone of those that are not defined."""
    for where, given in context.scene.context.excused.items():
        span = text.span(where)
        cause = next((one for one in context.deck.problems if span and one.span == span), None)
        if span is not None and cause is not None and len(given) == 1:
            number = str(min(given))
            message = f"{cause.message} (did you mean {number}?)"
            yield Correction(cause, (TextEdit(span, number),), span, message, does=f"write {number}")


def _given_twice(context: LintContext, text: TextOrigin) -> Iterator[Correction]:
    """Numbers that are given twice, where the rows beside one say that it was to be one that is not defined."""
    noticed = context.scene.noticed
    lacking = {one.lacks for one in noticed if one.lacks and one.code in (REF005, REF006)}
    for problem in noticed if lacking else ():
        at = start_of(text, problem)
        if problem.code is not REF007 or at < 0:
            continue
        line = line_at(text, at)
        unified = text.source.unified
        places = (
            line,
            line_at(text, max(line.start - 1, 0)),
            line_at(text, min(behind(text, line), len(unified))),
        )
        own, above, below = (ROW_NUMBER.match(unified, *place) for place in places)
        meant = {str(int(row[1]) + step) for row, step in ((above, 1), (below, -1)) if row} & lacking
        if own and len(meant) == 1:
            number, span = meant.pop(), Span(*own.span(1))
            lacking.discard(number)
            message = f"number {own[1]} is given twice, and {number} is not defined: is this one {number}?"
            yield Correction(problem, (TextEdit(span, number),), span, message, does=f"write {number}")


def _rows_without_name(context: LintContext, text: TextOrigin, curves: list[str]) -> Iterator[Correction]:
    """Points that begin again: the line with a curve that nothing defines, or with a set that nothing uses."""
    for curve in context.scene.laws.curves:
        point = _begins_again(curve)
        if not point or (curve.embedment and curve.whole):
            continue
        names = _unused_set(context) if curve.embedment else curves
        span = text.span(curve.point(point)) if names else None
        if span is None:
            continue
        line = f"{'SET' if curve.embedment else 'CURVE'}={names.pop(0)}"
        place = Span(line_at(text, span.start).start, line_at(text, span.start).start)
        message = f"the points begin again here: the line {line} seems to be missing above this one"
        yield Correction(Problem(SYN001, message, span), (TextEdit(place, f" {line}\n"),), span, does=f"write {line}")


def _unused_set(context: LintContext) -> list[str]:
    """The name of the only set that nothing uses."""
    used = {set_key(name) for _, name in used_names(context.deck, Names.SET, Names.SUBSET)}
    named = context.scene.set_table.named
    sets = [one.name for key, one in named.items() if key not in used and one.where is not None]
    return sets if len(sets) == 1 else []


def _begins_again(curve: SceneCurve) -> int:
    """The point of a curve that goes back to its first ratio, where both parts rise; 0 for other curves."""
    ratios = curve.points[:, 0].tolist()
    back = [at for at in range(1, len(ratios)) if ratios[at] <= ratios[at - 1]]
    again = len(back) == 1 and ratios[back[0]] == ratios[0] and min(back[0], len(ratios) - back[0]) > 1
    return back[0] if again else 0
