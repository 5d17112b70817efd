"""Decks in folders: files that are decks by their names or contents, without what a .gitignore hides."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path, PurePath
from stat import S_ISREG
from typing import NamedTuple

from mudline.basics.patterns import PathPattern, read_pattern
from mudline.language.deck import MARK
from mudline.language.deck.forms import SUFFIXES, form_of
from mudline.language.syntax.source import KEY_FILE

_HEAD = 4096
"""Bytes at the beginning of a JSON or YAML file that name its format."""


def is_deck(path: str) -> bool:
    """Whether the suffix is one of a deck."""
    return os.path.splitext(path)[1].lower() in SUFFIXES  # noqa: PTH122 - asked for each of many files


def is_document(path: str) -> bool:
    """Whether a file is a deck in JSON or YAML, by the format that its beginning names.

    One that cannot be opened is taken for it, and reported when it is read.
    """
    if is_deck(path) or form_of(path) == "keyword" or not may_be_file(path):
        return False
    try:
        with Path(path).open("rb") as stream:
            return MARK.encode() in stream.read(_HEAD)
    except OSError:
        return True


def is_in_any_form(path: str) -> bool:
    """Whether a file is a deck by its suffix or its content."""
    return is_deck(path) or is_document(path)


def is_key_file(path: str) -> bool:
    """Whether a `.keyx` file is a key of a password manager: these have the same suffix."""
    if not path.lower().endswith(".keyx"):
        return False
    try:
        with Path(path).open("rb") as stream:
            return KEY_FILE.match(stream.read(_HEAD).decode("latin-1").removeprefix("\xef\xbb\xbf")) is not None
    except OSError:
        return False


def may_be_deck(path: str) -> bool:
    """Return whether a path is a file, or cannot be looked at, and not the key of a password manager."""
    return may_be_file(path) and not is_key_file(path)


def may_be_file(path: str) -> bool:
    """Whether a path is a file, or cannot be looked at; not a hidden link to nothing: editors lock files by such."""
    try:
        return S_ISREG(os.stat(path).st_mode)  # noqa: PTH116 - Path raises for long names
    except FileNotFoundError:
        return os.path.islink(path) and not path.rpartition(os.sep)[2].startswith(".")  # noqa: PTH114 - as above
    except OSError:
        return True


GITIGNORE = ".gitignore"


class _Rules(NamedTuple):
    """The patterns of a `.gitignore`, the last first.

    They are for paths from its own folder: `above` stands before a path from the searched directory, or the first
    `below` letters of it are left out.
    """

    above: str
    below: int
    patterns: Sequence[PathPattern]

    def hides(self, path: str, *, folder: bool) -> bool | None:
        """Whether a path from the searched directory is hidden; None where no pattern says anything of it."""
        own = self.above + path[self.below :]
        return next((not one.negated for one in self.patterns if one.fits(own, folder=folder)), None)


@dataclass(slots=True, eq=False)
class Search:
    """A search of a directory and all below it; links to directories are not followed.

    `unreadable` collects what cannot be looked at, `hidden` says whether a `.gitignore` hid anything. Like git, the
    search also honours the `.gitignore` files above the directory in the same repository; like ripgrep, it honours them
    for what lies in the directory, not for the directory itself, which was asked for.
    """

    given: str
    gitignore: bool = True
    unreadable: list[OSError] = field(default_factory=list)
    hidden: bool = False

    def files(self, taken: Callable[[str], bool]) -> list[tuple[str, str]]:
        """The files that are taken, sorted by the names in their paths: a path from the directory, one to open it."""
        rules = {self.given: self._above() if self.gitignore else []}
        files: list[tuple[str, str]] = []
        for folder, folders, names in os.walk(self.given, onerror=self.unreadable.append):
            found = rules.pop(folder)
            inside = folder[len(self.given) :].replace(os.sep, "/").strip("/")
            start = f"{inside}/" if inside else ""
            shown = names
            if self.gitignore:
                if GITIGNORE in names:
                    found = [*self._read(Path(folder), "", len(start)), *found]
                folders[:] = [
                    name for name in folders if name != ".git" and not self._hides(found, start + name, folder=True)
                ]
                if found:
                    shown = [name for name in names if not self._hides(found, start + name, folder=False)]
            rules.update((os.path.join(folder, name), found) for name in folders)  # noqa: PTH118 - as os.walk does
            path = str(PurePath(folder, "-"))[:-1]
            files += ((start + name, path + name) for name in shown if taken(path + name))
        return sorted(files, key=lambda file: os.path.normcase(file[0]).split(os.sep))  # noqa: PTH206 - many files

    def _hides(self, rules: Sequence[_Rules], path: str, *, folder: bool) -> bool:
        said = next((hides for one in rules if (hides := one.hides(path, folder=folder)) is not None), False)
        self.hidden |= said
        return said

    def _above(self) -> list[_Rules]:
        """The rules above the directory, the nearest first."""
        here = Path(os.path.abspath(self.given))  # noqa: PTH100 - links stay what they are called
        found: list[_Rules] = []
        for folder in (here, *here.parents):
            if folder != here:
                found += self._read(folder, f"{here.relative_to(folder).as_posix()}/", 0)
            if (folder / ".git").exists():
                return found
        return []

    def _read(self, folder: Path, above: str, below: int) -> list[_Rules]:
        """The rules of a folder, if it has any."""
        path = folder / GITIGNORE
        try:
            text = os.fsdecode(path.read_bytes()) if path.is_file() else ""
        except OSError as error:
            self.unreadable.append(error)
            return []
        patterns = [pattern for line in text.split("\n") if (pattern := read_pattern(line))]
        return [_Rules(above, below, patterns[::-1])] if patterns else []
