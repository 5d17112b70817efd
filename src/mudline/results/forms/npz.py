"""Results as an archive of numpy arrays."""

from __future__ import annotations

import zipfile
from collections.abc import Iterable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from tempfile import TemporaryFile
from typing import IO, Any, BinaryIO

import numpy as np

from mudline.contact.columns import Column, Values
from mudline.contact.frames import array_name, spelled
from mudline.contact.result import Part
from mudline.quantities import RESULT_FORMAT
from mudline.results.forms import More, Output, Sink, Tables

SUMMARY = (
    "an array of each column: (elements,) or (steps, elements), (nodes,) or (steps, nodes), vectors with a last axis "
    "of 3; `node_` before what elements have too, `summary_` before (lines,) or (steps, lines); `units` and `format`"
)
BESIDE = ()

_PACKED = 1 << 18
"""Values that are packed at a time."""


@contextmanager
def opened(output: Output) -> Iterator[Sink]:
    """What takes the results."""
    with ExitStack() as temporary:
        yield NpzArchive(output, temporary)


class NpzArchive:
    """The names of the columns as arrays: elements (steps, m), nodes (steps, n), vectors (steps, n, 3).

    A single state without a time has no axis for steps. Texts that are null elsewhere are empty. An archive takes one
    array after the other, so what changes is in nameless files until the end, in the folder of the output.
    """

    def __init__(self, output: Output, temporary: ExitStack) -> None:
        self._output, self._tables, self._temporary = output, output.tables, temporary
        self._arrays: dict[str, _Array] = {}

    def take(self, part: Part) -> None:
        """Keep some steps. Raises OSError."""
        for which, table in self._tables.items():
            for column in table.columns(part):
                name = array_name(which, column.name)
                if name not in self._arrays:
                    self._arrays[name] = _Array(column, self._temporary, self._output.folder)
                self._arrays[name].take(column)

    def finish(self, more: More) -> None:
        """Write the archive; it has no place for more. Raises OSError."""
        del more
        time, steps = self._output.evaluation.time, self._output.evaluation.steps
        with zipfile.ZipFile(self._output.streams[0], "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
            for name, array in self._output.tracked(list(self._arrays.items())):
                shape = array.shape if time is None or not array.over_steps else (steps, *array.shape)
                _pack(archive, name, array.dtype, shape, array.pieces(steps if array.over_steps else 1))
            if time is not None:
                _pack(archive, "time", time.dtype, time.shape, [time])
            for name, text in (("units", self._output.elements.units), ("format", RESULT_FORMAT)):
                word = np.array(text)
                _pack(archive, name, word.dtype, word.shape, [word])


def write_tables(tables: Tables, streams: Sequence[BinaryIO], folder: Path) -> None:
    """Write an archive with the name of the table before that of each column."""
    del folder
    words = {"units": tables.units, "format": tables.format}
    arrays = {
        f"{table}_{column.name}": spelled(column) for table, columns in tables.columns.items() for column in columns
    }
    arrays |= {name: np.array(text) for name, text in words.items()}
    with zipfile.ZipFile(streams[0], "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        for name, array in arrays.items():
            _pack(archive, name, array.dtype, array.shape, [array])


class _Array:
    """An array on its way: what no step changes in memory, the others in a file of numbers."""

    def __init__(self, column: Column, temporary: ExitStack, folder: Path) -> None:
        self.over_steps = column.over_steps
        self.shape = column.values.shape if column.steady else column.values.shape[1:]
        self._texts = np.array([name or "" for name in column.names], dtype=np.str_) if column.names else None
        self._kept = column.values.dtype
        self.dtype = self._kept if self._texts is None else self._texts.dtype
        self._steady = column.values if column.steady else None
        self._file: IO[bytes] | None = None
        if not column.steady:
            self._file = temporary.enter_context(TemporaryFile(dir=folder))  # noqa: SIM115 - open until all is packed

    def take(self, column: Column) -> None:
        """Keep the values of some steps."""
        if self._file is not None:
            self._file.write(np.ascontiguousarray(column.values).data)

    def pieces(self, steps: int) -> Iterator[Values]:
        """All values of so many steps, in their order, flat."""
        if self._steady is not None:
            row = self._steady.ravel()
            together = min(steps, max(1, _PACKED // max(row.size, 1)))
            block = self._spelled(np.tile(row, together))
            for first in range(0, steps, together):
                yield block[: row.size * min(together, steps - first)]
        elif self._file is not None:
            self._file.seek(0)
            while data := self._file.read(_PACKED * self._kept.itemsize):
                yield self._spelled(np.frombuffer(data, self._kept))

    def _spelled(self, values: Values) -> Values:
        return values if self._texts is None else self._texts[values]


def _pack(
    archive: zipfile.ZipFile, name: str, kind: np.dtype[Any], shape: tuple[int, ...], pieces: Iterable[Values]
) -> None:
    """Write an array as a member, piece by piece."""
    header = {"descr": np.lib.format.dtype_to_descr(kind), "fortran_order": False, "shape": shape}
    with archive.open(f"{name}.npy", "w", force_zip64=True) as member:
        np.lib.format.write_array_header_1_0(member, header)
        for piece in pieces:
            member.write(piece.tobytes())
