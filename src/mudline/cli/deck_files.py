"""The files of a command that takes decks in any form: in a directory also JSON and YAML files that say so."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path, PurePath

from mudline.cli.inputs import SUFFIXES, Inputs, collect_taken
from mudline.deck.loading import form_of

_MARK = b"mudline-deck/"
_HEAD = 4096
"""Bytes at the beginning of a JSON or YAML file in which it says that it is a deck."""


def collect_any_form(paths: Sequence[str], stdin_name: str, *, gitignore: bool) -> Inputs:
    """Files as given; directories searched for decks in any form, in sorted order; `-` for standard input."""
    return collect_taken(paths, stdin_name, _is_deck, gitignore=gitignore)


def _is_deck(path: PurePath) -> bool:
    """Whether a file is one by its suffix, or by what it says; a file that cannot be opened is to be told of."""
    known = path.suffix.lower() in SUFFIXES
    if not known and form_of(path.name) == "keyword":
        return False
    file = Path(path)
    if file.exists() and not file.is_file():
        return False
    if known:
        return True
    try:
        with file.open("rb") as stream:
            return _MARK in stream.read(_HEAD)
    except OSError:
        return True
