"""NPZ archives: their arrays by name, every fault of the bytes as a fault of the file."""

from __future__ import annotations

import tokenize
import warnings
import zipfile
import zlib
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import cast

import numpy as np
from numpy.typing import NDArray

from mudline.diagnostics import DeckError
from mudline.scene.csv_file import data_error

UNREADABLE = (
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


def read_npz(path: Path, chosen: Callable[[list[str]], Iterable[str]]) -> dict[str, NDArray[np.generic]]:
    """The arrays that are chosen among the names of all. Raises OSError, DeckError."""
    with path.open("rb") as stream:
        try:
            with from_old_python(), zipfile.ZipFile(stream) as archive:
                names = [name.removesuffix(".npy") for name in archive.namelist()]
                return {name: _member(archive, name) for name in chosen(names)}
        except DeckError:
            raise
        except (*UNREADABLE, OSError) as error:
            raise data_error(path.as_posix(), f"not an NPZ archive: {error}") from error


@contextmanager
def from_old_python() -> Iterator[None]:
    """Without the warning of numpy that Python 2 spelled the header, which the file's reader cannot help."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        yield


def _member(archive: zipfile.ZipFile, name: str) -> NDArray[np.generic]:
    with archive.open(f"{name}.npy") as stream:
        return cast("NDArray[np.generic]", np.lib.format.read_array(stream, allow_pickle=False))
