"""An evaluation written in each form, and read again."""

from __future__ import annotations

import io
import json
from collections.abc import Callable, Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from mudline.results.columns import ElementTable, NodeTable, Table
from mudline.results.evaluation import Evaluation
from mudline.results.formats import CsvForm, JsonForm, NpzFile, TextForm
from mudline.results.totals import Digest, StepTotal, Total, totals

Json: TypeAlias = Any


def pieces(evaluation: Evaluation, form: TextForm) -> Iterator[str]:
    """All of a form."""
    for part in evaluation.parts():
        yield from form.body(part)
    yield from form.tail({})


def json_pieces(evaluation: Evaluation) -> Iterator[str]:
    """The JSON as it is written."""
    return pieces(evaluation, JsonForm(evaluation, ElementTable(evaluation)))


def json_of(evaluation: Evaluation) -> Json:
    """What the JSON holds."""
    return json.loads("".join(json_pieces(evaluation)))


def csv_pieces(evaluation: Evaluation, table: str) -> Iterator[str]:
    """The CSV of `elements` or `nodes` as it is written."""
    make: Callable[[Evaluation], ElementTable | NodeTable] = ElementTable if table == "elements" else NodeTable
    return pieces(evaluation, CsvForm(evaluation, make(evaluation)))


def csv_of(evaluation: Evaluation, table: str) -> str:
    """The CSV of `elements` or `nodes`."""
    return "".join(csv_pieces(evaluation, table))


def arrays_of(evaluation: Evaluation) -> dict[str, NDArray[Any]]:
    """What the NPZ archive holds."""
    stream = io.BytesIO()
    tables: list[Table] = [ElementTable(evaluation), NodeTable(evaluation)]
    with TemporaryDirectory() as folder, NpzFile(evaluation, tables, Path(folder)) as file:
        for part in evaluation.parts():
            file.take(part)
        file.write(stream, lambda: None)
    with np.load(io.BytesIO(stream.getvalue()), allow_pickle=False) as archive:
        return dict(archive)


def steps_of(evaluation: Evaluation, most: int | None = None) -> list[StepTotal]:
    """The figures of the first steps."""
    digest = Digest(evaluation, most)
    for part in evaluation.parts():
        digest.take(part)
    return digest.steps


def totals_of(evaluation: Evaluation) -> list[Total]:
    """The figures of the first step by law and set."""
    return totals(evaluation, next(evaluation.parts()))
