"""`mudline` and `python -m mudline`."""

from __future__ import annotations

import atexit
import gc
import os
import sys
from collections.abc import Sequence

from mudline.basics.version import __version__
from mudline.cli import INTERRUPTED

_COLLECTION = (5_000_000, 10, 10)
"""Objects between two collections, and collections between two of older ones.

What a deck is read into has no cycles and is freed with it: a run of many decks leaves some ten objects of each to the
collector. By default a third of the time of a deck of many entries goes into looking for cycles.
"""

_THREADS = "OPENBLAS_NUM_THREADS"
"""No command multiplies large matrices: threads for that would take as long to start as numpy, and forbid to fork."""

_PLUGINS = "PYDANTIC_DISABLE_PLUGINS"
"""No command is for those who watch what pydantic does: to look for their plugins reads of every installed package."""


class Ended(KeyboardInterrupt):
    """The system ends the program, by `kill`, at a shutdown, or because its terminal is closed; it cleans up first."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.code = 128 + number


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command line and return its exit code. The version is printed before anything else is imported."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    if given == ["--version"] and _printed(f"mudline {__version__}\n"):
        return 0
    gc.set_threshold(*_COLLECTION)
    atexit.register(_leave)
    os.environ.setdefault(_THREADS, "1")
    os.environ.setdefault(_PLUGINS, "__all__")
    try:
        _take_signals()
        from mudline.cli.main import run

        return run(given)
    except Ended as ended:
        return ended.code
    except KeyboardInterrupt:
        return INTERRUPTED


def _take_signals() -> None:
    """Raise Ended for SIGTERM and SIGHUP from now on; what was ignored before, as by nohup, stays so."""
    import signal
    import threading

    def end(number: int, _: object) -> None:
        raise Ended(number)

    if threading.current_thread() is threading.main_thread():
        for name in ("SIGTERM", "SIGHUP"):
            number = getattr(signal, name, None)
            if number is not None and signal.getsignal(number) is signal.SIG_DFL:
                signal.signal(number, end)


def _leave() -> None:
    """Keep Python from looking twice, as it ends, for cycles in all that was imported.

    That takes as long as to import pydantic, and finds nothing. DuckDB complains of what is not looked at.
    """
    if "_duckdb" not in sys.modules:
        gc.freeze()


def _printed(text: str) -> bool:
    """Whether standard output takes a text; if not, `run` tries again, and says what is wrong."""
    if sys.stdout is None:
        return False
    try:
        sys.stdout.write(text)
        sys.stdout.flush()
    except OSError:
        return False
    return True


if __name__ == "__main__":
    sys.exit(main())
