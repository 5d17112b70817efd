"""Exit codes of the contract."""

from __future__ import annotations

DONE = 0
FOUND = 1
WRONG_USAGE = 2
INTERRUPTED = 130
CLOSED_PIPE = 141
