"""The command line, a module for each command; and its exit codes."""

from __future__ import annotations

DONE = 0
FOUND = 1
"""Findings, or a deck that is illegal or cannot be processed."""
WRONG_USAGE = 2
"""Wrong usage, or a path that cannot be read or written."""
INTERRUPTED = 130
CLOSED_PIPE = 141
