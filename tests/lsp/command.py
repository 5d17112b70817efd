"""The command that starts a server; under a measurement of coverage, its lines count too."""

from __future__ import annotations

import sys


def server_command() -> list[str]:
    """The words of the command."""
    coverage = sys.modules.get("coverage")
    measured = coverage is not None and coverage.Coverage.current() is not None
    run = ["coverage", "run", "--parallel-mode", "-m"] if measured else []
    return [sys.executable, "-m", *run, "mudline", "lsp"]
