"""Command `mudline migrate`."""

from __future__ import annotations

from pathlib import Path

import click

from mudline.api import Deck
from mudline.api.commands import Migrated, migrated
from mudline.basics.limits import SHOWN_ROWS
from mudline.basics.short_repr import counted
from mudline.cli import DONE, FOUND, WRONG_USAGE, options
from mudline.cli.changes import print_changes
from mudline.cli.inputs import GivenDecks, Input, Inputs, each_deck, reading_named_files, require_text, takes_decks
from mudline.cli.streams import emit_deck, notify, write_bytes
from mudline.cli.view import View
from mudline.editing.migration.migrating import Verification
from mudline.editing.migration.refusals import Continuations
from mudline.language.deck.loading import load_bytes


@options.command("migrate")
@options.output(type=options.OUTPUT_TEXT, help="Write to this file instead of the deck itself; for one deck only.")
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

    code = DONE
    for file, data, made in each_deck(inputs, work, view):
        given = file.path if output is None else output
        path = Path(given) if given else None
        code = max(code, FOUND if made is None else _deliver(inputs, file, data, *made, path, view=view, diff=diff))
    return max(inputs.code, code)


def _deliver(
    inputs: Inputs, file: Input, old: bytes, result: Migrated, new: bytes, path: Path | None, *, view: View, diff: bool
) -> int:
    """Print a migrated deck, or write it to a file, None for standard output; return the exit code."""
    in_place = path is not None and path == Path(file.path or "")
    if not result.replaced:
        view.note(f"{file.name}: no legacy seabed keyword")
        if diff or in_place:
            return DONE
    elif result.verified and not _proved(file.name, result.verified, view):
        return FOUND
    if diff:
        print_changes(old, new, file.name, view)
        for name, data in result.files.items():
            print_changes(b"", data, Path(file.name).with_name(name).as_posix(), view, created=True)
        return DONE
    if path is None:
        if result.files:
            stream, advice = ("input", "give the deck as a file") if file.path is None else ("output", "leave -o out")
            why = f"its profile needs a file of its own, and standard {stream} has no folder"
            notify(f"{file.name}: left unchanged: {why}: {advice}")
            return FOUND
        emit_deck(new)
        return DONE
    beside = {path.with_name(name): data for name, data in result.files.items()}
    for each, data in beside.items():
        write_bytes(each, data)
    if not in_place:
        write_bytes(path, new)
    elif not inputs.replaced(file, old, new):
        for each in beside:
            each.unlink(missing_ok=True)
        return WRONG_USAGE
    if result.replaced:
        replaced = ", ".join(f"{count} *{keyword}" for keyword, count in result.replaced.items())
        view.note(f"{file.name}: {replaced} -> {', '.join(each.as_posix() for each in (path, *beside))}")
    return DONE


def _proved(name: str, verdict: Verification, view: View) -> bool:
    """Report the verification of a deck; return True if old and new deck agree."""
    for difference in verdict.differences[:SHOWN_ROWS]:
        notify(f"{name}: {difference.what}: {difference.text}")
    if verdict.differences:
        count = counted(len(verdict.differences), "difference")
        notify(f"{name}: left unchanged: {count} between the old deck and the new one")
    else:
        given = verdict.representatives
        more = f", and {given} representative elements for its sets" if given else ""
        view.note(
            f"{name}: verified: {counted(verdict.elements, 'element')} of "
            f"{counted(verdict.kinds, 'kind')}{more}, at {verdict.positions} positions: forces, stiffnesses, "
            "friction, lateral resistance, suction and seabed are bitwise equal"
        )
    return not verdict.differences
