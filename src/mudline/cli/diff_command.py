"""`mudline diff`."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from itertools import groupby

import click
import numpy as np

from mudline.cli import DONE, FOUND, options
from mudline.cli.inputs import STDIN, GivenDeck, refuses_bad_decks
from mudline.cli.streams import emit
from mudline.cli.view import View
from mudline.comparison.comparing import compare
from mudline.comparison.model import Difference, Value, spans_of, text_of
from mudline.comparison.superseded import Comparison, without_spelling
from mudline.linting.output import visible
from mudline.scene.model import resolve
from mudline.short_repr import counted

FORMAT = "mudline-diff/1"
MOST = 20
"""Lines of a group; the rest is counted, unless all are asked for."""

_NUMBERED = ("nodes", "elements")
_FEW = 4
_MARKS = {"added": ("+", "green"), "removed": ("-", "red"), "changed": ("~", "yellow")}


@click.command("diff")
@click.argument("before", metavar="A")
@click.argument("after", metavar="B")
@click.option(
    "--tolerance",
    type=click.FloatRange(min=0, max=1),
    default=0.0,
    show_default=True,
    metavar="REL",
    help="Largest difference of equal numbers, relative to the larger one.",
)
@click.option("--strict", is_flag=True, help="List differences of spelling in superseded keywords too: exit code 1.")
@options.output_format("text", "json")
@options.stdin_name
@options.units
@options.common
@refuses_bad_decks
def command(
    *,
    before: str,
    after: str,
    tolerance: float,
    strict: bool,
    output_format: str,
    stdin_name: str,
    units: str | None,
    view: View,
) -> int:
    """Compare two decks semantically, whatever their formats, layout and order.

    A and B are decks in keyword text, JSON or YAML; one of them may be - for standard input. The exit code is 0 when
    they mean the same, as a deck and its migrated form do, and 1 when they differ or one of them cannot be read.
    """
    if before == after == STDIN:
        raise click.UsageError("only one of the decks can come from standard input")
    if not math.isfinite(tolerance):
        raise click.UsageError("--tolerance: expected a number from 0 to 1")
    first, second = (resolve(GivenDeck(given, stdin_name, units).load()) for given in (before, after))
    comparison = Comparison(compare(first, second, tolerance), [])
    if not strict:
        comparison = without_spelling(first, second, comparison.differences, tolerance)
    if output_format == "json":
        emit(_json(first.deck.file, second.deck.file, tolerance, comparison))
    else:
        view.printer().lines(_lines(first.deck.file, second.deck.file, comparison, view))
    return FOUND if comparison.differences else DONE


def _json(before: str, after: str, tolerance: float, comparison: Comparison) -> list[str]:
    """A difference on a line."""
    found = comparison.differences
    head = {
        "format": FORMAT,
        "before": before,
        "after": after,
        "tolerance": tolerance,
        "equivalent": not found,
        "spelling_differences": len(comparison.spelling),
    }
    start = json.dumps(head, indent=1, ensure_ascii=False).removesuffix("\n}")
    lines = (json.dumps(asdict(one), ensure_ascii=False, allow_nan=False) for one in found)
    body = "".join(f"{',' if i else ''}\n  {line}" for i, line in enumerate(lines))
    return [start, ',\n "differences": [', body, "\n ]\n}\n" if found else "]\n}\n"]


def _lines(before: str, after: str, comparison: Comparison, view: View) -> Iterator[str | tuple[str, str]]:
    """The differences by group, then how many there are: lines, with their styles if they have any."""
    found = comparison.differences
    if found and not view.quiet:
        yield visible(f"--- {before}"), "bold"
        yield visible(f"+++ {after}"), "bold"
    for group, members in groupby(found, key=lambda one: one.group):
        differences = list(members)
        yield visible(group), "cyan"
        if group in _NUMBERED and not view.verbose:
            runs, differences = _runs(group, differences)
            yield from runs
        most = len(differences) if view.verbose else MOST
        for one in differences[:most]:
            mark, style = _MARKS[one.kind]
            yield f"  {mark} {visible(_described(one))}", style
        if len(differences) > most:
            yield f"  and {len(differences) - most} more (-v shows all)"
    if not view.quiet:
        yield _summary(comparison)


def _summary(comparison: Comparison) -> str:
    """How many differences there are, and how many of spelling."""
    found, spelling = (len(part) for part in comparison)
    if not spelling:
        return counted(found, "difference") if found else "no difference"
    beside = f"{counted(spelling, 'difference')} of spelling in superseded keywords"
    return f"{counted(found, 'difference')}, and {beside} (--strict lists them)" if found else f"equivalent: {beside}"


def _runs(group: str, differences: Sequence[Difference]) -> tuple[list[tuple[str, str]], list[Difference]]:
    """Nodes or elements that only one deck has, as ranges of numbers where they are many; and the other differences."""
    lines: list[tuple[str, str]] = []
    left = list(differences)
    for kind in ("removed", "added"):
        numbers = [number for one in differences if one.kind == kind and (number := _number(one)) is not None]
        if len(numbers) >= _FEW:
            mark, style = _MARKS[kind]
            ranges = text_of(spans_of(np.array(numbers, dtype=np.int64)))
            lines.append((f"  {mark} {ranges}: {len(numbers)} {group}", style))
            left = [one for one in left if one.kind != kind or _number(one) is None]
    return lines, left


def _number(one: Difference) -> int | None:
    """The number of a node or an element; None for one with a label."""
    last = one.where.rpartition("/")[2]
    return int(last) if last.lstrip("-").isdecimal() else None


def _described(one: Difference) -> str:
    path = one.where.removeprefix(f"{one.group}/")
    if one.kind == "changed":
        values = f": {_value(one.before)} -> {_value(one.after)}"
    else:
        value = one.after if one.kind == "added" else one.before
        values = "" if value is None else f": {_value(value)}"
    return path + values + _places(one)


def _places(one: Difference) -> str:
    lines = [f"{side}{line}" for side, line in (("-", one.before_line), ("+", one.after_line)) if line is not None]
    return f"  (line {' '.join(lines)})" if lines else ""


def _value(value: Value) -> str:
    if isinstance(value, list):
        return "(" + ", ".join(map(_value, value)) + ")"
    if value is None:
        return "none"
    return repr(value) if isinstance(value, float) else str(value)
