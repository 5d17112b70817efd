"""One module a form of result files, with the name of the suffix. A module is a form by being here.

It holds what `ResultFile` says, and is imported when somebody asks for the form.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules
from typing import BinaryIO, Protocol, cast

from mudline.cli.options import View
from mudline.cli.streams import encoded
from mudline.results.columns import ElementTable
from mudline.results.evaluation import Evaluation, Part
from mudline.results.formats import TextForm

More = Mapping[str, object]
"""What is known only after the last step, by its key in JSON."""


class ResultConsumer(Protocol):
    """Takes the results of a few steps at a time."""

    def take(self, part: Part) -> None:
        """Take some steps."""


class Sink(ResultConsumer, Protocol):
    """A file or standard output."""

    def finish(self, more: More) -> None:
        """Write what comes after the last step."""


class ResultFile(Protocol):
    """The module of a form of result files.

    `SUMMARY` says in the documentation what is in it; where it is `BESIDE`, the nodes go to a second file.
    """

    SUMMARY: str
    BESIDE: bool

    def opened(
        self, evaluation: Evaluation, elements: ElementTable, streams: list[BinaryIO], folder: Path, view: View
    ) -> AbstractContextManager[Sink]:
        """Return what takes the results and writes them into one or two files of `folder`."""


@dataclass(frozen=True, slots=True)
class Written:
    """Output by two functions: for some steps, and for what comes after the last step."""

    take: Callable[[Part], None]
    finish: Callable[[More], None] = lambda _: None


def as_text(form: TextForm, write: Callable[[Iterator[str]], None]) -> Written:
    """Text, in pieces that `write` gets."""
    return Written(lambda part: write(form.body(part)), lambda more: write(form.tail(more)))


def together(consumers: Sequence[ResultConsumer]) -> Written:
    """Several tables, or none; a table has nothing after the last step."""

    def take(part: Part) -> None:
        for consumer in consumers:
            consumer.take(part)

    return Written(take)


def text_into(stream: BinaryIO) -> Callable[[Iterator[str]], None]:
    """Return what writes pieces of text into a file."""
    return lambda pieces: stream.writelines(map(encoded, pieces))


def result_forms() -> list[str]:
    """Return the forms of result files, found without importing one."""
    return sorted(found.name for found in iter_modules(__path__))


def result_file(form: str) -> ResultFile:
    """Return the module of a form of result files; raises ImportError without the library that it needs."""
    return cast("ResultFile", import_module(f"{__name__}.{form}"))
