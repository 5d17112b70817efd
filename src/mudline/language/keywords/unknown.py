"""Values that stand in a deck and could not be read: neither absent (None) nor a number."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Final, Self

from pydantic import BaseModel

from mudline.language.keywords.table import Table


class Unknown(float):
    """The value of `UNKNOWN`: a NaN, and whatever is asked of it is unknown too.

    So a check that looks for what is absent (`is None`) passes over it, and one that compares numbers is silent. In a
    table an unknown cell is a NaN without a word.
    """

    __slots__ = ()

    def __new__(cls) -> Self:
        """The NaN."""
        return super().__new__(cls, "nan")

    def __getattr__(self, name: str) -> Any:
        """A part of what is unknown; what Python itself looks for is none."""
        if name.startswith("__"):
            raise AttributeError(name)
        return self

    def __call__(self, *_: object, **__: object) -> Self:
        """What a method of what is unknown gives."""
        return self

    def __getitem__(self, _: object) -> Self:
        """An item of what is unknown."""
        return self

    def __iter__(self) -> Iterator[Any]:
        """The items that are known: none."""
        return iter(())

    def __len__(self) -> int:
        """How many of them are known."""
        return 0

    def __bool__(self) -> bool:
        """It was given."""
        return True

    def __repr__(self) -> str:
        """The name of the value."""
        return "UNKNOWN"

    def __reduce__(self) -> str:
        """There is one, also in a copy."""
        return "UNKNOWN"


UNKNOWN: Final[Any] = Unknown()
"""A value that could not be read, in the place of one of any type but a text."""


class UnknownName(str):
    """The value of `UNKNOWN_NAME`: an empty text, which names nothing."""

    __slots__ = ()

    def __repr__(self) -> str:
        """The name of the value."""
        return "UNKNOWN_NAME"

    def __reduce__(self) -> str:
        """There is one, also in a copy."""
        return "UNKNOWN_NAME"


UNKNOWN_NAME: Final[str] = UnknownName()
"""A name or word that could not be read."""


class Partly(list[Any]):
    """A list of which not all could be read: it may have more items than these."""


def known_name(name: str | None) -> str | None:
    """A name that was given and could be read, else None."""
    return None if name is UNKNOWN_NAME else name


def is_unknown(value: object) -> bool:
    """Whether a value stands in the deck and could not be read."""
    return value is UNKNOWN or value is UNKNOWN_NAME


def is_partly_unknown(value: object) -> bool:
    """Whether a value, an item of a list, a field of a table or of a part could not be read."""
    if is_unknown(value) or type(value) is Partly or (isinstance(value, Table) and value.unknown):
        return True
    return isinstance(value, BaseModel) and any(map(is_partly_unknown, value.__dict__.values()))
