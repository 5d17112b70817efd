"""One function applied to many files, in the order given, with a progress bar.

Files that cannot be read, or for which the program fails, are reported, and the others are still processed. So are
decks that a command refuses to rewrite.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterator
from contextlib import closing
from typing import TypeVar, TypeVarTuple

from mudline.cli.inputs import Input, Inputs
from mudline.cli.streams import notify, notify_diagnostics
from mudline.cli.view import Progress
from mudline.language.diagnostics import DeckError
from mudline.tools.running.executors import Crash, many

_Item = TypeVar("_Item")
_Given = TypeVarTuple("_Given")
_Made = TypeVar("_Made")


def many_files(
    inputs: Inputs,
    prepared: Callable[[Input], tuple[_Item, tuple[*_Given] | None]],
    work: Callable[[*_Given], _Made],
    progress: Progress,
    *,
    jobs: int,
    scheduler: str | None = None,
) -> Generator[tuple[_Item, _Made | None], None, None]:
    """Yield an item for each file with the result of `work`, run here, in other processes or by a scheduler's workers.

    `prepared` returns the item of a file and the arguments of `work`, or None if there is no work. It is called when
    the file is due, and raises OSError if the file cannot be read. Files that cannot be read, or for which the program
    itself fails, are reported and left out; `inputs` records them and the exit code. Close the generator to end the
    processes as soon as the command ends. Raises RunError.
    """

    def items() -> Iterator[tuple[tuple[Input, _Item], tuple[*_Given] | None]]:
        for file in inputs.files:
            try:
                item, given = prepared(file)
            except OSError as error:
                progress.hide()
                inputs.unreadable(file, error)
                progress.advance()
            else:
                yield (file, item), given

    with progress, closing(many(work, items(), len(inputs.files), jobs, scheduler)) as results:
        for (file, item), result in results:
            if isinstance(result, Crash):
                progress.hide()
                inputs.undone[file] = f"internal error: {result.summary}"
                inputs.fail(f"{file.name}: internal error, please report it: {result.summary}")
                if progress.view.verbose:
                    notify(result.traceback)
            else:
                yield item, result
            progress.advance()


def each_deck(
    inputs: Inputs, work: Callable[[Input, bytes], _Made], progress: Progress, *refusals: type[Exception]
) -> Iterator[tuple[Input, bytes, _Made | None]]:
    """Yield each deck with its content and the result of `work`, made here, one after the other.

    The result is None for a deck that `work` refuses by a DeckError, or by another of `refusals`; it is reported.
    """

    def prepared(file: Input) -> tuple[tuple[Input, bytes], tuple[Input, bytes]]:
        given = file, file.read()
        return given, given

    refusing: tuple[type[Exception], ...] = (DeckError, *refusals)

    def tried(file: Input, data: bytes) -> _Made | Exception:
        try:
            return work(file, data)
        except refusing as error:
            return error

    with closing(many_files(inputs, prepared, tried, progress, jobs=1)) as results:
        for (file, data), made in results:
            if not isinstance(made, Exception):
                yield file, data, made
                continue
            progress.hide()
            if not isinstance(made, DeckError):
                line = getattr(made, "line", None)
                notify(f"{file.name}{f':{line}' if line else ''}: {made}")
            notify_diagnostics(getattr(made, "diagnostics", ()))
            yield file, data, None
