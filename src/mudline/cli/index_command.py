"""Command `mudline index`: decks into an archive of Parquet tables, with several processes."""

from __future__ import annotations

import os
from contextlib import closing
from dataclasses import replace
from functools import partial
from pathlib import Path, PurePath
from typing import TYPE_CHECKING

import click

from mudline.basics.files import alone_at, recording_looks
from mudline.basics.short_repr import counted
from mudline.checks.configuration import CallerSettings
from mudline.checks.engine import LintSettings
from mudline.checks.registry import plugin_files
from mudline.checks.settings import Settings
from mudline.cli import DONE, options
from mudline.cli.inputs import STDIN, GivenDecks, Input, Inputs, many_files, takes_decks
from mudline.cli.lint_run import checked_settings
from mudline.cli.streams import naming, notify, refusing, require
from mudline.cli.view import View
from mudline.language.deck.searching import is_in_any_form
from mudline.tools.archive.rows import Rows, rows_of

if TYPE_CHECKING:
    from mudline.tools.archive.updating import Archive


@options.command("index")
@options.option(
    "-o", "--output", required=True, metavar="ARCHIVE", help="The folder of the archive; created if missing."
)
@options.flag("--prune", help="Also drop decks outside PATHS whose files no longer exist.")
@options.config
@options.isolated
@options.jobs
@takes_decks(stdin=False)
def command(
    *, decks: GivenDecks, output: str, prune: bool, config: str | None, isolated: bool, jobs: int, view: View
) -> int:
    """Bring decks into an archive: Parquet tables, and a DuckDB file that shows them.

    PATHS are decks, or directories (searched for *.keyx, *.keyxm, *.keyxi, *.das, and for JSON and YAML files that
    begin as decks do). Decks that have not changed are not read again. Decks that no longer exist are dropped. Needs
    the extra mudline[archive].
    """
    require("mudline index", "archive", "duckdb", "pyarrow")
    if STDIN in decks.paths:
        raise click.UsageError("standard input cannot be archived: give files or directories")
    settings = checked_settings(config, CallerSettings(units=decks.units), isolated=isolated)
    inputs = decks.collect(is_in_any_form)
    from mudline.tools.archive.updating import LOCK, Archive, ArchiveError, check_folder  # noqa: PLC0415 - an extra

    with refusing(ArchiveError, kind=click.ClickException), naming(output, "cannot be written: "):
        folder = Path(output)
        if any(_is_inside(path, folder) for path in decks.paths):
            raise click.UsageError(f"-o {output}: the decks lie in this folder: give the archive a folder of its own")
        check_folder(folder)
        folder.mkdir(parents=True, exist_ok=True)
        inputs.files = [file for file in inputs.files if not _is_inside(file.place, folder)]
        searched = [os.path.abspath(path) for path in decks.paths if not inputs.code]  # noqa: PTH100 - as in places
        waiting = partial(notify, f"{folder.as_posix()}: waiting for another run")
        with alone_at(folder / LOCK, waiting, made=True), closing(Archive(folder)) as archive:
            seen = _index(inputs, settings, archive, view, jobs)
            archive.remove_gone(seen, searched, everywhere=prune)
    counts = archive.counts
    words = ", ".join(f"{counts[name]} {name}" for name in ("new", "changed", "unchanged", "gone") if counts[name])
    total = counted(counts.total() - counts["gone"], "deck")
    view.note(f"{total}{': ' if words else ''}{words} -> {folder.as_posix()}")
    return max(inputs.code, DONE)


def _is_inside(path: str, folder: Path) -> bool:
    return Path(os.path.realpath(path)).is_relative_to(os.path.realpath(folder))


def read_deck(data: bytes, name: str, settings: LintSettings, folder: Path | None) -> tuple[Rows, list[str]]:
    """Return the rows of a deck, and the paths that they depend on; never raises for content. Runs in any process."""
    with recording_looks() as paths:
        rows = rows_of(data, name, settings, folder)
    return rows, list(paths)


def _index(inputs: Inputs, settings: Settings, archive: Archive, view: View, jobs: int) -> set[str]:
    """Read new and changed decks; return the places of all decks. A deck that cannot be opened stays in the archive."""
    files, plugins = {archive.place(file.place): file for file in inputs.files}, plugin_files()
    inputs.files = list(files.values())

    def prepared(file: Input) -> tuple[tuple[str, str], tuple[bytes, str, LintSettings, Path | None] | None]:
        place, data, own = archive.place(file.place), file.read(), settings.of(file.place)
        codes = tuple(rule.code.code for rule in own.rules)
        key = archive.memory.key(place, repr((codes, replace(own, rules=(), unfixable=frozenset()))), data)
        given = (data, PurePath(file.place).name, own, file.folder)
        return (place, key), given if archive.is_new(place, key) else None

    with closing(many_files(inputs, prepared, read_deck, view, jobs=jobs)) as results:
        for (place, key), read in results:
            if read is not None:
                archive.put(place, key, read[0], (*read[1], *plugins))
    return set(files)
