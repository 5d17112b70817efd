"""Command line: a module for each command, and the exit codes."""

from __future__ import annotations

DONE = 0
FOUND = 1
"""Exit code for findings, or for a deck that is illegal or cannot be processed."""
WRONG_USAGE = 2
"""Exit code for wrong usage, or a path that cannot be read or written."""
INTERRUPTED = 130
CLOSED_PIPE = 141
