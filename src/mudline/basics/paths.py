"""Paths as displayed and recorded: relative to a folder and with `/`, also across Windows drives."""

from __future__ import annotations

import os


def relative_path(path: str | os.PathLike[str], folder: str | os.PathLike[str] = os.curdir) -> str:
    """Return a path as seen from a folder, with `/`; the absolute path where the folder is on another drive."""
    try:
        seen = os.path.relpath(path, folder)
    except ValueError:
        seen = os.path.abspath(path)  # noqa: PTH100 - links stay what they are called
    return os.fspath(seen).replace(os.sep, "/")
