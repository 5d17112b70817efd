"""Values in a deck that could not be read: neither absent (None) nor numbers."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Final, Self

from pydantic import BaseModel

from mudline.language.keywords.table import Table


class Unknown(float):
    """Class of `UNKNOWN`: a NaN whose attributes and items are unknown too.

    A check for an absent value (`is None`) does not report it, and a comparison of numbers is False. In a table an
    unknown cell is a NaN without a word.
    """

    __slots__ = ()

    def __new__(cls) -> Self:
        """Return the NaN."""
        return super().__new__(cls, "nan")

    def __getattr__(self, name: str) -> Any:
        """Return an unknown attribute; AttributeError for names that Python itself looks up."""
        if name.startswith("__"):
            raise AttributeError(name)
        return self

    def __call__(self, *_: object, **__: object) -> Self:
        """Return an unknown result."""
        return self

    def __getitem__(self, _: object) -> Self:
        """Return an unknown item."""
        return self

    def __iter__(self) -> Iterator[Any]:
        """Return an iterator over the known items: none."""
        return iter(())

    def __len__(self) -> int:
        """Return the number of known items: 0."""
        return 0

    def __bool__(self) -> bool:
        """Return True: the value was given."""
        return True

    def __repr__(self) -> str:
        """Return the name of the value."""
        return "UNKNOWN"

    def __reduce__(self) -> str:
        """Return the name of the only instance, also for a copy."""
        return "UNKNOWN"


UNKNOWN: Final[Any] = Unknown()
"""Unreadable value, in the place of a value of any type but text."""


class UnknownName(str):
    """Class of `UNKNOWN_NAME`: an empty text, which refers to no object."""

    __slots__ = ()

    def __repr__(self) -> str:
        """Return the name of the value."""
        return "UNKNOWN_NAME"

    def __reduce__(self) -> str:
        """Return the name of the only instance, also for a copy."""
        return "UNKNOWN_NAME"


UNKNOWN_NAME: Final[str] = UnknownName()
"""Unreadable name or word."""


class Partly(list[Any]):
    """List with unreadable items: it may have more items than these."""


def known_name(name: str | None) -> str | None:
    """Return a name that was given and could be read, else None."""
    return None if name is UNKNOWN_NAME else name


def is_unknown(value: object) -> bool:
    """Return True if a value is given in the deck, but could not be read."""
    return value is UNKNOWN or value is UNKNOWN_NAME


def is_partly_unknown(value: object) -> bool:
    """Return True if a value, an item of a list, or a field of a table or part could not be read."""
    if is_unknown(value) or type(value) is Partly or (isinstance(value, Table) and value.unknown):
        return True
    return isinstance(value, BaseModel) and any(map(is_partly_unknown, value.__dict__.values()))
