"""Results as an archive of numpy arrays."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

from mudline.cli.evaluate_outputs import More, Sink
from mudline.cli.options import View
from mudline.cli.progress import Progress, looked_at
from mudline.results.columns import ElementTable, NodeTable
from mudline.results.evaluation import Evaluation, Part
from mudline.results.formats import NpzFile

SUMMARY = (
    "an array of each column: (elements,) or (steps, elements), (nodes,) or (steps, nodes), "
    "vectors with a last axis of 3"
)
BESIDE = False


class Packed:
    """An archive, packed when all results are there."""

    def __init__(self, archive: NpzFile, stream: BinaryIO, view: View) -> None:
        self._archive, self._stream, self._view = archive, stream, view

    def take(self, part: Part) -> None:
        """Keep some steps."""
        self._archive.take(part)

    def finish(self, more: More) -> None:
        """Pack the arrays; an archive has no place for more."""
        del more
        with Progress(self._archive.count, self._view, shown=looked_at(self._view)) as progress:
            self._archive.write(self._stream, progress.advance)


@contextmanager
def opened(
    evaluation: Evaluation, elements: ElementTable, streams: list[BinaryIO], folder: Path, view: View
) -> Iterator[Sink]:
    """What takes the results; what is packed at the end lies in `folder` until then."""
    with NpzFile(evaluation, [elements, NodeTable(evaluation)], folder) as archive:
        yield Packed(archive, streams[0], view)
