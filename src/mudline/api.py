"""What `import mudline` offers: decks, scenes, findings."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import fields
from pathlib import Path

from mudline.deck import model
from mudline.deck.json_form import from_json as _from_json
from mudline.deck.json_form import to_json as _to_json
from mudline.deck.keyword_form import to_keyword as _to_keyword
from mudline.deck.loading import load_path
from mudline.deck.yaml_form import from_yaml as _from_yaml
from mudline.deck.yaml_form import to_yaml as _to_yaml
from mudline.diagnostics import Diagnostic
from mudline.linting.engine import lint_bytes
from mudline.linting.selection import select as _chosen
from mudline.scene.build import resolve
from mudline.scene.model import Scene


class Deck(model.Deck):
    """A deck: sections and blocks as validated models, equations as written."""

    def to_json(self) -> str:
        """The deck as JSON text."""
        return _to_json(self)

    def to_yaml(self) -> str:
        """The deck as YAML 1.2 text."""
        return _to_yaml(self)

    def to_keyword(self) -> str:
        """The deck as keyword text."""
        return _to_keyword(self)

    def scene(self) -> Scene:
        """Parameters evaluated, sets expanded, diameters, lengths and laws as arrays.

        Raises DeckError for errors on which a result depends.
        """
        return resolve(self).require()


def read(path: str | os.PathLike[str], *, units: str | None = None) -> Deck:
    """Read a deck from a keyword, JSON or YAML file, by its suffix.

    `units` ("metric", "imperial" or "user") holds instead of what the file tells. Raises OSError when the file cannot
    be read, DeckError (with `.diagnostics`) when its content cannot.
    """
    return _offered(load_path(Path(path), units=units).require())


def from_json(text: str) -> Deck:
    """The deck of a JSON text; raises DeckError."""
    return _offered(_from_json(text))


def from_yaml(text: str) -> Deck:
    """The deck of a YAML text; raises DeckError."""
    return _offered(_from_yaml(text))


def lint(
    path: str | os.PathLike[str],
    *,
    select: Iterable[str] = (),
    ignore: Iterable[str] = (),
    units: str | None = None,
) -> list[Diagnostic]:
    """All findings in a file, in its order; never raises for content.

    `select` and `ignore` name rules by code, prefix of a code, or slug; without `select` all rules run. Raises OSError
    when the file cannot be read, ValueError for a word that names no rule.
    """
    file = Path(path)
    return lint_bytes(file.read_bytes(), file.as_posix(), _chosen(select, ignore), units=units, folder=file.parent)


def _offered(deck: model.Deck) -> Deck:
    return Deck(**{item.name: getattr(deck, item.name) for item in fields(deck)})
