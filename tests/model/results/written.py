"""An evaluation written in each form, and read again."""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from mudline.cli.result_files import beside
from mudline.model.results.evaluation import Evaluation
from mudline.model.results.forms import FileContent, ResultOutput, Sink, Writer
from mudline.model.results.forms.text import text_writer
from mudline.model.results.totals import step_totals

Json: TypeAlias = Any


def pieces(evaluation: Evaluation, form: str, table: str = "elements") -> Iterator[str]:
    """All that a form of text writes, piece by piece as it comes."""
    written: list[Iterator[str]] = []
    sink = Sink(evaluation, form, partial(text_writer, form, writes={table: written.append}), only=table)
    for part in evaluation.parts():
        sink.take(part)
        yield from written.pop()
    sink.finish()
    for rest in written:
        yield from rest


def json_of(evaluation: Evaluation) -> Json:
    """What the JSON holds."""
    return json.loads("".join(pieces(evaluation, "json")))


def write(evaluation: Evaluation, path: Path) -> Path:
    """Write an evaluation in the form of the suffix, as the command does."""
    form = path.suffix[1:]
    with ExitStack() as stack:
        paths = [path, *beside(path).values()]
        streams = [stack.enter_context(one.open("wb")) for one in paths]

        def writer(contents: FileContent) -> Writer:
            return ResultOutput(form, contents, streams, path.parent, stack).writer()

        sink = Sink(evaluation, form, writer)
        for part in evaluation.parts():
            sink.take(part)
        sink.finish()
    return path


def arrays_of(evaluation: Evaluation) -> dict[str, NDArray[Any]]:
    """What the NPZ archive holds."""
    with TemporaryDirectory() as folder, np.load(write(evaluation, Path(folder) / "out.npz")) as archive:
        return dict(archive)


def steps_of(evaluation: Evaluation) -> list[dict[str, Any]]:
    """The figures of all steps."""
    return [row for part in evaluation.parts() for row in step_totals(evaluation, part)]
