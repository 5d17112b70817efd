"""`mudline show`."""

from __future__ import annotations

import json
from collections import Counter

import click

from mudline.cli import options
from mudline.cli.exits import DONE, FOUND
from mudline.cli.guard import refuses_bad_decks
from mudline.cli.inputs import load
from mudline.cli.lazy import printing
from mudline.cli.options import View
from mudline.cli.streams import emit
from mudline.cli.terminal import tell
from mudline.results.summary import summarise
from mudline.scene.model import resolve


@click.command("show")
@options.deck
@options.output_format("text", "json")
@options.stdin_name
@options.units
@options.common
@refuses_bad_decks
def command(*, deck: str, output_format: str, stdin_name: str, units: str | None, view: View) -> int:
    """Summarise a deck: sections, keywords, sets, curves, diameters, laws.

    A deck with errors is shown as far as it can be read; the exit code is then 1.
    """
    scene = resolve(load(deck, units=units, stdin_name=stdin_name))
    summary = summarise(scene)
    errors = scene.errors()
    if output_format == "json":
        emit([json.dumps(summary, indent=1, ensure_ascii=False, allow_nan=False), "\n"])
    else:
        printing("show").print_summary(summary, view)
    if errors:
        counts = Counter(diagnostic.file for diagnostic in scene.deck.diagnose(errors))
        for file, count in counts.items():
            tell(f"{file} has {count} error{'s' * (count != 1)}: see mudline lint")
    return FOUND if errors else DONE
