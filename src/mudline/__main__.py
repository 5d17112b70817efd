"""`mudline` and `python -m mudline`."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from mudline import __version__
from mudline.cli.exits import INTERRUPTED


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command line and return its exit code. The version is told before anything else is imported."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    if given == ["--version"]:
        sys.stdout.write(f"mudline {__version__}\n")
        return 0
    try:
        from mudline.cli.main import run

        return run(given)
    except KeyboardInterrupt:
        return INTERRUPTED


if __name__ == "__main__":
    sys.exit(main())
