"""Force-embedment curves as they are written: their names, the places that use them, repairs of their lines."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterable, Iterator
from itertools import chain, groupby
from typing import NamedTuple

import numpy as np

from mudline.basics.limits import MOST_REPORTED
from mudline.checks.context import Found, Joined, LintContext, joint
from mudline.checks.suppression import MARK
from mudline.language.codes.contact import REF003, REF004, SBD006, SBD017
from mudline.language.deck.parameters import folded
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import Problem, Repair, Severity, Span, Where
from mudline.language.keywords.reader import all_keys
from mudline.language.keywords.text import shown
from mudline.language.rules import rule
from mudline.language.syntax.rows import line_spans, row_fields
from mudline.language.syntax.tree import Leaf, LeafKind, is_data
from mudline.model.contact.input import LawKind
from mudline.model.scene.curves import SceneCurve
from mudline.model.scene.laws_in_use import idle_curves, named_as_numbers, repeated_curves
from mudline.model.scene.numbering import Indices
from mudline.model.scene.references import CURVES, repeated, unused


@rule(REF003)
def unused_curve(context: LintContext) -> Iterator[Problem]:
    """A curve is not used by STIFFNESS=, or by another setting that takes curves of its kind.

    It was measured or calculated for something, so perhaps the elements that it was meant for follow another law. Name
    it in a STIFFNESS= of *SEABED PROPERTIES, or remove it. Another estimate of a soil in use, such as Clay Low next to
    Clay Best, is an info: decks carry all estimates. Nothing is reported in a deck whose STIFFNESS= is an equation, as
    its parameters choose the curve, or for a curve whose name reads as a number (SBD017). The curves of
    *MOMENT-CURVATURE and the like are checked too: an info if mudline knows no keyword that would use the curve.

    Example on clay:
          0.5, 4200.0
        - CURVE=Backfill
        - 0.0, 0.0
        - 0.1, 300.0

    Finds: 7:8
    """
    yield from unused(context.scene.context, CURVES, REF003)
    scene = context.scene
    idle = idle_curves(scene)
    if not idle:
        return
    places = [curve.where for curves in idle.values() for curve in curves]
    repairs = removals(context.text, places) if context.text and _all_else_is_given(context) else {}
    soils = {_without_estimate(name) for name in scene.referenced}
    for curve, *_ in idle.values():
        message = f"curve {shown(curve.name)} is not used: name it in a STIFFNESS=, or remove it"
        soil = _without_estimate(curve.name)
        severity = Severity.INFO if soil != folded(curve.name) and soil in soils else None
        yield Problem(REF003, message, None, severity, curve.title, repairs.get(curve.where))


@joint(SBD006)
def the_law_of_a_curve(_: LintContext, found: Found) -> Iterator[Joined]:
    """Join the only unused curve to the only law without a stiffness."""
    bare, idle = found["SBD006"], found.get("REF003", ())
    if len(bare) == len(idle) == 1:
        yield Joined(bare[0], idle, idle[0].message)


_ESTIMATE = re.compile(
    r"[\W_]*(?<![^\W_])(?:lb|le|be|ub|hb|he|low|lower|best|high|higher|upper|mean|min|max|p\d\d?)(?:[\W_]+(?:estimate|bound))?(?![^\W_])"
)
"""Words of a curve name that tell the estimate, such as `low` or `best`."""


def _without_estimate(name: str) -> str:
    """Return the name of a curve without the words that tell the estimate of its soil."""
    return _ESTIMATE.sub("", folded(name)).strip(" -_.")


def _all_else_is_given(context: LintContext) -> bool:
    """Return True if the deck has no error, and no law without stiffness, in whose place the curve may be meant."""
    if any(law.kind is LawKind.NONE for law in context.scene.laws.set_laws):
        return False
    return not any(each.weight is Severity.ERROR for problems in context.noticed.values() for each in problems)


@rule(REF004)
def duplicate_curve(context: LintContext) -> Iterator[Problem]:
    """Two curves have one name, or one set has two curves in *EMBEDMENT.

    The later one is used (inferred: the language does not say what happens) and overrides the earlier one. Names are
    case-insensitive. Choose another name, or remove one of the curves.

    Example on clay:
          0.5, 4200.0
        - CURVE=CLAY
        - 0.0, 0.0
        - 0.1, 2500.0

    Finds: 7:8
    """
    yield from repeated_curves(context.scene)
    yield from repeated(context.scene.context, CURVES, REF004)


def removals(text: TextOrigin, unused: Iterable[Where]) -> dict[Where, Repair]:
    """Return a repair for each unused curve of `*SEABED STIFFNESS` that removes its lines and keeps comments.

    If no curve of a block is used, the repair of its first curve removes the whole block. If a comment in the block
    suppresses findings, each curve is removed by itself.
    """
    repairs: dict[Where, Repair] = {}
    for block, places in groupby(sorted(unused), lambda where: where._replace(path=())):
        if (block.section, block.block) in text.read:  # not of a deck that this one continues
            repairs |= _of_block(text, block, list(places))
    return repairs


def _of_block(text: TextOrigin, block: Where, unused: list[Where]) -> dict[Where, Repair]:
    read = text.read[block.section, block.block]
    raw = text.tree.sections[block.section].blocks[block.block]
    source = text.source.unified
    length = len(unused[0].path)
    starts = {path: span.start for path, span in read.places.spans.items() if len(path) == length}
    lines = _by_curve(raw.leaves, source, all_keys(type(read.model)), sorted(starts.values()))
    repairs = {
        where: Repair("unsafe", "remove the curve", tuple((span, "") for span in lines[starts[where.path]]))
        for where in unused
    }
    comments = (leaf for leaf in raw.leaves if leaf.kind is LeafKind.COMMENT)
    hides = any(MARK.match(source, *leaf.span) for leaf in comments)
    if len(unused) == len(starts) and (len(starts) == 1 or not hides):
        spans = [raw.head.span, *(span for start in sorted(lines) for span in lines[start])]
        message = "remove the curve" if len(starts) == 1 else "remove the curves of this block"
        repairs[unused[0]] = Repair("unsafe", message, tuple((span, "") for span in spans))
    return repairs


def _by_curve(leaves: list[Leaf], source: str, keys: frozenset[str], starts: list[int]) -> dict[int, list[Span]]:
    """Return the lines of each curve by its start, without comments and blank lines."""
    lines: dict[int, list[Span]] = {start: [] for start in starts}
    for leaf in leaves:
        at = bisect_right(starts, leaf.span.end - 1) - 1
        if at >= 0 and is_data(source, leaf, keys):
            lines[starts[at]].append(leaf.span)
    return lines


@rule(SBD017)
def curve_named_as_number(context: LintContext) -> Iterator[Problem]:
    """The name of a curve reads as a number.

    STIFFNESS= takes a number or the name of a curve, and a number comes first: the elements get a linear stiffness of
    that value, and the curve is never used. Give the curve a name that begins with a letter.

    Example on clay:
        - CURVE=100
        + CURVE=Clay

        - STIFFNESS=100
        + STIFFNESS=Clay

    Finds: 3:8
    """
    return named_as_numbers(context.scene)


# ------------------------------------------------------------------------------------------------------ rows of points


_NO_PLAIN_NUMBERS = frozenset('["{')


def _exchange(text: TextOrigin, curve: SceneCurve) -> Repair | None:
    """Return a repair that exchanges the fields of each row; None for a curve not read whole, or very long."""
    lines = _point_lines(text, curve)
    if not lines or not curve.whole:
        return None
    source = text.source.unified
    edits: list[tuple[Span, str]] = []
    for line in lines:
        first, second = (field.span for field in row_fields(source, line, 2))
        turned = source[slice(*second)] + source[first.end : second.start] + source[slice(*first)]
        edits.append((Span(first.start, second.end), turned))
    return Repair("unsafe", "exchange the columns", tuple(edits))


class CurveRows(NamedTuple):
    """Lines of a table, without white space and line ends after them; `before` is the text of the curve above them."""

    source: str
    lines: list[Span]
    before: str

    def crosses_comment(self, order: Indices) -> bool:
        """Return True if a comment is next to a row that the new order moves, or that other rows pass."""
        settled = np.maximum.accumulate(order) == np.arange(len(order))  # up to here the rows stay among themselves
        stays = order == np.arange(len(order))
        if "mudline" in self.before.lower() and not stays[0]:  # a comment that speaks of the first row alone
            return True
        for place in range(len(order) - 1):
            between = self.source[self.lines[place].end : self.lines[place + 1].start]
            if between.strip() and not (settled[place] and stays[place] and stays[place + 1]):
                return True
        return False


def _point_lines(text: TextOrigin, curve: SceneCurve) -> list[Span]:
    """Return the lines with the points of a curve; none if there are very many, or the deck only continues its deck."""
    block = text.read.get((curve.where.section, curve.where.block))
    if block is None or len(curve.points) > MOST_REPORTED:
        return []
    runs = block.places.runs.get((*curve.where.path, "points"), [])
    return [*chain.from_iterable(line_spans(text.source.unified, run) for _, run in runs)]


def plain_rows(text: TextOrigin, curve: SceneCurve) -> CurveRows | None:
    """Return the rows of a curve; None if there are very many, or equations, whose parameters may change."""
    source = text.source.unified
    lines = [Span(line.start, line.start + len(source[slice(*line)].rstrip())) for line in _point_lines(text, curve)]
    if not lines or any(not _NO_PLAIN_NUMBERS.isdisjoint(source[slice(*line)]) for line in lines):
        return None
    places = text.read[curve.where.section, curve.where.block].places
    opening = places.find(curve.where.path).start
    if opening >= lines[0].start:  # rows of *EMBEDMENT that stand under no SET=
        opening = places.block.start
    return CurveRows(source, lines, source[opening : lines[0].start])


def sorting(text: TextOrigin, curve: SceneCurve) -> Repair | None:
    """Return a repair that sorts the rows by their ratios.

    None for a curve that is not read whole, is very long or has equations, or if a comment would then be next to
    another row.
    """
    if not curve.whole or (rows := plain_rows(text, curve)) is None or len(rows.lines) != len(curve.points):
        return None
    order = np.argsort(curve.points[:, 0], kind="stable")
    if rows.crosses_comment(order):
        return None
    edits = [
        (rows.lines[place], rows.source[slice(*rows.lines[row])])
        for place, row in enumerate(order.tolist())
        if place != row
    ]
    return Repair("safe", "put the points in order", tuple(edits)) if edits else None


def removal(rows: CurveRows, row: int) -> Repair:
    """Return a repair that removes a row."""
    line = rows.lines[row]
    following = rows.source.find("\n", line.end)
    end = len(rows.source) if following < 0 else following + 1
    return Repair("safe", "remove the point", ((Span(line.start, end), ""),))
