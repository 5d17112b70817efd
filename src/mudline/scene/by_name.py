"""Curves and sets by name: found without case, listed as the deck writes them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import TypeVar, overload

from mudline.deck.parameters import folded
from mudline.keywords.text import suggestion
from mudline.short_repr import UnknownNameError, counted, cut, listed

Value = TypeVar("Value")
Default = TypeVar("Default")

_LONGEST = 200
_LONGEST_NAME = 60


class ByName(Mapping[str, Value]):
    """A mapping whose names are found without case, and without blanks around them.

    Iteration gives the names as the deck first writes them. A name that is not there raises UnknownNameError, a
    KeyError that says which there are.
    """

    def __init__(self, kind: str, entries: Iterable[tuple[str, Value]], key: Callable[[str], str] = folded) -> None:
        """Hold `entries`, pairs of name and value; of two with one `key` the later holds. `kind` is one of them."""
        self._kind = kind
        self._key = key
        self._entries = {key(name): (name, value) for name, value in entries}

    def __getitem__(self, name: str) -> Value:
        found = self._find(name)
        if found is None:
            raise self._missing(name)
        return found[1]

    @overload
    def get(self, key: str, /) -> Value | None: ...
    @overload
    def get(self, key: str, /, default: Value | Default) -> Value | Default: ...
    def get(self, key: str, /, default: object = None) -> object:
        """Return the value of a name, or `default`."""
        found = self._find(key)
        return default if found is None else found[1]

    def __contains__(self, name: object) -> bool:
        return self._find(name) is not None

    def __iter__(self) -> Iterator[str]:
        return (name for name, _ in self._entries.values())

    def __len__(self) -> int:
        return len(self._entries)

    def __repr__(self) -> str:
        if not self:
            return f"<no {self._kind}s>"
        return cut(f"<{counted(len(self), self._kind)}: {listed(list(self))}", _LONGEST) + ">"

    def _ipython_key_completions_(self) -> list[str]:
        """The names, for the completion of `["` in notebooks."""
        return list(self)

    def _find(self, name: object) -> tuple[str, Value] | None:
        return self._entries.get(self._key(name)) if isinstance(name, str) else None

    def _missing(self, name: object) -> UnknownNameError:
        if not isinstance(name, str):
            return UnknownNameError(f"a {self._kind} is found by its name, a str, not by {type(name).__name__}")
        names = list(self)
        return UnknownNameError.among(self._kind, cut(name, _LONGEST_NAME), names, suggestion(name, names))
