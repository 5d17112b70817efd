"""`mudline index`: decks into an archive of Parquet tables, in this process or in others."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from contextlib import closing
from dataclasses import replace
from functools import partial
from importlib.util import find_spec
from pathlib import Path, PurePath
from typing import TYPE_CHECKING

import click

from mudline.archive.rows import Rows, rows_of
from mudline.cli import DONE, WRONG_USAGE, options
from mudline.cli.inputs import Input, Inputs, collect_any_form
from mudline.cli.lint_run import Order, SettingsOf, checked_settings, rules_named
from mudline.cli.streams import counted, notify, notify_missing, reason
from mudline.cli.view import Progress, View, wants_bar
from mudline.files import alone_at, is_url, recording_looks
from mudline.linting.configuration import Given
from mudline.linting.registry import plugin_files
from mudline.running import storage
from mudline.running.executors import Crash, executor, in_order

if TYPE_CHECKING:
    from mudline.archive.updating import Archive


@options.command("index")
@options.paths
@click.option("-o", "--output", required=True, metavar="ARCHIVE", help="The folder of the archive; made if missing.")
@click.option("--prune", is_flag=True, help="Also drop decks outside PATHS whose files are no longer there.")
@options.config
@options.isolated
@options.running
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
    scheduler: str | None,
    every_file: bool,
    units: str | None,
    view: View,
) -> int:
    """Bring decks into an archive: Parquet tables, and a DuckDB file that shows them.

    PATHS are decks, or directories (searched for *.keyx, *.keyxm, *.keyxi, *.das, and for JSON and YAML files that
    begin as decks do), or URLs of either. Decks that have not changed are not read again; those that are no longer
    there are dropped. Needs pip install 'mudline[archive]'.
    """
    if missing := [name for name in ("duckdb", "pyarrow") if find_spec(name) is None]:
        notify_missing("mudline index", " and ".join(missing), "archive")
        return WRONG_USAGE
    if "-" in paths:
        raise click.UsageError("standard input cannot be archived: give files or directories")
    settings = checked_settings(config, Given(units=units), "none", isolated=isolated, fail_on=None)
    inputs = collect_any_form(paths, "", gitignore=not every_file, urls=True)
    from mudline.archive.updating import LOCK, Archive, ArchiveError, check_folder  # noqa: PLC0415 - an extra

    try:
        folder = Path(output := storage.as_path(output))
        if is_url(output) or any(_is_inside(path, folder) for path in paths):
            raise click.UsageError(f"-o {output}: an archive is a folder outside of the decks, and not a URL")
        check_folder(folder)
        folder.mkdir(parents=True, exist_ok=True)
        inputs.files = [file for file in inputs.files if not _is_inside(file.path or file.name, folder)]
        given = [storage.as_path(path) for path in paths if not inputs.code]
        searched = [path if is_url(path) else os.path.abspath(path) for path in given]  # noqa: PTH100 - as in places
        waiting = partial(notify, f"{folder.as_posix()}: waiting for another run")
        with alone_at(folder / LOCK, waiting, made=True), closing(Archive(folder)) as archive:
            seen = _index(inputs, settings.of, archive, view, jobs, scheduler)
            archive.remove_gone(seen, searched, everywhere=prune)
    except ArchiveError as error:
        raise click.ClickException(str(error)) from error
    except OSError as error:
        raise click.ClickException(f"{output}: cannot be written: {reason(error)}") from error
    if not view.quiet:
        counts = archive.counts
        words = ", ".join(f"{counts[name]} {name}" for name in ("new", "changed", "unchanged", "gone") if counts[name])
        total = counted(counts.total() - counts["gone"], "deck")
        notify(f"{total}{': ' if words else ''}{words} -> {folder.as_posix()}")
    return max(inputs.code, DONE)


def _is_inside(path: str, folder: Path) -> bool:
    return not is_url(path) and Path(os.path.realpath(path)).is_relative_to(os.path.realpath(folder))


def read_deck(order: Order) -> tuple[Rows, list[str]]:
    """Read a deck, in any process: its rows, and the paths that they depend on; never raises for content."""
    file = order.file.seen_from(order.here)
    with recording_looks() as paths:
        settings = replace(order.settings, rules=rules_named(order.codes))
        rows = rows_of(order.data, PurePath(file.path or file.name).name, settings, file.folder)
    return rows, list(paths)


def _index(
    inputs: Inputs, settings_of: SettingsOf, archive: Archive, view: View, jobs: int, scheduler: str | None
) -> set[str]:
    """Read the decks that are new or have changed; returns the places of all."""
    files, plugins = {archive.place(file.path or file.name): file for file in inputs.files}, plugin_files()
    with Progress(len(files), view, shown=wants_bar(view)) as progress, executor(jobs, scheduler) as pool:
        orders = _orders(files, inputs, settings_of, archive)

        def crashed(item: tuple[str, str], crash: Crash) -> None:
            progress.hide()
            inputs.crashed(files[item[0]], crash, verbose=view.verbose)
            progress.advance()

        with closing(in_order(pool, read_deck, orders, len(files), crashed)) as found:
            for (place, key), read in found:
                if read is not None:
                    archive.put(place, key, read[0], (*read[1], *plugins))
                progress.advance()
    return set(files)


def _orders(
    files: Mapping[str, Input], inputs: Inputs, settings_of: SettingsOf, archive: Archive
) -> Iterator[tuple[tuple[str, str], Order | None]]:
    """Yield place and key of each deck, with an order if it is to be read; one that cannot be opened stays."""
    for place, file in files.items():
        settings, data = settings_of(file), inputs.content(file)
        if data is not None:
            codes = tuple(rule.code.code for rule in settings.rules)
            bare = replace(settings, rules=(), unfixable=frozenset())
            key = archive.memory.key(place, repr((codes, bare)), data)
            yield (place, key), Order(file, data, bare, codes, os.getcwd()) if archive.is_new(place, key) else None  # noqa: PTH109 - sent as text
