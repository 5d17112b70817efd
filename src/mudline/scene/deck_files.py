"""The files that a deck names, such as FILE=: looked for beside the deck."""

from __future__ import annotations

from pathlib import Path

_LONGEST = 4096


def file_name(written: str) -> str:
    """A file's name as a deck writes it, without quotes and with `/` between folders."""
    name = written.strip()
    if len(name) > 1 and name[0] == name[-1] == '"':
        name = name[1:-1]
    return name.replace("\\", "/")


def find_file(folder: Path | None, written: str) -> Path | None:
    """The regular file that a deck in `folder` names, or None when it is not there or may not be looked at.

    A name without a folder before it stands for a file beside the deck. A deck that came from no path (`folder` None)
    finds nothing.
    """
    name = file_name(written)
    if folder is None or not name or len(name) > _LONGEST or "\0" in name:
        return None
    path = folder / name
    try:
        return path if path.is_file() else None
    except OSError:
        return None
