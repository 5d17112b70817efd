"""Results as two tables in Parquet; needs the extra `parquet`."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import BinaryIO

from mudline.cli.options import View
from mudline.cli.result_files import Sink, together
from mudline.results.columns import ElementTable, NodeTable, Table
from mudline.results.evaluation import Evaluation
from mudline.results.parquet_file import ParquetFile

SUMMARY = "the same columns, in groups of rows; the nodes in `...-nodes.parquet`; `pip install 'mudline[parquet]'`"
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
    with ExitStack() as tables:
        yield together([tables.enter_context(ParquetFile(evaluation, table, stream)) for table, stream in pairs])
