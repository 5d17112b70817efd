"""YAML events to plain values: no aliases, no key twice, no deep nesting, one document."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

import yaml

from mudline.deck.yaml_core import Mark, scalar, start_of

DEEPEST = 100
"""The most levels of a document; a deck has ten, and the parser's time grows with their square."""


class NoDeckError(Exception):
    """YAML that no deck is written in; `mark` is where."""

    def __init__(self, message: str, mark: Mark) -> None:
        self.mark = mark
        super().__init__(message)


class _NoKey:
    """Stands where a mapping waits for its next key."""


@dataclass(slots=True)
class _Open:
    """A list or mapping that is not finished, with the key whose value comes next."""

    holder: list[Any] | dict[str, Any]
    key: str | type[_NoKey] = _NoKey

    @property
    def waits_for_key(self) -> bool:
        """Whether the next value is a key."""
        return isinstance(self.holder, dict) and not isinstance(self.key, str)

    def put(self, value: object, event: yaml.Event) -> None:
        """Take in a finished value."""
        if isinstance(self.holder, list):
            self.holder.append(value)
        elif isinstance(self.key, str):
            self.holder[self.key] = value
            self.key = _NoKey
        elif not isinstance(value, str):
            raise _fault("a key must be a text", event)
        elif value in self.holder:
            raise _fault(f"the key {value!r} stands twice in one mapping", event)
        else:
            self.key = value


@dataclass(slots=True)
class _Composer:
    root: object = None
    documents: int = 0
    stack: list[_Open] = field(default_factory=list)

    def put(self, value: object, event: yaml.Event) -> None:
        if self.stack:
            self.stack[-1].put(value, event)
        else:
            self.root = value

    def take(self, event: yaml.Event) -> None:
        match event:
            case yaml.AliasEvent():
                raise _fault(f"the alias *{event.anchor} is YAML that a deck does not use: write the value out", event)
            case yaml.ScalarEvent():
                self.put(_scalar(event), event)
            case yaml.CollectionStartEvent():
                if len(self.stack) == DEEPEST:
                    raise _fault("nested too deeply: is this a deck?", event)
                if self.stack and self.stack[-1].waits_for_key:
                    raise _fault("a key must be a text", event)
                self.stack.append(_Open({} if isinstance(event, yaml.MappingStartEvent) else []))
            case yaml.CollectionEndEvent():
                self.put(self.stack.pop().holder, event)
            case yaml.DocumentStartEvent():
                self.documents += 1
                if self.documents > 1:
                    raise _fault("a second document in one file: a deck is one document", event)
            case _:
                pass


def compose(events: Iterable[yaml.Event]) -> object:
    """The value of the one document; raises NoDeckError for what a deck does not have."""
    composer = _Composer()
    for event in events:
        composer.take(event)
    return composer.root


def _scalar(event: yaml.ScalarEvent) -> object:
    try:
        return scalar(event)
    except ValueError as error:
        raise _fault(str(error), event) from error


def _fault(message: str, event: yaml.Event) -> NoDeckError:
    return NoDeckError(message, start_of(event))
