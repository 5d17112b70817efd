"""Where this program keeps what it can make again."""

from __future__ import annotations

import os
import sys
from pathlib import Path

PLACE = "MUDLINE_CACHE_DIR"
"""The variable that says where."""


def cache_folder() -> Path | None:
    """Return the folder: as the variable says, or the user's folder for caches on this system; None without one."""
    if given := os.environ.get(PLACE):
        return Path(given)
    given = os.environ.get("XDG_CACHE_HOME", "")
    if os.path.isabs(given):  # noqa: PTH117 - a text that may be empty
        return Path(given, "mudline")
    if sys.platform == "win32":
        local = os.environ.get("LOCALAPPDATA")
        return Path(local, "mudline", "Cache") if local else None
    try:
        home = Path.home()
    except RuntimeError:
        return None
    return home / ("Library/Caches" if sys.platform == "darwin" else ".cache") / "mudline"
