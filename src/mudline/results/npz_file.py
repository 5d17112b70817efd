"""Results as an NPZ archive, written as they come: memory does not grow with the number of steps."""

from __future__ import annotations

import zipfile
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack
from pathlib import Path
from tempfile import TemporaryFile
from types import TracebackType
from typing import IO, Any, BinaryIO, Self

import numpy as np

from mudline.results.columns import Column, Table, Values
from mudline.results.evaluation import Evaluation, Part

_BLOCK = 1 << 18
"""Values that are packed at a time."""

Told = Callable[[], None]


class NpzFile:
    """The same names as arrays: elements (steps, m), nodes (steps, n), vectors (steps, n, 3).

    A single state without a time has no axis for steps. Texts that are null elsewhere are empty. An archive takes one
    array after the other, so until the end what changes lies in nameless files in `folder`.
    """

    def __init__(self, evaluation: Evaluation, tables: list[Table], folder: Path) -> None:
        self._evaluation, self._tables, self._folder = evaluation, tables, folder
        self._arrays: dict[str, _Array] = {}
        self._open = ExitStack()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._open.close()

    @property
    def count(self) -> int:
        """Number of arrays, once there is a result."""
        return len(self._arrays)

    def take(self, part: Part) -> None:
        """Keep some steps. Raises OSError."""
        for table in self._tables:
            for column in table.columns(part):
                if column.name not in self._arrays:
                    self._arrays[column.name] = _Array(column, self._open, self._folder)
                self._arrays[column.name].take(column)

    def write(self, stream: BinaryIO, told: Told) -> None:
        """Write the archive; `told` is called behind each array. Raises OSError."""
        time, steps = self._evaluation.time, self._evaluation.steps
        with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
            for name, array in self._arrays.items():
                shape = array.shape if time is None or not array.over_steps else (steps, *array.shape)
                _pack(archive, name, array.dtype, shape, array.pieces(steps if array.over_steps else 1))
                told()
            if time is not None:
                _pack(archive, "time", time.dtype, time.shape, [time])


class _Array:
    """An array on its way: what no step changes in memory, the others in a file of numbers."""

    def __init__(self, column: Column, opened: ExitStack, folder: Path) -> None:
        self.over_steps = column.over_steps
        self.shape = column.values.shape if column.steady else column.values.shape[1:]
        self._texts = np.array([name or "" for name in column.names], dtype=np.str_) if column.names else None
        self._kept = column.values.dtype
        self.dtype = self._kept if self._texts is None else self._texts.dtype
        self._steady = column.values if column.steady else None
        self._file: IO[bytes] | None = None
        if not column.steady:
            self._file = opened.enter_context(TemporaryFile(dir=folder))  # noqa: SIM115 - open until all is packed

    def take(self, column: Column) -> None:
        """Keep the values of some steps."""
        if self._file is not None:
            self._file.write(np.ascontiguousarray(column.values).data)

    def pieces(self, steps: int) -> Iterator[Values]:
        """All values of so many steps, in their order, flat."""
        if self._steady is not None:
            row = self._steady.ravel()
            together = min(steps, max(1, _BLOCK // max(row.size, 1)))
            block = self._spelled(np.tile(row, together))
            for first in range(0, steps, together):
                yield block[: row.size * min(together, steps - first)]
        elif self._file is not None:
            self._file.seek(0)
            while data := self._file.read(_BLOCK * self._kept.itemsize):
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
