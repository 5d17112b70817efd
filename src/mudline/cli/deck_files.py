"""The files of a command that takes decks in any form: in a directory also JSON and YAML files that say so."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path, PurePath

from mudline.cli.inputs import SUFFIXES, Input, Inputs, collect
from mudline.cli.terminal import reason
from mudline.deck.loading import form_of

_MARK = b"mudline-deck/"
_HEAD = 4096
"""Bytes at the beginning of a JSON or YAML file in which it says that it is a deck."""


def collect_any_form(paths: Sequence[str], stdin_name: str) -> Inputs:
    """Files as given; directories searched for decks in any form, in sorted order; `-` for standard input."""
    found = Inputs()
    for given in paths:
        if os.path.isdir(given):  # noqa: PTH112 - Path raises for a name that is too long or may not be looked at
            _directory(given, found)
        else:
            found.files += collect([given], stdin_name).files
    found.files = list(dict.fromkeys(found.files))
    return found


def _directory(given: str, found: Inputs) -> None:
    unreadable: list[OSError] = []
    walk = os.walk(given, onerror=unreadable.append)
    paths = sorted(PurePath(folder, name) for folder, _, names in walk for name in names if _may_be_deck(name))
    decks = [path for path in paths if _is_deck(Path(path))]
    for error in unreadable:
        found.fail(f"{_slashed(str(error.filename))}: {reason(error)}")
    if not decks and not unreadable:
        found.fail(f"{given}: no deck in this directory (looked for {', '.join(sorted(SUFFIXES))})")
    start = "" if given == "." else _slashed(given).rstrip("/") + "/"
    found.files += [Input(start + path.relative_to(given).as_posix(), str(path)) for path in decks]


def _may_be_deck(name: str) -> bool:
    return PurePath(name).suffix.lower() in SUFFIXES or form_of(name) != "keyword"


def _is_deck(path: Path) -> bool:
    """Whether a file is one by its suffix, or by what it says; a file that cannot be opened is to be told of."""
    if path.exists() and not path.is_file():
        return False
    if form_of(path.name) == "keyword":
        return True
    try:
        with path.open("rb") as file:
            return _MARK in file.read(_HEAD)
    except OSError:
        return True


def _slashed(path: str) -> str:
    return path.replace(os.sep, "/")
