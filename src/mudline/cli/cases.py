"""The files of many decks: a name for each below their common folder, its positions, and where its results go."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from string import Formatter

import click

from mudline.cli.inputs import Input
from mudline.results.forms import form_module

SUMMARY = "summary"
"""The name, without its suffix, of the file with the rows of all decks."""

_POSITIONS = (".csv", ".npz", ".npy")
_FIELDS = ("name", "folder")


@dataclass(frozen=True, slots=True)
class Case:
    """A deck among many; `inside` is its path below the folder that all have in common, with `/`."""

    file: Input
    inside: str
    result: str = ""
    """The file of its results below the folder of all results, with `/`; "" where none is written."""

    @property
    def name(self) -> str:
        """The name of the file without its suffix."""
        return PurePosixPath(self.inside).stem


def named_cases(files: Sequence[Input], form: str) -> tuple[str, list[Case]]:
    """The common folder of decks, and a case for each; with a form each has a file of results of its own.

    Such a file is called as the deck without its suffix; decks of one name with different suffixes keep theirs.
    """
    paths = [os.path.abspath(file.path or file.name) for file in files]  # noqa: PTH100 - links stay what they are called
    try:
        common = os.path.commonpath([os.path.dirname(path) for path in paths])  # noqa: PTH120 - as above
    except ValueError:  # on several drives
        common = ""
    inside = [_inside(path, common) for path in paths]
    cases = [Case(file, name) for file, name in zip(files, inside, strict=True)]
    if not form:
        return common, cases
    plain = [str(PurePosixPath(name).with_suffix("")) for name in inside]
    counts = Counter(name.casefold() for stem in plain for name in (stem, *_others(stem, form)))
    counts.update([SUMMARY])
    stems = [
        stem if all(counts[one.casefold()] == 1 for one in (stem, *_others(stem, form))) else name
        for stem, name in zip(plain, inside, strict=True)
    ]
    return common, [Case(case.file, case.inside, f"{stem}.{form}") for case, stem in zip(cases, stems, strict=True)]


def _inside(path: str, common: str) -> str:
    """A path below a folder; of another drive, below a folder with the name of the drive."""
    if common:
        return Path(os.path.relpath(path, common)).as_posix()
    found = Path(path)
    return PurePosixPath(found.drive.strip(":\\/") or "root", *found.parts[1:]).as_posix()


def _others(stem: str, form: str) -> list[str]:
    return [f"{stem}-{table}" for table in form_module(form).BESIDE]


class MissingPositionsError(Exception):
    """A deck has no file of positions, or several."""


@dataclass(frozen=True, slots=True)
class PositionFiles:
    """Which file of positions a deck has: one for all, one by a pattern, one of a folder, or none."""

    given: str | None

    def check(self) -> None:
        """Refuse a pattern with unknown fields, and a file that is not there; raises click.ClickException."""
        if self.given is None or Path(self.given).exists():
            return
        try:
            names = {name for _, name, _, _ in Formatter().parse(self.given) if name is not None}
        except ValueError as error:
            raise click.UsageError(f"--positions {self.given}: not a pattern: {error}") from error
        if unknown := sorted(names - set(_FIELDS)):
            raise click.UsageError(f"--positions: {{{unknown[0]}}} is unknown: use {{name}} or {{folder}}")
        if not names:
            raise click.ClickException(f"{self.given}: no such file or directory")

    def of(self, case: Case) -> str | None:
        """The file of a deck; raises MissingPositionsError."""
        if self.given is None or Path(self.given).is_file():
            return self.given
        if Path(self.given).is_dir():
            return self._in_folder(case, Path(self.given))
        folder = os.path.dirname(case.file.path or case.file.name) or "."  # noqa: PTH120 - as it was given
        path = self.given.replace("{name}", case.name).replace("{folder}", folder)
        if not Path(path).is_file():
            raise MissingPositionsError(f"its positions are not there: {path}")
        return path

    def _in_folder(self, case: Case, folder: Path) -> str:
        """The file with the name of the deck: in the folder that the deck is in below the common one, or at the top."""
        stem = PurePosixPath(case.inside).with_suffix("")
        for start in dict.fromkeys((folder / stem, folder / case.name)):
            found = [path for end in _POSITIONS if (path := start.with_name(start.name + end)).is_file()]
            if len(found) > 1:
                raise MissingPositionsError(
                    f"several files of positions: {', '.join(path.as_posix() for path in found)}"
                )
            if found:
                return found[0].as_posix()
        ends = f"{', '.join(_POSITIONS[:-1])} or {_POSITIONS[-1]}"
        raise MissingPositionsError(f"its positions are not there: {(folder / stem).as_posix()} with {ends}")
