"""Results as an archive of numpy arrays."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

from mudline.cli.options import View
from mudline.cli.progress import Progress, wants_bar
from mudline.cli.result_files import More, Sink, Written
from mudline.results.columns import ElementTable, NodeTable
from mudline.results.evaluation import Evaluation
from mudline.results.formats import NpzFile

SUMMARY = (
    "an array of each column: (elements,) or (steps, elements), (nodes,) or (steps, nodes), "
    "vectors with a last axis of 3"
)
BESIDE = False


@contextmanager
def opened(
    evaluation: Evaluation, elements: ElementTable, streams: list[BinaryIO], folder: Path, view: View
) -> Iterator[Sink]:
    """What takes the results; what is packed at the end lies in `folder` until then."""

    def pack(_: More) -> None:
        with Progress(archive.count, view, shown=wants_bar(view)) as progress:
            archive.write(streams[0], progress.advance)

    with NpzFile(evaluation, [elements, NodeTable(evaluation)], folder) as archive:
        yield Written(archive.take, pack)
