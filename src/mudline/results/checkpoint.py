"""The state of an unfinished run over a long series, in a file: taken up by a later run of the same deck and positions.

It holds what the run was about, how many steps are done, what was kept of them, and the state behind them.
"""

from __future__ import annotations

import io
import json
import os
from collections.abc import Mapping
from contextlib import suppress
from hashlib import blake2b
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mudline.files import write_atomically
from mudline.scene.npz_file import UNREADABLE

Arrays = Mapping[str, NDArray[Any]]
About = Mapping[str, str]
"""On what the results depend, in words for messages, each with a digest of it."""

_FORMAT = "mudline-run/1"
_DIGEST = 20
_SAMPLES, _SAMPLE = 64, 1 << 16
"""Pieces of a large file that its digest looks at, and the bytes of each."""


class CheckpointError(ValueError):
    """A file that is not the state of this run; the text says why."""


class Reached(NamedTuple):
    """How far a run was: the steps done, what was kept of them, and the arrays of the state behind them."""

    done: int
    kept: Arrays
    state: Arrays


class FileMark(NamedTuple):
    """The size of a file and when it was changed last."""

    size: int
    changed: int

    @classmethod
    def of(cls, path: str) -> FileMark:
        """The mark of a file as it is now. Raises OSError."""
        found = os.stat(path)  # noqa: PTH116 - asked for after every few steps
        return cls(found.st_size, found.st_mtime_ns)


def sampled_digest(path: Path) -> str:
    """A digest of the size, the date and evenly spaced pieces of a file, the first and the last among them.

    Raises OSError.
    """
    mark = FileMark.of(str(path))
    digest = blake2b(repr(tuple(mark)).encode(), digest_size=_DIGEST)
    with path.open("rb", buffering=0) as stream:
        for place in np.linspace(0, max(mark.size - _SAMPLE, 0), _SAMPLES).astype(np.int64).tolist():
            stream.seek(place)
            digest.update(stream.read(_SAMPLE))
    return digest.hexdigest()


class Checkpoint:
    """The file of an unfinished run beside its output."""

    def __init__(self, output: Path, about: About) -> None:
        self.path = output.with_name(f"{output.name}.unfinished")
        self._about = dict(about)

    def read(self) -> Reached | None:
        """How far the run was; None without a file. Raises OSError, CheckpointError for another run and for damage."""
        try:
            data = self.path.read_bytes()
        except FileNotFoundError:
            return None
        line, _, packed = data.partition(b"\n")
        try:
            head = json.loads(line)
            found, done, digest = dict(head["about"]), int(head["done"]), head["digest"]
            if head["format"] != _FORMAT or digest != _digest(packed):
                raise ValueError(head["format"])
            with np.load(io.BytesIO(packed), allow_pickle=False) as arrays:
                kept, state = (_below(arrays, part) for part in ("kept/", "state/"))
        except (*UNREADABLE, TypeError) as error:
            raise CheckpointError("is damaged, or not the state of an unfinished run") from error
        if found != self._about:
            names = [name for name in self._about if found.get(name) != self._about[name]]
            changed = f"{' and '.join(names)} changed" if names else "it depends on other files"
            raise CheckpointError(f"is the state of another run: {changed}")
        return Reached(done, kept, state)

    def write(self, reached: Reached) -> None:
        """Replace the file in one step. Raises OSError."""
        packed = io.BytesIO()
        parts = (("kept/", reached.kept), ("state/", reached.state))
        named = {part + name: array for part, arrays in parts for name, array in arrays.items()}
        np.savez(packed, **named)  # type: ignore[arg-type] # no array is called allow_pickle
        data = packed.getvalue()
        head = {"format": _FORMAT, "about": self._about, "done": reached.done, "digest": _digest(data)}
        write_atomically(self.path, [json.dumps(head).encode(), b"\n", data])

    def remove(self) -> None:
        """Remove the file: the run is finished, or begins again."""
        with suppress(FileNotFoundError):
            self.path.unlink()


def _digest(data: bytes) -> str:
    return blake2b(data, digest_size=_DIGEST).hexdigest()


def _below(arrays: Mapping[str, NDArray[Any]], part: str) -> dict[str, NDArray[Any]]:
    return {name.removeprefix(part): arrays[name] for name in arrays if name.startswith(part)}
