"""Entry point of `mudline` and `python -m mudline`."""

from __future__ import annotations

import atexit
import gc
import os
import sys
from collections.abc import Sequence

from mudline.basics.version import __version__
from mudline.cli import INTERRUPTED

_COLLECTION = (5_000_000, 10, 10)
"""Objects between two garbage collections, and collections between two of older generations.

A deck that was read has no cycles and is freed with its last reference. By default a third of the time of a deck with
many entries goes into searching for cycles.
"""

_THREADS = "OPENBLAS_NUM_THREADS"
"""Variable that limits threads: no command multiplies large matrices, and threads are slow to start and prevent forks.
"""

_PLUGINS = "PYDANTIC_DISABLE_PLUGINS"
"""Variable that disables pydantic's plugins: searching for them reads files of every installed package."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command line and return its exit code. The version is printed before anything else is imported."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    if given == ["--version"] and sys.stdout is not None:
        try:
            sys.stdout.write(f"mudline {__version__}\n")
            sys.stdout.flush()
        except OSError:
            pass  # `run` tries again, and reports it
        else:
            return 0
    gc.set_threshold(*_COLLECTION)
    atexit.register(_leave)
    os.environ.setdefault(_THREADS, "1")
    os.environ.setdefault(_PLUGINS, "__all__")
    try:
        _take_signals()
        from mudline.cli.main import run

        return run(given)
    except KeyboardInterrupt as ended:  # by Ctrl-C without a number, by the system with that of its signal
        return 128 + ended.args[0] if ended.args else INTERRUPTED


def _take_signals() -> None:
    """Clean up and end for SIGTERM (`kill`, shutdown) and SIGHUP (closed terminal) from now on, as for Ctrl-C.

    A signal ignored before, as by nohup, remains ignored.
    """
    import signal
    import threading

    def end(number: int, _: object) -> None:
        raise KeyboardInterrupt(number)

    if threading.current_thread() is threading.main_thread():
        for name in ("SIGTERM", "SIGHUP"):
            number = getattr(signal, name, None)
            if number is not None and signal.getsignal(number) is signal.SIG_DFL:
                signal.signal(number, end)


def _leave() -> None:
    """Prevent Python from searching imported modules for cycles as it exits.

    The search takes as long as the import of pydantic and finds nothing. DuckDB complains about objects left out.
    """
    if "_duckdb" not in sys.modules:
        gc.freeze()


if __name__ == "__main__":
    sys.exit(main())
