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

from mudline.contact.columns import Table
from mudline.results.evaluation import Evaluation
from mudline.results.forms import Output, Sink, Write, npz, text_form
from mudline.results.totals import StepSummary, StepTotal, Total, totals

Json: TypeAlias = Any


def pieces(evaluation: Evaluation, form: Callable[[Write], Sink]) -> Iterator[str]:
    """All that a form writes, piece by piece as it comes."""
    written: list[Iterator[str]] = []
    sink = form(written.append)
    for part in evaluation.parts():
        sink.take(part)
        yield from written.pop()
    sink.finish({})
    for rest in written:
        yield from rest


def json_pieces(evaluation: Evaluation) -> Iterator[str]:
    """The JSON as it is written."""
    return pieces(evaluation, lambda write: text_form("json")(evaluation, evaluation.element_table(), write))


def json_of(evaluation: Evaluation) -> Json:
    """What the JSON holds."""
    return json.loads("".join(json_pieces(evaluation)))


def csv_pieces(evaluation: Evaluation, table: str) -> Iterator[str]:
    """The CSV of `elements`, `nodes` or `summary` as it is written."""
    tables: dict[str, Callable[[], Table]] = {
        "elements": evaluation.element_table,
        "nodes": evaluation.node_table,
        "summary": evaluation.line_table,
    }
    return pieces(evaluation, lambda write: text_form("csv")(evaluation, tables[table](), write))


def csv_of(evaluation: Evaluation, table: str) -> str:
    """The CSV of `elements` or `nodes`."""
    return "".join(csv_pieces(evaluation, table))


def arrays_of(evaluation: Evaluation) -> dict[str, NDArray[Any]]:
    """What the NPZ archive holds."""
    stream = io.BytesIO()
    with (
        TemporaryDirectory() as folder,
        npz.opened(Output(evaluation, evaluation.element_table(), [stream], Path(folder))) as sink,
    ):
        for part in evaluation.parts():
            sink.take(part)
        sink.finish({})
    with np.load(io.BytesIO(stream.getvalue()), allow_pickle=False) as archive:
        return dict(archive)


def steps_of(evaluation: Evaluation, most: int | None = None) -> list[StepTotal]:
    """The figures of the first steps."""
    digest = StepSummary(evaluation, most)
    for part in evaluation.parts():
        digest.take(part)
    return digest.steps


def totals_of(evaluation: Evaluation) -> list[Total]:
    """The figures of the first step by law and set."""
    return totals(evaluation, next(evaluation.parts()))
