"""Many files with one work, in the order given: a bar, and a report of each that cannot be read or done.

No file loses what is found of the others.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterator
from contextlib import closing
from typing import TypeVar, TypeVarTuple

from mudline.cli.inputs import Input, Inputs
from mudline.cli.streams import notify
from mudline.cli.view import Progress
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
    """An item for each file, with what the work makes of it, here, in other processes or by a scheduler's workers.

    `prepared` gives the item of a file and what the work is given, None where there is nothing to do; it is called
    when the file is due, and raises OSError where that cannot be read. Files that cannot be read, or for which the
    program itself fails, are reported and left out; `inputs` has them and the exit code. To be closed, so that
    processes end at once where the command does. Raises RunError.
    """

    def items() -> Iterator[tuple[tuple[Input, list[_Item]], tuple[*_Given] | None]]:
        for file in inputs.files:
            try:
                item, given = prepared(file)
            except OSError as error:
                progress.hide()
                inputs.unreadable(file, error)
                yield (file, []), None
            else:
                yield (file, [item]), given

    with progress, closing(many(work, items(), len(inputs.files), jobs, scheduler)) as results:
        for (file, found), made in results:
            if isinstance(made, Crash):
                progress.hide()
                inputs.undone[file] = f"internal error: {made.summary}"
                inputs.fail(f"{file.name}: internal error, please report it: {made.summary}")
                if progress.view.verbose:
                    notify(made.traceback)
            else:
                yield from ((item, made) for item in found)
            progress.advance()
