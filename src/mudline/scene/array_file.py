"""NPY and NPZ files of positions."""

from __future__ import annotations

import tokenize
import warnings
import zipfile
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple, cast

import numpy as np
from numpy.typing import NDArray

from mudline.diagnostics import DeckError
from mudline.scene.csv_file import data_error, finite, whole_numbers
from mudline.scene.numbering import Floats, Ids

Reals = NDArray[np.floating]

_ARRAYS = frozenset({"positions", "node", "time", "velocities"})
_UNREADABLE = (
    # damaged bytes meet the checks of numpy, of zipfile and of the parser of the header
    ValueError,
    EOFError,
    KeyError,
    MemoryError,
    NotImplementedError,
    OverflowError,
    RuntimeError,
    SyntaxError,
    tokenize.TokenError,
    zipfile.BadZipFile,
    zlib.error,
)


class Series(NamedTuple):
    """Positions (steps, nodes, 3); `time` (steps,) is None for a single state, `nodes` for all nodes of the deck.

    `timed` says whether the file has times; where it has none, `time` counts the steps of a series.
    """

    values: Reals
    time: Floats | None
    velocities: Reals | None = None
    nodes: Ids | None = None
    timed: bool = False


def load_npy(path: Path, count: int) -> Series:
    """An array (steps, count, 3) or (count, 3), memory-mapped. Raises OSError, or DeckError for anything else."""
    file = path.as_posix()
    try:
        with _from_old_python():
            values = np.lib.format.open_memmap(path, mode="r")
    except _UNREADABLE as error:
        raise data_error(file, f"no NPY array: {error}") from error
    return _series(file, {"positions": _real(file, "positions", values)}, count)


def load_npz(path: Path, count: int) -> Series:
    """An archive with `positions` and, if wanted, `node`, `time` and `velocities`. Raises OSError, DeckError."""
    file = path.as_posix()
    with path.open("rb") as stream:
        try:
            with _from_old_python(), zipfile.ZipFile(stream) as archive:
                names = [name.removesuffix(".npy") for name in archive.namelist()]
                _check_names(file, names)
                arrays = {name: _real(file, name, _member(archive, name)) for name in names}
        except DeckError:
            raise
        except (*_UNREADABLE, OSError) as error:
            raise data_error(file, f"no NPZ archive: {error}") from error
    return _series(file, arrays, count)


@contextmanager
def _from_old_python() -> Iterator[None]:
    """Without the warning of numpy that Python 2 spelled the header, which the file's reader cannot help."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        yield


def _check_names(file: str, names: list[str]) -> None:
    if "positions" not in names:
        raise data_error(file, f"no array named positions, only {', '.join(names) or 'nothing'}")
    if unknown := sorted(set(names) - _ARRAYS):
        raise data_error(file, f"unknown arrays: {', '.join(unknown)}; expected {', '.join(sorted(_ARRAYS))}")


def _member(archive: zipfile.ZipFile, name: str) -> NDArray[np.generic]:
    with archive.open(f"{name}.npy") as stream:
        return cast("NDArray[np.generic]", np.lib.format.read_array(stream, allow_pickle=False))


def _series(file: str, arrays: dict[str, Reals], count: int) -> Series:
    nodes = whole_numbers(file, "node", finite(file, "node", arrays["node"])) if "node" in arrays else None
    given = arrays["positions"]
    expected = count if nodes is None else len(nodes)
    values = given[np.newaxis] if given.ndim == 2 else given
    if values.ndim != 3 or values.shape[1:] != (expected, 3):
        raise _wrong_shape(file, "positions", given, f"(steps, {expected}, 3) or ({expected}, 3)")
    if not len(values):
        raise data_error(file, "positions holds no time step")
    velocities = arrays.get("velocities")
    if velocities is not None and velocities.shape != given.shape:
        raise _wrong_shape(file, "velocities", velocities, str(given.shape))
    if "time" in arrays:
        time: Floats | None = finite(file, "time", arrays["time"])
    else:
        time = None if given.ndim == 2 else np.arange(len(values), dtype=np.float64)
    if time is not None and len(time) != len(values):
        raise _wrong_shape(file, "time", arrays["time"], f"({len(values)},)")
    moving = None if velocities is None else velocities.reshape(values.shape)
    return Series(values, time, moving, nodes, "time" in arrays)


def _wrong_shape(file: str, name: str, found: Reals, expected: str) -> DeckError:
    return data_error(file, f"{name} has the shape {found.shape}, expected {expected}")


def _real(file: str, name: str, array: NDArray[np.generic]) -> Reals:
    if array.dtype.kind not in "fiu":
        raise data_error(file, f"{name} holds {array.dtype}, expected numbers")
    return cast("Reals", array if array.dtype.kind == "f" else array.astype(np.float64))
