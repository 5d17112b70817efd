"""Command `mudline migrate`."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import click

from mudline.api import Deck
from mudline.basics.limits import SHOWN_ROWS
from mudline.basics.short_repr import counted
from mudline.cli import DONE, FOUND, WRONG_USAGE, options
from mudline.cli.changes import print_changes
from mudline.cli.inputs import GivenDecks, Input, Inputs, reading_named_files, require_text, takes_decks
from mudline.cli.many_files import each_deck
from mudline.cli.streams import emit_deck, notify, write_bytes
from mudline.cli.view import Progress, View
from mudline.commands import Migrated, migrated
from mudline.editing.migration.migrating import Verification
from mudline.editing.migration.refusals import Continuations
from mudline.language.deck.loading import load_bytes


@options.command("migrate")
@options.option(
    "-o",
    "--output",
    type=options.OUTPUT_FILE,
    metavar="OUT",
    help="Write to this file instead of the deck itself; for one deck only.",
)
@options.flag("--diff", help="Print what would change, and write nothing.")
@options.flag(
    "--verify",
    "proved",
    help="First evaluate the old and the new deck, and write only if all their laws agree bitwise.",
)
@takes_decks()
def command(*, decks: GivenDecks, output: str | None, diff: bool, proved: bool, view: View) -> int:
    """Rewrite *EMBEDMENT, *ELASTIC SURFACE and *RIGID SURFACE in the new family of seabed keywords.

    PATHS are decks, directories, or - for standard input, whose new text is printed. Comments stay, as does every byte
    outside the legacy blocks. A deck that the new family cannot express is left unchanged, with the reason.
    """
    inputs = decks.collect()
    if output is not None and len(inputs.files) > 1:
        raise click.UsageError("-o takes one deck; without it decks are rewritten in place")
    among = Continuations(Path(file.path) for file in inputs.files if file.path is not None)

    def work(file: Input, data: bytes) -> tuple[Migrated, bytes]:
        read = load_bytes(data, file.name, units=decks.units, folder=file.folder)
        reading_named_files(read)
        result = migrated(Deck(**vars(require_text(read))), verify=proved, among=among)
        return result, result.content_as(output or file.name) if result.replaced else data

    code, progress = DONE, Progress(len(inputs.files), view)
    for file, data, made in each_deck(inputs, work, progress):
        progress.hide()
        given = file.path if output is None else output
        target = _Target(inputs, file, data, None if given is None else Path(given), view)
        code = max(code, FOUND if made is None else target.take(*made, diff=diff))
    return max(inputs.code, code)


class _Target(NamedTuple):
    """A deck of a run, and the file to which it is written; `path` None is standard output."""

    inputs: Inputs
    file: Input
    data: bytes
    path: Path | None
    view: View

    def take(self, result: Migrated, content: bytes, *, diff: bool) -> int:
        """Print or write the result, and return the exit code."""
        in_place = self.path is not None and self.path == Path(self.file.path or "")
        if not result.replaced:
            self.view.note(f"{self.file.name}: no legacy seabed keyword")
            if diff or in_place:
                return DONE
        elif result.verified and not self._proved(result.verified):
            return FOUND
        if diff:
            print_changes(self.data, content, self.file.name, self.view)
            for name, data in result.files.items():
                print_changes(b"", data, Path(self.file.name).with_name(name).as_posix(), self.view, created=True)
            return DONE
        if self.path is None:
            if result.files:
                why = "its profile needs a file of its own, and standard input has no folder"
                notify(f"{self.file.name}: left unchanged: {why}: give the deck as a file")
                return FOUND
            emit_deck(content)
            return DONE
        beside = {self.path.with_name(name): data for name, data in result.files.items()}
        for path, data in beside.items():
            write_bytes(path, data)
        if not in_place:
            write_bytes(self.path, content)
        elif not self.inputs.replaced(self.file, self.data, content):
            for path in beside:
                path.unlink(missing_ok=True)
            return WRONG_USAGE
        if result.replaced:
            replaced = ", ".join(f"{count} *{keyword}" for keyword, count in result.replaced.items())
            self.view.note(
                f"{self.file.name}: {replaced} -> {', '.join(path.as_posix() for path in (self.path, *beside))}"
            )
        return DONE

    def _proved(self, verdict: Verification) -> bool:
        for difference in verdict.differences[:SHOWN_ROWS]:
            notify(f"{self.file.name}: {difference.what}: {difference.text}")
        if verdict.differences:
            count = counted(len(verdict.differences), "difference")
            notify(f"{self.file.name}: left unchanged: {count} between the old deck and the new one")
        else:
            given = verdict.representatives
            more = f", and {given} representative elements for its sets" if given else ""
            self.view.note(
                f"{self.file.name}: verified: {counted(verdict.elements, 'element')} of "
                f"{counted(verdict.kinds, 'kind')}{more}, at {verdict.positions} positions: forces, stiffnesses, "
                "friction, lateral resistance, suction and seabed are bitwise equal"
            )
        return not verdict.differences
