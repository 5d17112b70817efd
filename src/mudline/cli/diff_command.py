"""`mudline diff`."""

from __future__ import annotations

import json
import math
from dataclasses import asdict

import click

from mudline.cli import options
from mudline.cli.exits import DONE, FOUND
from mudline.cli.guard import refuses_bad_decks
from mudline.cli.inputs import STDIN, load
from mudline.cli.lazy import printing
from mudline.cli.options import View
from mudline.cli.streams import emit
from mudline.comparison.comparing import compare
from mudline.comparison.model import Difference
from mudline.scene.model import resolve

FORMAT = "mudline-diff/1"


@click.command("diff")
@click.argument("before", metavar="A")
@click.argument("after", metavar="B")
@click.option(
    "--tolerance",
    type=click.FloatRange(min=0, max=1),
    default=0.0,
    show_default=True,
    metavar="REL",
    help="How far two numbers may be apart, relative to the larger one.",
)
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
    output_format: str,
    stdin_name: str,
    units: str | None,
    view: View,
) -> int:
    """Tell what differs between the meanings of two decks, whatever their forms, layout and order.

    A and B are decks in keyword text, JSON or YAML; one of them may be - for standard input. The exit code is 0 when
    they mean the same, and 1 when they differ or one of them cannot be read.
    """
    if before == after == STDIN:
        raise click.UsageError("only one of the decks can come from standard input")
    if not math.isfinite(tolerance):
        raise click.UsageError("--tolerance needs a number from 0 to 1")
    first, second = (resolve(load(given, units=units, stdin_name=stdin_name)) for given in (before, after))
    found = compare(first, second, tolerance)
    if output_format == "json":
        emit(_json(first.deck.file, second.deck.file, tolerance, found))
    else:
        printing("diff").print_differences(first.deck.file, second.deck.file, found, view)
    return FOUND if found else DONE


def _json(before: str, after: str, tolerance: float, found: list[Difference]) -> list[str]:
    """A difference on a line."""
    head = {"format": FORMAT, "before": before, "after": after, "tolerance": tolerance}
    start = json.dumps(head, indent=1, ensure_ascii=False).removesuffix("\n}")
    lines = (json.dumps(asdict(one), ensure_ascii=False, allow_nan=False) for one in found)
    body = "".join(f"{',' if i else ''}\n  {line}" for i, line in enumerate(lines))
    return [start, ',\n "differences": [', body, "\n ]\n}\n" if found else "]\n}\n"]
