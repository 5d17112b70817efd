"""Results as an archive of numpy arrays."""

from __future__ import annotations

import zipfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from tempfile import TemporaryFile
from typing import IO, Any

import numpy as np

from mudline.model.contact.columns import ResultColumn, Values
from mudline.model.contact.frames import spelled
from mudline.model.results.forms import Columns, More, ResultOutput

_PACKED = 1 << 18
"""Values packed at a time."""


class NpzWriter:
    """Writer of the columns as arrays: elements (steps, m), nodes (steps, n), vectors (steps, n, 3).

    A single state without a time has no axis for steps. Texts that are null in other formats are empty. An archive
    takes one array after the other, so values that change are in nameless files in its folder until the end.
    """

    def __init__(self, output: ResultOutput) -> None:
        self._output, self._contents = output, output.contents
        self._arrays: dict[str, _Array] = {}

    def write(self, columns: Columns, _start: int, _count: int, _beside: Mapping[str, Sequence[object]]) -> None:
        """Keep some steps. Raises OSError."""
        for table, each in columns.items():
            for column in each:
                name = self._contents.array_name(table, column.name)
                if name not in self._arrays:
                    self._arrays[name] = _Array(column, None if column.steady else self._file())
                self._arrays[name].take(column)

    def finish(self, _more: More) -> None:
        """Write the archive; it cannot hold `more`. Raises OSError."""
        times, steps = self._contents.times, self._contents.steps
        with zipfile.ZipFile(self._output.streams[0], "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
            for name, array in self._output.tracked(list(self._arrays.items())):
                shape = array.shape if times is None or not array.over_steps else (steps, *array.shape)
                _pack(archive, name, array.dtype, shape, array.pieces(steps if array.over_steps else 1))
            about = {"units": np.array(self._contents.units), "format": np.array(self._contents.format)}
            for name, values in (about if times is None else {"time": times, **about}).items():
                _pack(archive, name, values.dtype, values.shape, [values])

    def _file(self) -> IO[bytes]:
        return self._output.open.enter_context(TemporaryFile(dir=self._output.folder))


writer = NpzWriter


class _Array:
    """An array to be written: values that no step changes in memory, other values in a file of numbers."""

    def __init__(self, column: ResultColumn, file: IO[bytes] | None) -> None:
        self.over_steps = column.over_steps
        self.shape = column.values.shape if column.steady else column.values.shape[1:]
        self._column, self._kept, self._file = column, column.values.dtype, file
        self.dtype = self._spelled(np.zeros(0, self._kept)).dtype

    def take(self, column: ResultColumn) -> None:
        """Keep the values of some steps."""
        if self._file is not None:
            self._file.write(np.ascontiguousarray(column.values).data)

    def pieces(self, steps: int) -> Iterator[Values]:
        """Yield all values of so many steps, in order, flat."""
        if self._file is None:
            row = self._column.values.ravel()
            together = min(steps, max(1, _PACKED // max(row.size, 1)))
            block = self._spelled(np.tile(row, together))
            for first in range(0, steps, together):
                yield block[: row.size * min(together, steps - first)]
            return
        self._file.seek(0)
        while data := self._file.read(_PACKED * self._kept.itemsize):
            yield self._spelled(np.frombuffer(data, self._kept))

    def _spelled(self, values: Values) -> Values:
        return spelled(replace(self._column, values=values))


def _pack(
    archive: zipfile.ZipFile, name: str, kind: np.dtype[Any], shape: tuple[int, ...], pieces: Iterable[Values]
) -> None:
    """Write an array as a member, piece by piece."""
    header = {"descr": np.lib.format.dtype_to_descr(kind), "fortran_order": False, "shape": shape}
    with archive.open(f"{name}.npy", "w", force_zip64=True) as member:
        np.lib.format.write_array_header_1_0(member, header)
        for piece in pieces:
            member.write(piece.tobytes())
