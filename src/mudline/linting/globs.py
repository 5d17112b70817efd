"""Patterns of paths, matched as in a .gitignore beside the configuration file."""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import cache
from pathlib import PurePosixPath


def matches(path: str, patterns: Iterable[str]) -> bool:
    """Whether a relative path with `/`, or a folder above it, fits a pattern.

    `*` and `?` stop at a `/`, `**` does not. A pattern with a `/` before its end holds from the folder of the
    configuration, any other one at any depth; one that ends with `/` means folders only.
    """
    parents = [parent.as_posix() for parent in PurePosixPath(path).parents][:-1]
    return any(
        any(_expression(pattern).fullmatch(parent) for parent in parents)
        or (not pattern.endswith("/") and _expression(pattern).fullmatch(path) is not None)
        for pattern in patterns
    )


@cache
def _expression(pattern: str) -> re.Pattern[str]:
    body = pattern.rstrip("/")
    anchored = "/" in body
    pieces = re.split(r"(\*\*/|\*\*|\*|\?)", body.removeprefix("/"))
    known = {"**/": "(?:[^/]+/)*+", "**": ".*", "*": "[^/]*", "?": "[^/]"}
    written = "".join(known.get(piece, re.escape(piece)) for piece in pieces)
    return re.compile(written if anchored else f"(?:.*/)?{written}", re.DOTALL)
