"""Records as the Builder leaves them: plain values, and what is needed to find their places among the lines."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from mudline.language.diagnostics import Span
from mudline.language.keywords.model import Record
from mudline.language.keywords.runs import TableBuilder
from mudline.language.keywords.unknown import UNKNOWN
from mudline.language.syntax.fields import Field


class Item(NamedTuple):
    """A line or a record in a record: where it is written, where it stands, how many it counts for."""

    order: int
    position: int
    size: int


class Written(NamedTuple):
    """Where values of a record stand: a field, if it has a span of its own, and the fields of its line by their names.

    Without `slot` the names are those of fields of the record.
    """

    slot: str | None
    span: Span | None
    names: Sequence[str | int]
    fields: Sequence[Field]


@dataclass(slots=True)
class ParsedRecord:
    """A record as plain values, and what is needed to find the places of these and to put comments among them.

    A record is `unsure` where lines or settings of it could not be used: what it seems to lack may be there. It is
    `unchosen` where the value is not known that says which kind of rows it has. `opening` is the first line of its own.
    """

    part: type[Record]
    values: dict[str, Any] = field(default_factory=dict)
    children: dict[str, list[ParsedRecord]] = field(default_factory=dict)
    written: list[Written] = field(default_factory=list)
    tables: dict[str, TableBuilder] = field(default_factory=dict)
    items: list[Item] = field(default_factory=list)
    opening: Span | None = None
    sticky: object = None
    first: int = 0
    last: int | None = None
    unsure: bool = False
    unchosen: bool = False

    @property
    def known(self) -> dict[str, Any]:
        """The values that could be read."""
        return {name: value for name, value in self.values.items() if value is not UNKNOWN}

    def reach(self, position: int) -> None:
        """Take note of a line."""
        if self.last is None:
            self.first = self.last = position
        elif position > self.last:
            self.last = position
