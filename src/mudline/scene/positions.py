"""Positions of nodes from a file: one state or a time series."""

from __future__ import annotations

import zipfile
from dataclasses import dataclass
from pathlib import Path
from typing import cast

import numpy as np
from numpy.typing import NDArray

from mudline.diagnostics import DeckError
from mudline.scene.csv_file import data_error, read_numeric_csv
from mudline.scene.numbering import Floats, Ids, Numbered

_AXES = ("x", "y", "z")
_VELOCITIES = ("vx", "vy", "vz")
_MOST_NAMED = 10


@dataclass(frozen=True, slots=True)
class Positions:
    """Positions (steps, nodes, 3) in the order of the scene's nodes.

    `present` (nodes,) says which nodes the file has; `time` (steps,) is None for a single state without a time.
    """

    values: NDArray[np.floating]
    present: NDArray[np.bool_]
    time: Floats | None
    velocities: NDArray[np.floating] | None = None

    @property
    def steps(self) -> int:
        """Number of time steps."""
        return len(self.values)

    @property
    def missing(self) -> int:
        """Number of nodes without a position."""
        return int((~self.present).sum())


def read_positions(path: Path, nodes: Numbered) -> Positions:
    """Positions from CSV (`[time,]node,x,y,z[,vx,vy,vz]`), NPZ or NPY by the file's suffix.

    Raises OSError, or DeckError for a file with faults: nodes that the deck lacks, numbers that are none, steps with
    different nodes.
    """
    suffix = path.suffix.lower()
    if suffix == ".npz":
        return _from_npz(path, nodes)
    if suffix == ".npy":
        return _whole(path, _load_npy(path), nodes, None, None)
    return _from_csv(path, nodes)


def _from_csv(path: Path, nodes: Numbered) -> Positions:
    known = ("time", "node", *_AXES, *_VELOCITIES)
    columns = read_numeric_csv(path, ("node", *_AXES), known)
    if not len(columns["node"]):
        raise data_error(path.as_posix(), "no row below the header", 2)
    if len({name in columns for name in _VELOCITIES}) > 1:
        raise data_error(path.as_posix(), "velocities need all of vx, vy and vz")
    ids = _node_numbers(path, columns["node"])
    times, step = np.unique(columns.get("time", np.zeros(len(ids))), return_inverse=True)
    given, index = np.unique(ids, return_inverse=True)
    where = _known(path, given, nodes)
    _complete(path, step * len(given) + index, len(times), given, times)
    values = _scatter(columns, _AXES, (len(times), len(nodes)), step, where[index])
    moving = "vx" in columns
    velocities = _scatter(columns, _VELOCITIES, (len(times), len(nodes)), step, where[index]) if moving else None
    present = np.zeros(len(nodes), dtype=bool)
    present[where] = True
    return Positions(values, present, times if "time" in columns else None, velocities)


def _node_numbers(path: Path, column: Floats) -> Ids:
    broken = np.flatnonzero(column != np.floor(column))
    if broken.size:
        message = f"{column[broken[0]]!r} is no node number"
        raise data_error(path.as_posix(), message, int(broken[0]) + 2)
    return column.astype(np.int64)


def _known(path: Path, given: Ids, nodes: Numbered) -> NDArray[np.intp]:
    """Indices of the nodes of the file; those that the deck lacks are named."""
    where = nodes.indices(given)
    unknown = given[where < 0].tolist()
    if unknown:
        named = ", ".join(str(node) for node in unknown[:_MOST_NAMED])
        more = f" and {len(unknown) - _MOST_NAMED} more" if len(unknown) > _MOST_NAMED else ""
        noun = "node" if len(unknown) == 1 else "nodes"
        raise data_error(path.as_posix(), f"{noun} {named}{more} not defined in the deck")
    return where


def _complete(path: Path, cells: NDArray[np.intp], steps: int, given: Ids, times: Floats) -> None:
    """Every step must hold every node of the file once."""
    counts = np.bincount(cells, minlength=steps * len(given))
    wrong = np.flatnonzero(counts != 1)
    if not wrong.size:
        return
    step, index = divmod(int(wrong[0]), len(given))
    at = f" at time {times[step]!r}" if steps > 1 else ""
    problem = "is missing" if counts[wrong[0]] == 0 else "is given twice"
    line = 1 if counts[wrong[0]] == 0 else int(np.flatnonzero(cells == wrong[0])[1]) + 2
    raise data_error(path.as_posix(), f"node {given[index]} {problem}{at}", line)


def _scatter(
    columns: dict[str, Floats],
    names: tuple[str, ...],
    shape: tuple[int, int],
    step: NDArray[np.intp],
    node: NDArray[np.intp],
) -> Floats:
    values = np.full((*shape, 3), np.nan)
    for axis, name in enumerate(names):
        values[step, node, axis] = columns[name]
    return values


def _load_npy(path: Path) -> NDArray[np.floating]:
    try:
        values = np.load(path, mmap_mode="r", allow_pickle=False)
    except (ValueError, EOFError) as error:
        raise data_error(path.as_posix(), f"no NPY array: {error}") from error
    return _real(path, values, "the array")


def _from_npz(path: Path, nodes: Numbered) -> Positions:
    arrays: dict[str, NDArray[np.generic]] = {}
    try:
        with np.load(path, allow_pickle=False) as archive:
            arrays = {name: archive[name] for name in archive.files}
    except (ValueError, EOFError, AttributeError, zipfile.BadZipFile) as error:
        raise data_error(path.as_posix(), f"no NPZ archive: {error}") from error
    if "positions" not in arrays:
        raise data_error(path.as_posix(), f"no array named positions, only {', '.join(arrays) or 'nothing'}")
    if unknown := set(arrays) - {"positions", "node", "time", "velocities"}:
        raise data_error(path.as_posix(), f"unknown arrays: {', '.join(sorted(unknown))}")
    values = _real(path, arrays["positions"], "positions")
    time = _real(path, arrays["time"], "time").astype(np.float64).ravel() if "time" in arrays else None
    velocities = _real(path, arrays["velocities"], "velocities") if "velocities" in arrays else None
    if "node" not in arrays:
        return _whole(path, values, nodes, time, velocities)
    given = _node_numbers(path, _real(path, arrays["node"], "node").astype(np.float64).ravel())
    values, time, velocities = _shaped(path, values, len(given), time, velocities)
    where = _known(path, given, nodes)
    present = np.zeros(len(nodes), dtype=bool)
    present[where] = True
    if int(present.sum()) != len(given):
        raise data_error(path.as_posix(), "a node stands twice in the array node")
    moving = None if velocities is None else _spread(velocities, where, len(nodes))
    return Positions(_spread(values, where, len(nodes)), present, time, moving)


def _spread(values: NDArray[np.floating], where: NDArray[np.intp], count: int) -> NDArray[np.floating]:
    """Rows of some nodes among rows of all."""
    spread = np.full((len(values), count, 3), np.nan)
    spread[:, where] = values
    return spread


def _whole(
    path: Path,
    values: NDArray[np.floating],
    nodes: Numbered,
    time: Floats | None,
    velocities: NDArray[np.floating] | None,
) -> Positions:
    """Positions of all nodes, in the order of the deck."""
    values, time, velocities = _shaped(path, values, len(nodes), time, velocities)
    return Positions(values, np.ones(len(nodes), dtype=bool), time, velocities)


def _shaped(
    path: Path,
    values: NDArray[np.floating],
    count: int,
    time: Floats | None,
    velocities: NDArray[np.floating] | None,
) -> tuple[NDArray[np.floating], Floats | None, NDArray[np.floating] | None]:
    series = values[np.newaxis] if values.ndim == 2 else values
    if series.ndim != 3 or series.shape[1:] != (count, 3):
        raise _wrong_shape(path, "positions", values.shape, f"(steps, {count}, 3) or ({count}, 3)")
    if time is None and values.ndim == 3:
        time = np.arange(len(series), dtype=np.float64)
    if time is not None and len(time) != len(series):
        raise _wrong_shape(path, "time", time.shape, f"({len(series)},)")
    if velocities is not None and velocities.shape != values.shape:
        raise _wrong_shape(path, "velocities", velocities.shape, str(values.shape))
    if velocities is not None and velocities.ndim == 2:
        velocities = velocities[np.newaxis]
    return series, time, velocities


def _wrong_shape(path: Path, name: str, found: tuple[int, ...], expected: str) -> DeckError:
    return data_error(path.as_posix(), f"{name} has the shape {found}, expected {expected}")


def _real(path: Path, array: NDArray[np.generic], name: str) -> NDArray[np.floating]:
    if array.dtype.kind not in "fiu":
        raise data_error(path.as_posix(), f"{name} holds {array.dtype}, expected numbers")
    return cast("NDArray[np.floating]", array if array.dtype.kind == "f" else array.astype(np.float64))
