"""What is installed beside mudline, and what installs more of it: the extras.

The folders on Python's path show it without their packages being read.
"""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Iterator
from contextlib import suppress
from importlib.machinery import PathFinder
from itertools import takewhile

_METADATA = (".dist-info", ".egg-info")


def install_hint(extra: str) -> str:
    """Return the command that installs an extra, in the quotes that every shell takes: cmd.exe keeps single ones."""
    return f'python -m pip install "mudline[{extra}]"'


def metadata_folders() -> Iterator[str]:
    """The folders with what is known of each package; those inside archives are left out."""
    for place in dict.fromkeys(sys.path):
        with suppress(OSError), os.scandir(place or ".") as entries:
            yield from [f"{place or '.'}/{entry.name}" for entry in entries if entry.name.lower().endswith(_METADATA)]


def may_declare(group: str) -> bool:
    """Whether a package may have entry points of a group.

    False is certain. To read the entry points of all packages takes longer than to look for one word in them, and most
    people have no such package.
    """
    if any(hasattr(finder, "find_distributions") for finder in sys.meta_path if finder is not PathFinder):
        return True
    if any(place.lower().endswith(".egg") or os.path.isfile(place) for place in sys.path):  # noqa: PTH113 - see above
        return True
    return any(group.encode() in _entry_points(folder) for folder in metadata_folders())


def _entry_points(folder: str) -> bytes:
    try:
        with open(f"{folder}/entry_points.txt", "rb") as stream:  # noqa: PTH123 - see above
            return stream.read()
    except OSError:
        return b""


def project_addresses(name: str) -> dict[str, str]:
    """The addresses that an installed package names, by their labels in lower case; empty where it is not found.

    Its metadata are read as far as the description: the library for all of them takes as long to import as to print
    what is remembered.
    """
    wanted = _normal(name)
    for folder in metadata_folders():
        if _normal(os.path.basename(folder).partition("-")[0].removesuffix(".egg")) != wanted:  # noqa: PTH119 - hundreds
            continue
        for file in ("METADATA", "PKG-INFO"):
            with suppress(OSError, UnicodeDecodeError), open(f"{folder}/{file}", encoding="utf-8") as stream:  # noqa: PTH123 - see above
                lines = takewhile(str.strip, stream)
                given = [line.partition(":")[2].partition(",") for line in lines if line.startswith("Project-URL:")]
                return {label.strip().lower(): address.strip() for label, _, address in given}
    return {}


def _normal(name: str) -> str:
    """The name of a package as those that mean the same one are compared."""
    return re.sub("[-_.]+", "-", name).lower()
