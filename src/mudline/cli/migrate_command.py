"""Command `mudline migrate`."""

from __future__ import annotations

from pathlib import Path

import click

from mudline.api import Deck
from mudline.basics.limits import SHOWN_ROWS
from mudline.basics.short_repr import counted
from mudline.cli import DONE, FOUND, WRONG_USAGE, options
from mudline.cli.changes import print_changes
from mudline.cli.inputs import GivenDecks, Input, Inputs, reading_named_files, require_text, takes_decks
from mudline.cli.streams import emit_deck, notify, notify_diagnostics, write_bytes
from mudline.cli.view import View
from mudline.commands import migrated
from mudline.editing.migration.migrating import Verification, legacy_blocks
from mudline.editing.migration.refusals import Continuations
from mudline.language.deck.loading import load_bytes
from mudline.language.diagnostics import DeckError


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
def command(
    *,
    decks: GivenDecks,
    output: str | None,
    diff: bool,
    proved: bool,
    view: View,
) -> int:
    """Rewrite *EMBEDMENT, *ELASTIC SURFACE and *RIGID SURFACE in the new family of seabed keywords.

    PATHS are decks, directories, or - for standard input, whose new text is printed. Comments stay, as does every byte
    outside the legacy blocks. A deck that the new family cannot express is left unchanged, with the reason.
    """
    inputs = decks.collect()
    if output is not None and len(inputs.files) > 1:
        raise click.UsageError("-o takes one deck; without it decks are rewritten in place")
    code = DONE
    continuations = Continuations(Path(file.path) for file in inputs.files if file.path is not None)
    for file, data in inputs.contents():
        try:
            run = _DeckMigration(inputs, file, data, output, view)
            code = max(code, run.migrate(decks.units, continuations, diff=diff, proved=proved))
        except DeckError as error:
            notify_diagnostics(error.diagnostics)
            code = FOUND
    return max(inputs.code, code)


class _DeckMigration:
    """One deck of a run, and the file to which it is written; `target` None is standard output."""

    def __init__(self, inputs: Inputs, file: Input, data: bytes, output: str | None, view: View) -> None:
        self.inputs, self.file, self.data, self.view = inputs, file, data, view
        given = file.path if output is None else output
        self.target = None if given is None else Path(given)

    def migrate(self, units: str | None, continuations: Continuations, *, diff: bool, proved: bool) -> int:
        """Migrate the deck and return the exit code. Raises DeckError for a deck that is left unchanged."""
        read = load_bytes(self.data, self.file.name, units=units, folder=self.file.folder)
        reading_named_files(read)
        deck = Deck(**vars(require_text(read)))
        path = Path(self.file.path) if self.file.path and legacy_blocks(deck) else None
        beside = (continuations.of(path), continuations.extend(path)) if path else ([], False)
        result = migrated(deck, beside, verify=proved)
        if not result.replaced:
            self._note("no legacy seabed keyword")
            return DONE if diff or self._in_place else self._write(self.data, {})
        if result.verified and not self._proved(result.verified):
            return FOUND
        content = result.content_as(self.file.name if self.target is None else self.target.name)
        if diff:
            print_changes(self.data, content, self.file.name, self.view)
            for name, data in result.files.items():
                print_changes(b"", data, Path(self.file.name).with_name(name).as_posix(), self.view, created=True)
            return DONE
        replaced = ", ".join(f"{count} *{keyword}" for keyword, count in result.replaced.items())
        return self._write(content, result.files, replaced)

    @property
    def _in_place(self) -> bool:
        return self.target is not None and self.target == Path(self.file.path or "")

    def _proved(self, verdict: Verification) -> bool:
        for difference in verdict.differences[:SHOWN_ROWS]:
            notify(f"{self.file.name}: {difference.what}: {difference.text}")
        if verdict.differences:
            count = counted(len(verdict.differences), "difference")
            notify(f"{self.file.name}: left unchanged: {count} between the old deck and the new one")
        else:
            given = verdict.representatives
            more = f", and {given} representative elements for its sets" if given else ""
            self._note(
                f"verified: {counted(verdict.elements, 'element')} of {counted(verdict.kinds, 'kind')}{more}, at "
                f"{verdict.positions} positions: forces, stiffnesses, friction, lateral resistance, suction and seabed "
                "are bitwise equal"
            )
        return not verdict.differences

    def _write(self, content: bytes, files: dict[str, bytes], replaced: str = "") -> int:
        if self.target is None:
            if files:
                why = "its profile needs a file of its own, and standard input has no folder"
                notify(f"{self.file.name}: left unchanged: {why}: give the deck as a file")
                return FOUND
            emit_deck(content)
            return DONE
        for name, data in files.items():
            write_bytes(self.target.with_name(name), data)
        if not self._in_place:
            write_bytes(self.target, content)
        elif not self.inputs.replaced(self.file, self.data, content):
            for name in files:
                self.target.with_name(name).unlink(missing_ok=True)
            return WRONG_USAGE
        if replaced:
            beside = "".join(f", {self.target.with_name(name).as_posix()}" for name in files)
            self._note(f"{replaced} -> {self.target.as_posix()}{beside}")
        return DONE

    def _note(self, text: str) -> None:
        if not self.view.quiet:
            notify(f"{self.file.name}: {text}")
