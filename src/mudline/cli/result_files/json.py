"""Results as one JSON document."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

from mudline.cli.options import View
from mudline.cli.result_files import Sink, as_text, text_into
from mudline.results.columns import ElementTable
from mudline.results.evaluation import Evaluation
from mudline.results.formats import JsonForm

SUMMARY = "everything: units, plan, elements, nodes, `restrained`, `against`"
BESIDE = False


@contextmanager
def opened(
    evaluation: Evaluation,
    elements: ElementTable,
    streams: list[BinaryIO],
    folder: Path,  # noqa: ARG001 - the same for every form
    view: View,  # noqa: ARG001
) -> Iterator[Sink]:
    """What takes the results."""
    yield as_text(JsonForm(evaluation, elements), text_into(streams[0]))
