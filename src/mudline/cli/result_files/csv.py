"""Results as two tables of CSV."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

from mudline.cli.options import View
from mudline.cli.result_files import Sink, as_text, text_into, together
from mudline.results.columns import ElementTable, NodeTable, Table
from mudline.results.evaluation import Evaluation
from mudline.results.formats import CsvForm

SUMMARY = "elements; the nodes in `...-nodes.csv`"
BESIDE = True


@contextmanager
def opened(
    evaluation: Evaluation,
    elements: ElementTable,
    streams: list[BinaryIO],
    folder: Path,  # noqa: ARG001 - the same for every form
    view: View,  # noqa: ARG001
) -> Iterator[Sink]:
    """What takes the results."""
    both: list[Table] = [elements, NodeTable(evaluation)]
    pairs = zip(both, streams, strict=True)
    yield together([as_text(CsvForm(evaluation, table), text_into(stream)) for table, stream in pairs])
