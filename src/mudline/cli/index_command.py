"""`mudline index`: decks into an archive, in this process or in others."""

from __future__ import annotations

import os
from collections.abc import Sequence
from contextlib import closing
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

import click

from mudline.cli import DONE, WRONG_USAGE, options
from mudline.cli.inputs import Input, Inputs, collect, is_in_any_form
from mudline.cli.lint_run import Settings, checked_settings
from mudline.cli.many_files import many_files
from mudline.cli.streams import counted, notify, notify_missing, reason
from mudline.cli.view import Progress, View
from mudline.linting.configuration import Given

if TYPE_CHECKING:
    from mudline.archive.updating import Order, Update

LIBRARIES = ("duckdb", "pyarrow")
EXTRA = "archive"


def lacks_libraries(command: str) -> bool:
    """Whether a library of the extra is not installed; that is reported."""
    missing = [name for name in LIBRARIES if find_spec(name) is None]
    if missing:
        notify_missing(f"mudline {command}", " and ".join(missing), EXTRA)
    return bool(missing)


@options.command("index")
@options.paths
@click.option("-o", "--output", required=True, metavar="ARCHIVE", help="The folder of the archive; made if missing.")
@click.option("--prune", is_flag=True, help="Also drop decks outside PATHS whose files are no longer there.")
@options.config
@options.isolated
@options.jobs
@options.every_file
@options.units
@options.common
def command(
    *,
    paths: tuple[str, ...],
    output: str,
    prune: bool,
    config: str | None,
    isolated: bool,
    jobs: int,
    every_file: bool,
    units: str | None,
    view: View,
) -> int:
    """Bring decks into an archive, which mudline query answers questions about.

    PATHS are decks, or directories (searched for *.keyx, *.keyxm, *.keyxi, *.das, and for JSON and YAML files that
    begin as decks do). Decks that have not changed are not read again; those that are no longer there are dropped.
    Needs pip install 'mudline[archive]'.
    """
    if lacks_libraries("index"):
        return WRONG_USAGE
    if "-" in paths:
        raise click.UsageError("standard input cannot be archived: give files or directories")
    inputs = collect(paths, "", is_in_any_form, gitignore=not every_file)
    settings = checked_settings(config, Given(units=units), "none", isolated=isolated, fail_on=None)
    from mudline.archive.store import Archive, ArchiveError  # noqa: PLC0415 - an extra
    from mudline.archive.updating import Update  # noqa: PLC0415 - an extra

    folder = Path(output)
    try:
        with Archive.for_one_run(folder, lambda: notify(f"{folder.as_posix()}: waiting for another run")) as archive:
            update = Update(archive)
            if update.damage:
                notify(update.damage)
            _index(inputs, settings, update, view, jobs)
            folders = [path for path in paths if os.path.isdir(path)]  # noqa: PTH112 - as in inputs
            update.remove_gone(folders, everywhere=prune)
            update.save()
    except ArchiveError as error:
        raise click.ClickException(str(error)) from error
    except OSError as error:
        raise click.ClickException(f"{folder.as_posix()}: cannot be written: {reason(error)}") from error
    if not view.quiet:
        _notify_counts(update, folder)
    return max(inputs.code, DONE)


def _index(inputs: Inputs, settings: Settings, update: Update, view: View, jobs: int) -> None:
    """Read the decks that have changed; what has been read is written, also when the run is interrupted.

    A deck that cannot be opened stays as it was.
    """
    from mudline.archive.updating import looked, read_deck  # noqa: PLC0415 - an extra

    def prepared(file: Input) -> tuple[Input, tuple[Order] | None]:
        now = looked(*file.size_and_date())
        order = update.order(file.path or file.name, now, file.read, settings.of(file))
        return file, None if order is None else (order,)

    try:
        with closing(many_files(inputs, prepared, read_deck, Progress(len(inputs.files), view), jobs=jobs)) as results:
            for _, read in results:
                if read is not None:
                    update.take(read)
    except BaseException:
        update.save()
        raise


def _notify_counts(update: Update, folder: Path) -> None:
    found = update.counts
    named = {"new": found.new, "changed": found.changed, "moved": found.moved, "unchanged": found.unchanged}
    words: Sequence[str] = [f"{count} {name}" for name, count in (named | {"gone": found.gone}).items() if count]
    total = counted(sum(named.values()), "deck")
    notify(f"{total}{': ' if words else ''}{', '.join(words)} -> {folder.as_posix()}")
