"""A file in any of the three forms to a deck."""

from __future__ import annotations

from pathlib import Path, PurePath

from mudline.codes import DOC001
from mudline.deck.model import Deck
from mudline.deck.reading import read_source
from mudline.diagnostics import DeckError, Diagnostic
from mudline.syntax.source import Source

FORMS = ("keyword", "json", "yaml")
_SUFFIXES = {".json": "json", ".yaml": "yaml", ".yml": "yaml"}


def form_of(name: str) -> str:
    """The form that a file name's suffix tells: "json", "yaml", else "keyword"."""
    return _SUFFIXES.get(PurePath(name).suffix.lower(), "keyword")


def load_path(path: Path, name: str | None = None, *, form: str | None = None, units: str | None = None) -> Deck:
    """The deck of a file; raises OSError, or DeckError for a JSON or YAML file that holds no deck."""
    return load_bytes(path.read_bytes(), name or path.as_posix(), form=form, units=units)


def load_bytes(data: bytes, name: str, *, form: str | None = None, units: str | None = None) -> Deck:
    """The deck of a file's content. A keyword text never fails: what is wrong is in the deck's problems."""
    form = form or form_of(name)
    if form == "keyword":
        return read_source(Source.from_bytes(data, name), units=units)
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        message = f"byte 0x{data[error.start]:02X} is not UTF-8: {form.upper()} files are"
        found = Diagnostic(name, DOC001.code, DOC001.slug, DOC001.severity, message, line, 1, line, 1)
        raise DeckError([found]) from error
    deck = _read(form, text, name)
    if units:
        deck.units = units
    return deck


def _read(form: str, text: str, name: str) -> Deck:
    if form == "json":
        from mudline.deck.json_form import from_json

        return from_json(text, name)
    from mudline.deck.yaml_form import from_yaml

    return from_yaml(text, name)


def dump(deck: Deck, form: str) -> str:
    """The text of a deck in a form."""
    if form == "json":
        from mudline.deck.json_form import to_json

        return to_json(deck)
    if form == "yaml":
        from mudline.deck.yaml_form import to_yaml

        return to_yaml(deck)
    from mudline.deck.keyword_form import to_keyword

    return to_keyword(deck)
