"""`--scheduler` and the options beside it, and a command's run on the workers of that scheduler."""

from __future__ import annotations

import os
from collections.abc import Generator, Iterable, Iterator
from contextlib import ExitStack, closing, contextmanager
from dataclasses import dataclass, field
from functools import wraps
from hashlib import blake2b
from typing import TYPE_CHECKING

import click
from click.core import ParameterSource

from mudline.cli.inputs import Input, Inputs
from mudline.cli.options import Command
from mudline.cli.streams import counted, notify, reason
from mudline.cluster import storage
from mudline.files import is_url

if TYPE_CHECKING:
    from mudline.cluster.running import Item, Row, Store, Work
    from mudline.cluster.scheduler import Scheduler

_HELP = "Do the work on a cluster: tcp://HOST:PORT, tls://HOST:PORT, or local[:WORKERS] (needs mudline[cluster])."

output = click.option(
    "-o",
    "--output",
    metavar="FOLDER|URL",
    help="With --scheduler: where workers write what is done, and what a second run takes over (default: temporary).",
)
"""The place of results of commands that write no files."""


def options(command: Command) -> Command:
    """`--scheduler`, `--tls-*` and `--insecure`; they reach the command as `scheduler`, a Scheduler or None."""

    @wraps(command)
    def given(
        *,
        scheduler: str | None,
        tls_ca: str | None,
        tls_cert: str | None,
        tls_key: str | None,
        insecure: bool,
        **others: object,
    ) -> int:
        if scheduler is None:
            if tls_ca or tls_cert or tls_key or insecure:
                raise click.UsageError("--tls-* and --insecure are for --scheduler: give it too")
            return command(scheduler=None, **others)
        if click.get_current_context().get_parameter_source("jobs") not in (None, ParameterSource.DEFAULT):
            raise click.UsageError("--jobs is for processes without --scheduler: leave it out, or give local:WORKERS")
        from mudline.cluster.scheduler import Scheduler  # noqa: PLC0415 - few runs use a cluster

        found = Scheduler(scheduler, tls_ca, tls_cert, tls_key, insecure)
        try:
            found.check()
        except ValueError as error:
            raise click.UsageError(str(error)) from error
        return command(scheduler=found, **others)

    for option in (
        click.option("--insecure", is_flag=True, help="Use a scheduler on another machine without TLS."),
        click.option("--tls-key", metavar="FILE", help="The key of --tls-cert."),
        click.option("--tls-cert", metavar="FILE", help="The certificate of this machine, for tls://."),
        click.option("--tls-ca", metavar="FILE", help="The certificates that are trusted, for tls://."),
        click.option("--scheduler", metavar="ADDRESS", help=_HELP),
    ):
        given = option(given)
    return given


Keyed = tuple[Input, str, object]
"""A deck, a text of all its result depends on besides the files, and what the worker is given."""


@dataclass
class OnCluster:
    """The cluster of a command. `place` is the folder or URL of finished chunks, None for a temporary folder.

    A `fresh` run takes over nothing from an earlier one.
    """

    scheduler: Scheduler
    place: str | None = None
    fresh: bool = False
    verbose: bool = False
    taken: int = field(default=0, init=False)
    """Decks whose results the last run took over from an earlier one."""

    def rows(
        self, command: str, work: Work, decks: Iterable[Keyed], count: int, inputs: Inputs
    ) -> Generator[Row | None, None, None]:
        """The row of each deck in order; None for one that was not done, which is reported.

        The cluster is connected, or started, when the first deck is sent: not where an earlier run has done all.
        Ends the command where the cluster cannot be used; what is done stays in `place`.
        """
        from mudline.cluster.running import Job, Run  # noqa: PLC0415 - few runs use a cluster
        from mudline.cluster.scheduler import connected  # noqa: PLC0415 - as above
        from mudline.linting.cache import program  # noqa: PLC0415 - as above
        from mudline.linting.registry import plugin_files  # noqa: PLC0415 - as above

        plugins = [(path, storage.mark(path)) for path in plugin_files()]
        start = repr((program(), command, plugins)).encode("utf-8", "backslashreplace")
        names: list[str] = []
        with _store(self.place) as store, _refusing(self.scheduler.given), ExitStack() as stack:
            items = (self._item(start, one, names) for one in decks)
            job = Job(command, work, items, count, store, self.fresh)
            run = Run(lambda: stack.enter_context(connected(self.scheduler)), job, self.scheduler.given)
            try:
                with closing(run.rows()) as rows:
                    for number, row in enumerate(rows):
                        if row.failed:
                            inputs.fail(f"{names[number]}: not done: {row.failed}")
                        yield None if row.failed else row
            except (KeyboardInterrupt, GeneratorExit):
                more = "the same command goes on from there" if self.place else "-o FOLDER would have kept them"
                notify(f"stopped: {run.done + run.taken} of {counted(count, 'deck')} done; {more}")
                raise
            self.taken = run.taken
            if self.verbose:
                notify(f"{self.scheduler.given}: {counted(run.done, 'deck')} done, {run.taken} from an earlier run")

    def files_before(self, command: str) -> dict[str, set[str]]:
        """The files that earlier runs of a command have read or written, with the marks that they had then."""
        if self.place is None:
            return {}
        with _store(self.place) as store, _refusing(self.scheduler.given):
            return store.files(command)

    @staticmethod
    def _item(start: bytes, deck: Keyed, names: list[str]) -> Item:
        from mudline.cluster.running import Item  # noqa: PLC0415 - as above

        file, words, given = deck
        names.append(file.name)
        digest = blake2b(start, digest_size=20)
        for text in (file.name, words, storage.mark(file.path or "")):
            digest.update(f"{len(text)} {text}".encode("utf-8", "surrogatepass"))
        return Item(digest.hexdigest(), given)


@contextmanager
def _store(place: str | None) -> Iterator[Store]:
    """The place of finished chunks; a temporary folder is removed when the run ends."""
    from mudline.cluster.running import Store  # noqa: PLC0415 - as above

    if place is None:
        from tempfile import TemporaryDirectory  # noqa: PLC0415 - few runs use a cluster

        with TemporaryDirectory(prefix="mudline-", ignore_cleanup_errors=True) as folder:
            yield Store(folder)
        return
    place = storage.as_path(place)
    try:
        storage.make_folder(place)
    except OSError as error:
        raise click.ClickException(f"{place}: cannot be created: {reason(error)}") from error
    yield Store(place if is_url(place) else os.path.abspath(place))  # noqa: PTH100 - links stay what they are


@contextmanager
def _refusing(address: str) -> Iterator[None]:
    """End the command for a cluster or a store that cannot be used."""
    from mudline.cluster.scheduler import ClusterError  # noqa: PLC0415 - as above

    try:
        yield
    except ClusterError as error:
        raise click.ClickException(str(error)) from error
    except (OSError, ValueError) as error:
        if isinstance(error, BrokenPipeError):
            raise
        why = reason(error) if isinstance(error, OSError) else str(error)
        raise click.ClickException(f"{getattr(error, 'filename', None) or address}: {why}") from error


def refuse(scheduler: Scheduler | None, given: dict[str, bool], place: str | None, paths: Iterable[str]) -> None:
    """Raise click.UsageError for options and paths that do not go with `--scheduler`, or only with it."""
    if scheduler is None:
        if place is not None:
            raise click.UsageError("-o is for --scheduler: standard output has the result")
        return
    for option, on in given.items():
        if on:
            raise click.UsageError(f"{option} does not go with --scheduler: leave one of them out")
    if "-" in paths:
        raise click.UsageError("- is standard input, which workers cannot read: give files or URLs with --scheduler")
