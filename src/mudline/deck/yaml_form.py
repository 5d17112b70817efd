"""A deck to YAML 1.2 and back. A long table is a block of rows, as a nested list would take a minute to read."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, cast

import yaml
from pydantic_core import to_json as compact

from mudline.deck.document import from_document, to_document
from mudline.deck.document_faults import decoded, refusal
from mudline.deck.model import START, Deck
from mudline.deck.yaml_core import DUMPER, LOADER, plain_kind
from mudline.deck.yaml_places import YamlPlaces
from mudline.deck.yaml_reading import NoDeckError, compose
from mudline.keywords.writer import joined

SHORT_TABLE = 20
"""Tables up to this many rows are lists; longer ones a block of text, a row a line."""


def to_yaml(deck: Deck) -> str:
    """The deck as YAML text."""
    events = [
        yaml.StreamStartEvent(),
        yaml.DocumentStartEvent(explicit=False),
        *_events(to_document(deck)),
        yaml.DocumentEndEvent(explicit=False),
        yaml.StreamEndEvent(),
    ]
    return cast("str", yaml.emit(events, Dumper=DUMPER, allow_unicode=True, width=2**30))


def write(deck: Deck) -> str:
    """What `dump` calls."""
    return to_yaml(deck)


def read(data: bytes, file: str) -> Deck:
    """The deck of a file's content; raises DeckError."""
    return from_yaml(decoded(data, file, "YAML"), file)


def from_yaml(text: str, file: str = "<yaml>") -> Deck:
    """The deck of a YAML text.

    Raises DeckError for what is no YAML, has a key twice or an alias, or breaks the schema.
    """
    places = YamlPlaces(text)
    try:
        document = compose(yaml.parse(text, Loader=LOADER))
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        raise refusal(file, f"no YAML: {error.problem}", places.at(mark, mark) if mark else START) from error
    except yaml.YAMLError as error:
        raise refusal(file, f"no YAML: {str(error).partition(chr(10))[0]}") from error
    except NoDeckError as error:
        raise refusal(file, str(error), places.at(error.mark, error.mark)) from error
    return from_document(document, file, places)


def _events(value: Any) -> Iterator[yaml.Event]:
    """The events of a value of a document: long tables as text, rows on one line."""
    if isinstance(value, dict):
        yield yaml.MappingStartEvent(anchor=None, tag=None, implicit=True, flow_style=False)
        for key, item in value.items():
            yield _text(key)
            yield from _events(item)
        yield yaml.MappingEndEvent()
    elif isinstance(value, list):
        yield from _list(value)
    else:
        yield _text(value) if isinstance(value, str) else _plain(value)


def _list(items: list[Any]) -> Iterator[yaml.Event]:
    if len(items) > SHORT_TABLE and isinstance(items[0], list):
        text = "".join(f"{joined(row)}\n" for row in items)
        yield yaml.ScalarEvent(anchor=None, tag=None, implicit=(False, True), value=text, style="|")
        return
    in_one_line = not items or not isinstance(items[0], str | dict | list)
    yield yaml.SequenceStartEvent(anchor=None, tag=None, implicit=True, flow_style=in_one_line)
    for item in items:
        yield from _events(item)
    yield yaml.SequenceEndEvent()


def _text(text: str) -> yaml.Event:
    """A text, in quotes where it would be read as something else."""
    style = None if plain_kind(text) == "str" else "'"
    return yaml.ScalarEvent(anchor=None, tag=None, implicit=(style is None, True), value=text, style=style)


def _plain(value: float | None) -> yaml.Event:
    return yaml.ScalarEvent(anchor=None, tag=None, implicit=(True, False), value=compact(value).decode(), style=None)
