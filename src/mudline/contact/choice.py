"""Whether steps are evaluated with numpy alone or by compiled loops; both give the same bits."""

from __future__ import annotations

import os
import platform
import sys
from contextlib import suppress
from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING, Literal

from mudline.contact.tables import Tables

if TYPE_CHECKING:
    from pathlib import Path

Backend = Literal["auto", "numpy", "fast"]

MOST_PARAMETERS = 6
"""Parameters of a normal law with an equation up to which there are compiled loops for it."""
_WORTH_LOADING = 2_000_000
"""Nodes times steps from which on compiled loops that are in the cache save what it takes to load them."""
_WORTH_COMPILING = 15_000_000
"""The same where they have to be compiled first."""


class Choice:
    """How a model evaluates its series.

    Attributes:
        threads: largest number of threads of compiled loops.
        uncovered: why there are no compiled loops for the laws; empty where there are.
    """

    def __init__(self, backend: Backend, threads: int | None, tables: Tables, *, flat: bool) -> None:
        if backend not in ("auto", "numpy", "fast"):
            raise ValueError(f"backend must be auto, numpy or fast, not {backend!r}")
        if backend == "fast":
            import_module("numba")
        if threads is not None and threads < 1:
            raise ValueError(f"threads must be 1 or more, not {threads}")
        self._backend, self._tables, self._flat = backend, tables, flat
        self.threads = threads or _processors()
        rich = [rows.law for rows in (*tables.normal, *tables.nodal) if len(rows.columns) > MOST_PARAMETERS]
        self.uncovered = f"the law {rich[0].name!r} has more than {MOST_PARAMETERS} parameters" if rich else ""

    def compiles(self, steps: int) -> bool:
        """Return whether a series of so many steps is for the compiled loops."""
        if self._backend == "numpy" or self.uncovered:
            return False
        if self._backend == "fast":
            return True
        total = steps * len(self._tables.given.node_ids)
        if total < _WORTH_LOADING or find_spec("numba") is None:
            return False
        return total >= _WORTH_COMPILING or self._marker_exists()

    def note_compiled(self) -> None:
        """Remember that the loops for these laws are in the cache of compiled code."""
        marker = self._marker()
        if marker is not None and not marker.exists():
            with suppress(OSError):  # the next process decides as if nothing were compiled
                marker.parent.mkdir(parents=True, exist_ok=True)
                marker.touch()

    def _marker_exists(self) -> bool:
        marker = self._marker()
        return marker is not None and marker.exists()

    def _marker(self) -> Path | None:
        """An empty file that stands for compiled loops; its name changes with all that they depend on."""
        # only long series ask, and most scenes do without
        import hashlib  # noqa: PLC0415
        from importlib import metadata  # noqa: PLC0415

        from mudline.cache_folder import cache_folder  # noqa: PLC0415
        from mudline.contact import kernels  # noqa: PLC0415 - loads all laws

        folder = cache_folder()
        if folder is None:
            return None
        laws = tuple(rows.law for rows in (*self._tables.normal, *self._tables.nodal))
        facts = (
            kernels.what_there_is(self._tables, flat=self._flat),
            [law.name for law in laws],
            kernels.edition(laws),
            metadata.version("numba"),
            sys.version,
            platform.machine(),
        )
        return folder / f"loops-{hashlib.sha256(repr(facts).encode()).hexdigest()[:24]}"


def _processors() -> int:
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
