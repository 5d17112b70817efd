"""Names of new files: what stands for a parameter in them, and what no file may be called."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable
from itertools import chain

from mudline.deck.parameters import folded

_PLACEHOLDER = re.compile(r"%([^%]+)%")
_FORBIDDEN = re.compile(r'[\x00-\x1f\x7f<>:"|?*]')
_DRIVE = re.compile(r"[A-Za-z]:")
_DEVICES = frozenset(
    ["CON", "PRN", "AUX", "NUL", "CONIN$", "CONOUT$"]
    + [device + number for device in ("COM", "LPT") for number in "123456789\u00b9\u00b2\u00b3"]
)
LONGEST_PART = 240
"""Bytes of a folder's or a file's name; the systems in use end at 255."""
LONGEST_PATH = 1000
"""Bytes of a path within the output folder."""


def unquoted(text: str) -> str:
    """A text without the double quotes around it."""
    return text[1:-1] if len(text) > 1 and text[0] == text[-1] == '"' else text


def name_key(name: str) -> str:
    """The name of a variation as names compare."""
    return folded(" ".join(unquoted(name).split()))


def placeholders(template: str) -> list[str]:
    """The names between `%` in a template, in their order."""
    return [match[1].strip(" \t") for match in _PLACEHOLDER.finditer(template)]


def filled(template: str, value_of: Callable[[str], str]) -> str:
    """A template with every `%name%` replaced by what `value_of` says of the name."""
    return _PLACEHOLDER.sub(lambda match: value_of(match[1].strip(" \t")), template)


def path_fault(path: str) -> str:
    """Why a path may not be used within the output folder, on any system; "" when it may."""
    if "\\" in path:
        return "holds a backslash: folders are parted by /"
    if path.startswith("/") or _DRIVE.match(path):
        return "is absolute: it would leave the output folder"
    if len(path.encode(errors="replace")) > LONGEST_PATH:
        return f"is longer than {LONGEST_PATH} bytes"
    return next((fault for part in path.split("/") if (fault := _part_fault(part))), "")


def _part_fault(part: str) -> str:
    """Why a folder or a file may not have this name."""
    device = part.partition(".")[0].strip(" ")
    sign = next(iter(_FORBIDDEN.findall(part)), "")
    shown = sign if sign.isprintable() else f"U+{ord(sign):04X}"
    faults = {
        "leads out of the output folder with ..": part == "..",
        "has a part without a name": not part.strip(" ."),
        f"holds {shown}, which not every system has in names of files": bool(sign),
        "has a part that ends with a blank or a dot, which some systems drop": part.endswith((" ", ".")),
        f"has the part {device}, which is a device on some systems": device.upper() in _DEVICES,
        f"has a part that is longer than {LONGEST_PART} bytes": len(part.encode(errors="replace")) > LONGEST_PART,
    }
    return next((fault for fault, found in faults.items() if found), "")


def same_place(path: str) -> str:
    """What two paths share that some systems take for one: case and the composition of letters do not count."""
    return unicodedata.normalize("NFC", unicodedata.normalize("NFC", path).casefold())


class Taken:
    """The paths that are taken so far, each with who took it."""

    def __init__(self) -> None:
        self._files: dict[str, int] = {}
        self._folders: dict[str, int] = {}

    def take(self, path: str, number: int) -> int | None:
        """Take a path for a number; the number that has it, or needs it as a folder, when it is not free."""
        place = same_place(path)
        parts = place.split("/")
        folders = ["/".join(parts[:length]) for length in range(1, len(parts))]
        holders = chain((self._files.get(name) for name in (place, *folders)), [self._folders.get(place)])
        holder = next((one for one in holders if one is not None), None)
        if holder is None:
            self._files[place] = number
            for folder in folders:
                self._folders.setdefault(folder, number)
        return holder
