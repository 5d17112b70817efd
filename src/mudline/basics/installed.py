"""Installed packages next to mudline, and the commands that install its extras.

The folders on Python's path are listed; the packages are not imported.
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
    """Return the command that installs an extra, in double quotes, which every shell accepts."""
    return f'python -m pip install "mudline[{extra}]"'


def metadata_folders() -> Iterator[str]:
    """Yield the metadata folder of each installed package; those inside archives are left out."""
    for place in dict.fromkeys(sys.path):
        with suppress(OSError), os.scandir(place or ".") as entries:
            yield from [f"{place or '.'}/{entry.name}" for entry in entries if entry.name.lower().endswith(_METADATA)]


def may_declare(group: str) -> bool:
    """Return False if no installed package has entry points of a group; True means that one may.

    Most people have no such package, and searching the files for one word is quicker than reading all entry points.
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
    """Return the addresses that an installed package gives, by their labels in lower case; empty if not installed.

    Its metadata are read up to the description, without importlib.metadata, whose import takes too long.
    """
    normal_name = _normal(name)
    for folder in metadata_folders():
        if _normal(os.path.basename(folder).partition("-")[0].removesuffix(".egg")) != normal_name:  # noqa: PTH119 - hundreds
            continue
        for file in ("METADATA", "PKG-INFO"):
            with suppress(OSError, UnicodeDecodeError), open(f"{folder}/{file}", encoding="utf-8") as stream:  # noqa: PTH123 - see above
                lines = takewhile(str.strip, stream)
                urls = [line.partition(":")[2].partition(",") for line in lines if line.startswith("Project-URL:")]
                return {label.strip().lower(): address.strip() for label, _, address in urls}
    return {}


def _normal(name: str) -> str:
    """Return a package name in the normal form of PEP 503, for comparison."""
    return re.sub("[-_.]+", "-", name).lower()
