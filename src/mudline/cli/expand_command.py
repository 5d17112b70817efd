"""Command `mudline expand`."""

from __future__ import annotations

from pathlib import Path

import click

from mudline.basics.display import DisplayTable, text
from mudline.basics.short_repr import counted
from mudline.checks.engine import readable
from mudline.cli import DONE, options
from mudline.cli.inputs import GivenDeck, takes_deck
from mudline.cli.streams import emit_json, make_folder, notify, notify_some, write_bytes
from mudline.cli.view import View
from mudline.editing.variations.files import MANIFEST, conflicts, lacking, manifest
from mudline.editing.variations.planning import plan

_COLUMNS = (
    text("file", "path"),
    text("case", "description"),
    text("values", lambda deck: ", ".join(f"{name}={value}" for name, value in deck.values.items())),
)
_NOT_COPIED = "{}: this file, which the deck names, is not copied: put it next to the new decks"
_MORE = "and {} more of the same"


@options.command("expand")
@options.option(
    "-o", "--output", metavar="DIR", help="Write the new decks into this folder; it is created if it does not exist."
)
@options.flag("--dry-run", help="Print what would be written, and write nothing.")
@options.flag("--force", help="Overwrite existing files.")
@options.output_format("text", "json")
@takes_deck
def command(*, deck: GivenDeck, output: str | None, dry_run: bool, force: bool, output_format: str, view: View) -> int:
    """Write the decks that *VARIATION and *COMBINATIONS describe.

    Each new deck is the text of DECK with other values of its parameters and without the two keywords. All names are
    checked before the first file is written, and no file lies outside the folder. Its manifest.json lists the decks.
    """
    if output is None and not dry_run:
        raise click.UsageError("no folder to write to: give -o DIR, or --dry-run")
    planned = plan(readable(deck.load()))
    for note in planned.notes:
        notify(note)
    notify_some([] if output is None else [_NOT_COPIED.format(name) for name in lacking(Path(output), planned)], _MORE)
    blocked = [] if output is None else conflicts(Path(output), planned, force=force)
    notify_some(blocked, _MORE)
    if output is not None and not dry_run:
        if blocked:
            raise click.ClickException("nothing is written")
        folder = Path(output)
        for each in planned.decks:
            path = folder / each.path
            make_folder(path.parent)
            write_bytes(path, planned.content(each))
            if view.verbose:
                notify(path.as_posix())
        make_folder(folder)
        emit_json(manifest(planned.source, planned.decks), str(folder / MANIFEST))
        view.note(f"{planned.source}: {counted(len(planned.decks), 'deck')} -> {folder.as_posix()}")
    if output_format == "json":
        emit_json(manifest(planned.source, planned.decks))
    elif dry_run:
        printer = view.printer()
        printer.table(DisplayTable("Decks", _COLUMNS, planned.decks))
        printer.line(counted(len(planned.decks), "deck"))
    return DONE
