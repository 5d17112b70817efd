"""`mudline convert`."""

from __future__ import annotations

import sys
from pathlib import Path

import click

from mudline.cli import options
from mudline.cli.exits import DONE
from mudline.cli.guard import refuses_bad_decks
from mudline.cli.inputs import load
from mudline.cli.options import View
from mudline.cli.terminal import tell
from mudline.cli.writing import write
from mudline.deck.loading import FORMS, dump, form_of
from mudline.deck.sorting import sort_curves


@click.command("convert")
@options.deck
@click.option("-o", "--output", metavar="OUT", help="File to write; without it, or with -, standard output.")
@click.option("--from", "source", type=click.Choice(FORMS), help="Form of DECK, instead of what its suffix tells.")
@click.option(
    "--to", "target", type=click.Choice(FORMS), help="Form to write, instead of what the suffix of OUT tells."
)
@click.option("--sorted", "in_order", is_flag=True, help="Write curves with their points sorted by ratio.")
@options.units
@options.common
@refuses_bad_decks
def command(
    *,
    deck: str,
    output: str | None,
    source: str | None,
    target: str | None,
    in_order: bool,
    units: str | None,
    view: View,
) -> int:
    """Convert a deck between keyword text, JSON and YAML.

    Nothing is lost but blank lines and the spelling of numbers.
    """
    to_file = output is not None and output != "-"
    if not to_file and target is None:
        raise click.UsageError("say what to write: -o OUT with a suffix, or --to")
    read = load(deck, form=source, units=units).require()
    if in_order:
        for name in sort_curves(read):
            tell(f"curve {name} keeps its order: a ratio in it is an equation")
    text = dump(read, target or form_of(output or ""))
    if not to_file:
        sys.stdout.write(text)
        return DONE
    path = Path(output or "")
    write(path, text.encode("utf-8"))
    if not view.quiet:
        tell(f"{read.file} -> {path.as_posix()}")
    return DONE
