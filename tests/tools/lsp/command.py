"""The command that starts a server; under a measurement of coverage, its lines count too."""

from __future__ import annotations

import sys

from tests.helpers.tracing import is_measured


def server_command() -> list[str]:
    """The words of the command."""
    run = ["coverage", "run", "--parallel-mode", "-m"] if is_measured() else []
    return [sys.executable, "-m", *run, "mudline", "lsp"]
