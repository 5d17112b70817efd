"""Search for decks in folders: files that are decks by name or content, except those that a .gitignore hides."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path, PurePath
from stat import S_ISREG
from typing import NamedTuple

from mudline.basics.patterns import PathPattern, hides, read_pattern
from mudline.language.deck import MARK
from mudline.language.deck.forms import KEYWORD, SUFFIXES, form_of
from mudline.language.syntax.source import KEY_FILE

_HEAD = 4096
"""Number of bytes at the beginning of a file that are searched for its format."""


def is_deck(path: str) -> bool:
    """Return True if a path has the suffix of a deck."""
    return os.path.splitext(path)[1].lower() in SUFFIXES  # noqa: PTH122 - called for many files


def has_suffix(path: str) -> bool:
    """Return True if a path has a suffix of keyword text, JSON or YAML."""
    return is_deck(path) or form_of(path) != KEYWORD


def is_in_any_form(path: str) -> bool:
    """Return True if a file is a deck by its suffix, or one in JSON or YAML by the format name at its beginning.

    A file that cannot be opened counts as a deck; the error is reported when it is read.
    """
    if is_deck(path):
        return True
    if form_of(path) == KEYWORD or not may_be_file(path):
        return False
    head = _head(path)
    return head is None or MARK.encode() in head


def is_key_file(path: str) -> bool:
    """Return True if a `.keyx` file is a key of a password manager, which has the same suffix."""
    head = _head(path) if path.lower().endswith(".keyx") else None
    return bool(head and KEY_FILE.match(head.decode("latin-1").removeprefix("\xef\xbb\xbf")))


def _head(path: str) -> bytes | None:
    """Return the beginning of a file; None if it cannot be opened."""
    try:
        with Path(path).open("rb") as stream:
            return stream.read(_HEAD)
    except OSError:
        return None


def may_be_deck(path: str) -> bool:
    """Return True if a path may be a file (see `may_be_file`) and is not the key of a password manager."""
    return may_be_file(path) and not is_key_file(path)


def may_be_file(path: str) -> bool:
    """Return True if a path is a file or cannot be examined. A hidden dangling link is a lock of an editor: False."""
    try:
        return S_ISREG(os.stat(path).st_mode)  # noqa: PTH116 - Path raises for long names
    except FileNotFoundError:
        return os.path.islink(path) and not path.rpartition(os.sep)[2].startswith(".")  # noqa: PTH114 - as above
    except OSError:
        return True


GITIGNORE = ".gitignore"


class _Rules(NamedTuple):
    """Patterns of a `.gitignore`, the last first.

    The patterns are for paths from the folder of the `.gitignore`. `above` is prepended to a path from the searched
    directory, or the first `below` letters of the path are removed.
    """

    above: str
    below: int
    patterns: Sequence[PathPattern]

    def hides(self, path: str, *, folder: bool) -> bool | None:
        """Return True if a path from the searched directory is hidden; None if no pattern matches."""
        own = self.above + path[self.below :]
        return hides(self.patterns, own, folder=folder)


@dataclass(slots=True, eq=False)
class Search:
    """Search of a directory and all its subdirectories; links to directories are not followed.

    `unreadable` collects the paths that cannot be examined; `hidden` is True if a `.gitignore` hid a file. As in git,
    the `.gitignore` files above the directory in the same repository count too. As in ripgrep, they count for the
    contents of the directory, not for the directory itself, which was asked for.
    """

    given: str
    gitignore: bool = True
    unreadable: list[OSError] = field(default_factory=list)
    hidden: bool = False

    def files(self, taken: Callable[[str], bool]) -> list[tuple[str, str]]:
        """Return the files that are taken, sorted by the names in their paths: path in the directory, path to open."""
        rules = {self.given: self._above() if self.gitignore else []}
        files: list[tuple[str, str]] = []
        for folder, folders, names in os.walk(self.given, onerror=self.unreadable.append):
            applying = rules.pop(folder)
            inside = folder[len(self.given) :].replace(os.sep, "/").strip("/")
            start = f"{inside}/" if inside else ""
            shown = names
            if self.gitignore:
                if GITIGNORE in names:
                    applying = [*self._read(Path(folder), "", len(start)), *applying]
                folders[:] = [
                    name for name in folders if name != ".git" and not self._hides(applying, start + name, folder=True)
                ]
                if applying:
                    shown = [name for name in names if not self._hides(applying, start + name, folder=False)]
            rules.update((os.path.join(folder, name), applying) for name in folders)  # noqa: PTH118 - as os.walk does
            path = str(PurePath(folder, "-"))[:-1]
            files += ((start + name, path + name) for name in shown if taken(path + name))
        return sorted(files, key=lambda file: os.path.normcase(file[0]).split(os.sep))  # noqa: PTH206 - many files

    def _hides(self, rules: Sequence[_Rules], path: str, *, folder: bool) -> bool:
        hidden = next((hides for rule in rules if (hides := rule.hides(path, folder=folder)) is not None), False)
        self.hidden |= hidden
        return hidden

    def _above(self) -> list[_Rules]:
        """Return the rules of the folders above the directory, the nearest first."""
        here = Path(os.path.abspath(self.given))  # noqa: PTH100 - keeps the names of links
        rules: list[_Rules] = []
        for folder in (here, *here.parents):
            if folder != here:
                rules += self._read(folder, f"{here.relative_to(folder).as_posix()}/", 0)
            if (folder / ".git").exists():
                return rules
        return []

    def _read(self, folder: Path, above: str, below: int) -> list[_Rules]:
        """Return the rules of a folder, if it has any."""
        path = folder / GITIGNORE
        try:
            text = os.fsdecode(path.read_bytes()) if path.is_file() else ""
        except OSError as error:
            self.unreadable.append(error)
            return []
        patterns = [pattern for line in text.split("\n") if (pattern := read_pattern(line))]
        return [_Rules(above, below, patterns[::-1])] if patterns else []
