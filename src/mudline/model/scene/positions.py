"""Positions of nodes from a CSV, NPY or NPZ file: one state or a time series."""

from __future__ import annotations

import warnings
import weakref
import zipfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from math import prod
from pathlib import Path
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from mudline.basics.short_repr import listed_numbers, short_repr
from mudline.language.diagnostics import DeckError
from mudline.model.contact.arrays import Positions, StepReader
from mudline.model.scene.csv_file import DAMAGED, NumericTable, data_error, finite, read_numeric_csv, whole_numbers
from mudline.model.scene.numbering import Floats, Ids, Indices, Mask, Numbered

_AXES = ("x", "y", "z")
_VELOCITIES = ("vx", "vy", "vz")
COLUMNS = ("time", "node", *_AXES, *_VELOCITIES)
"""Columns of positions in a CSV."""

Reals = NDArray[np.floating]

_ARRAYS = frozenset({"positions", "node", "time", "velocities"})


class StepFile(StepReader):
    """Steps of an NPY file, an array (steps, nodes, 3) in C order, read on demand.

    They are read and not mapped: a file that becomes shorter while it is mapped ends the program. `order` (nodes,)
        gives the node of the file for each node of the deck.
    """

    def __init__(
        self, path: Path, mapped: np.memmap[tuple[int, ...], np.dtype[np.floating]], order: Indices | None = None
    ) -> None:
        self.shape, self.dtype, self.ndim = mapped.shape, mapped.dtype, mapped.ndim
        self._file, self._offset = path.as_posix(), mapped.offset
        self._order = order
        self._stream = path.open("rb", buffering=0)
        weakref.finalize(self, self._stream.close)

    __repr__ = short_repr

    def __len__(self) -> int:
        return self.shape[0]

    def __getitem__(self, steps: slice | int) -> Reals:
        """Return some steps (steps, nodes, 3), or one (nodes, 3). Raises OSError, DeckError."""
        if not isinstance(steps, slice):
            return cast("Reals", self[steps : steps + 1][0])
        first, last, _ = steps.indices(len(self))
        values = np.empty((max(0, last - first), *self.shape[1:]), self.dtype)
        left = values.reshape(-1).view(np.uint8).data
        self._stream.seek(self._offset + first * values[:1].nbytes)
        while left:
            count = self._stream.readinto(left)
            if not count:
                message = "the file has become shorter while it was read: wait until it is written, and try again"
                raise data_error(self._file, message)
            left = left[count:]
        return values if self._order is None else values[:, self._order]


def read_positions(path: Path, nodes: Numbered, headings: Mapping[str, str] | None = None) -> Positions:
    """Return positions from CSV (`[time,]node,x,y,z[,vx,vy,vz]`), NPZ or NPY by the file's suffix.

    `headings` are those of a CSV whose columns have other names, by the name in `COLUMNS`; the values stay as they are.

    Raises OSError, or DeckError for a file with faults: undefined nodes, values that are not numbers, steps with
        different nodes.
    """
    file, suffix = path.as_posix(), path.suffix.lower()
    if suffix == ".npy":
        return _from_npy(path, nodes)
    if suffix == ".npz":
        return _from_arrays(file, _load_npz(path), nodes)
    return _of_table(read_numeric_csv(path, ("node", *_AXES), COLUMNS, headings), nodes)


def positions_of(
    given: Any,  # noqa: ANN401 - of a library that need not be there
    nodes: Numbered,
    headings: Mapping[str, str] | None = None,
) -> Positions:
    """Return positions in a pandas frame or an xarray data set or array, with the contents that `read_positions` gives.

    A frame has the columns of a CSV, also in its index. A data set has the arrays of an NPZ. A data array is its
    `positions`, with the dimensions `time`, `node` and one for the axes.

    Raises DeckError as `read_positions` does.
    """
    name = f"<{type(given).__name__}>"
    if hasattr(given, "dims") and not hasattr(given, "iloc"):
        held = given if hasattr(given, "data_vars") else given.to_dataset(name="positions")
        if "positions" not in held:
            raise data_error(name, f"no variable named positions, only {', '.join(map(str, held)) or 'nothing'}")
        leading = [one for one in ("time", "node") if one in held["positions"].dims]
        held = held.transpose(*leading, ...)
        arrays = {one: _real(name, one, np.asarray(held[one])) for one in sorted(_ARRAYS) if one in held}
        return _from_arrays(name, arrays, nodes)
    frame = given if given.index.names == [None] else given.reset_index()
    columns = {one: frame[heading] for one in COLUMNS if (heading := (headings or {}).get(one, one)) in frame}
    if lacking := [one for one in ("node", *_AXES) if one not in columns]:
        raise data_error(name, f"no column {', '.join(lacking)}: it has {', '.join(map(str, frame.columns))}")
    numbers = {one: finite(name, one, _real(name, one, np.asarray(column))) for one, column in columns.items()}
    return _of_table(NumericTable(name, numbers, range(1, len(frame) + 1)), nodes)


def _spread(values: NDArray[np.floating], where: Indices, count: int) -> NDArray[np.floating]:
    """Return rows of some nodes as rows of all nodes, NaN for the others."""
    spread = np.full((len(values), count, 3), np.nan)
    spread[:, where] = values
    return spread


def _of_table(table: NumericTable, nodes: Numbered) -> Positions:
    if not table.lines:
        raise data_error(table.file, "no row below the header", 2)
    if len({name in table.columns for name in _VELOCITIES}) > 1:
        raise data_error(table.file, "velocities need all of vx, vy and vz")
    ids = whole_numbers("node", table.columns["node"], lambda row, why: data_error(table.file, why, table.lines[row]))
    where, present = _placed(table.file, ids, nodes, table.lines)
    times, step = np.unique(table.columns.get("time", np.zeros(len(ids))), return_inverse=True)
    _complete(table, ids, step, times)
    shape = (len(times), len(nodes))
    values = _scatter(table, _AXES, shape, step, where)
    velocities = _scatter(table, _VELOCITIES, shape, step, where) if "vx" in table.columns else None
    return Positions(values, present, times if "time" in table.columns else None, velocities)


def _complete(table: NumericTable, ids: Ids, step: Indices, times: Floats) -> None:
    """Raise DeckError unless every step has every node of the file once."""
    nodes, index = np.unique(ids, return_inverse=True)
    cells = step * len(nodes) + index
    order = np.argsort(cells, kind="stable")
    ordered = cells[order]
    repeats = np.flatnonzero(ordered[1:] == ordered[:-1])
    if repeats.size:
        row = int(order[repeats[0] + 1])
        message = f"node {ids[row]} is given twice{_at(times, int(step[row]))}"
        raise data_error(table.file, message, table.lines[row])
    if len(cells) < len(times) * len(nodes):
        gaps = np.flatnonzero(ordered != np.arange(len(ordered)))
        at_step, lacking = divmod(int(gaps[0]) if gaps.size else len(ordered), len(nodes))
        raise data_error(table.file, f"node {nodes[lacking]} is missing{_at(times, at_step)}")


def _at(times: Floats, step: int) -> str:
    return f" at time {float(times[step])!r}" if len(times) > 1 else ""


def _scatter(
    table: NumericTable, names: tuple[str, ...], shape: tuple[int, int], step: Indices, where: Indices
) -> Floats:
    values = np.full((*shape, 3), np.nan)
    for axis, name in enumerate(names):
        values[step, where, axis] = table.columns[name]
    return values


def _placed(file: str, ids: Ids, nodes: Numbered, lines: Sequence[int] = ()) -> tuple[Indices, Mask]:
    """Return indices of node numbers, and a mask of all nodes that has these; raises DeckError for undefined ones.

    `lines` are those of the numbers in the file, if it has lines.
    """
    where = nodes.indices(ids)
    if (lacking := where < 0).any():
        numbers = np.unique(ids[lacking]).tolist()
        noun, verb = ("node", "is") if len(numbers) == 1 else ("nodes", "are")
        message = f"{noun} {listed_numbers(numbers)} {verb} not defined in the deck"
        raise data_error(file, message, lines[int(np.argmax(lacking))] if lines else 1)
    present = np.zeros(len(nodes), dtype=np.bool_)
    present[where] = True
    return where, present


def _from_npy(path: Path, nodes: Numbered) -> Positions:
    """Return one array; of a series few steps are in memory. Raises OSError, or DeckError for any other content."""
    file = path.as_posix()
    try:
        with _from_old_python():
            mapped = np.lib.format.open_memmap(path, mode="r")  # reads the header only
            in_steps = mapped.ndim == 3 and mapped.dtype.kind == "f" and mapped.flags.c_contiguous
            array = mapped if in_steps else np.load(path, allow_pickle=False)
    except DAMAGED as error:
        raise data_error(file, f"not an NPY array: {error}") from error
    positions = _from_arrays(file, {"positions": _real(file, "positions", array)}, nodes, ordered=in_steps)
    return replace(positions, values=StepFile(path, mapped, _ranks(nodes))) if in_steps else positions


def _load_npz(path: Path) -> dict[str, Reals]:
    """Return an archive with `positions` and optional `node`, `time` and `velocities`. Raises OSError, DeckError."""
    file = path.as_posix()
    with path.open("rb") as stream:
        try:
            with _from_old_python(), zipfile.ZipFile(stream) as archive:
                names = [name.removesuffix(".npy") for name in archive.namelist()]
                if "positions" not in names:
                    raise data_error(file, f"no array named positions, only {', '.join(names) or 'nothing'}")
                if unknown := sorted(set(names) - _ARRAYS):
                    expected = ", ".join(sorted(_ARRAYS))
                    raise data_error(file, f"unknown arrays: {', '.join(unknown)}; expected {expected}")
                most = _DEFLATED * path.stat().st_size
                return {name: _real(file, name, _member(archive, name, most)) for name in names}
        except DeckError:
            raise
        except (*DAMAGED, OSError) as error:
            raise data_error(file, f"not an NPZ archive: {error}") from error


_DEFLATED = 1032
"""Largest number of bytes that a byte of a compressed file can give."""


def _member(archive: zipfile.ZipFile, name: str, most: int) -> NDArray[np.generic]:
    """Return an array; raises ValueError before memory is taken if it claims more bytes than there are.

    `most` is the number of bytes that a file of this size can hold: its own statements about its members may be false.
    """
    held = min(archive.getinfo(f"{name}.npy").file_size, most)
    with archive.open(f"{name}.npy") as stream:
        read_header = _HEADERS.get(np.lib.format.read_magic(stream))
        shape, _, kind = read_header(stream) if read_header else ((), False, np.dtype(np.float64))
        if (promised := prod(shape) * kind.itemsize) > held:
            raise ValueError(f"the array {name} of {promised} bytes has only {held} in the file")
    with archive.open(f"{name}.npy") as stream:
        return cast("NDArray[np.generic]", np.lib.format.read_array(stream, allow_pickle=False))


_HEADERS = {(1, 0): np.lib.format.read_array_header_1_0, (2, 0): np.lib.format.read_array_header_2_0}


@contextmanager
def _from_old_python() -> Iterator[None]:
    """Suppress the warning of numpy about a header written by Python 2, which a reader of the file cannot change."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        yield


def _ranks(nodes: Numbered) -> Indices | None:
    """Return the place of each node among the ascending numbers; None if they are in ascending order."""
    if not (nodes.ids[1:] <= nodes.ids[:-1]).any():
        return None
    return np.sort(nodes.ids).searchsorted(nodes.ids)


def _from_arrays(file: str, arrays: dict[str, Reals], nodes: Numbered, *, ordered: bool = False) -> Positions:
    """Return arrays (steps, nodes, 3) or (nodes, 3) in ascending order of the node numbers, or of the array `node`.

    With `ordered` they are left as they are.
    """
    ids = None
    if "node" in arrays:
        if arrays["node"].ndim != 1:
            raise _wrong_shape(file, "node", arrays["node"], "one axis")
        ids = whole_numbers("node", finite(file, "node", arrays["node"]), lambda _, why: data_error(file, why))
    positions = arrays["positions"]
    expected = len(nodes) if ids is None else len(ids)
    values = positions[np.newaxis] if positions.ndim == 2 else positions
    if values.ndim != 3 or values.shape[1:] != (expected, 3):
        raise _wrong_shape(file, "positions", positions, f"(steps, {expected}, 3) or ({expected}, 3)")
    if not len(values):
        raise data_error(file, "positions holds no time step")
    velocities = arrays.get("velocities")
    if velocities is not None:
        if velocities.shape != positions.shape:
            raise _wrong_shape(file, "velocities", velocities, str(positions.shape))
        velocities = velocities.reshape(values.shape)
    time = None if positions.ndim == 2 else np.arange(len(values), dtype=np.float64)
    if (given := arrays.get("time")) is not None:
        if given.shape != (len(values),) and not (given.shape == () and len(values) == 1):
            raise _wrong_shape(file, "time", given, f"({len(values)},)")
        time = finite(file, "time", given)
    present = np.full(len(nodes), ids is None)
    if ids is not None:
        where, present = _placed(file, ids, nodes)
        if int(present.sum()) != len(where):
            raise data_error(file, "a node is listed twice in the array node")
        values = _spread(values, where, len(nodes))
        velocities = None if velocities is None else _spread(velocities, where, len(nodes))
    elif not ordered and (ranks := _ranks(nodes)) is not None:
        values, velocities = values[:, ranks], None if velocities is None else velocities[:, ranks]
    return Positions(values, present, time, velocities, "time" in arrays, ids is not None)


def _wrong_shape(file: str, name: str, array: Reals, expected: str) -> DeckError:
    return data_error(file, f"{name} has the shape {array.shape}, expected {expected}")


def _real(file: str, name: str, array: NDArray[np.generic]) -> Reals:
    if array.dtype.kind not in "fiu":
        raise data_error(file, f"{name} holds {array.dtype}, expected numbers")
    return cast("Reals", array if array.dtype.kind == "f" else array.astype(np.float64))
