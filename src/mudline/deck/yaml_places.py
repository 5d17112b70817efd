"""Where the values of a YAML text stand: the text is read again, and what is on the wanted paths is noted."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import yaml

from mudline.deck.document_places import DocumentPath, Wanted
from mudline.deck.model import Range
from mudline.deck.yaml_core import LOADER, Mark, end_of, start_of
from mudline.diagnostics import Span
from mudline.syntax.fields import trimmed
from mudline.syntax.rows import row_fields
from mudline.syntax.source import Source

_MOST_COLUMNS = 64


@dataclass
class YamlPlaces:
    """Finds values in a YAML text that has been read once, so that it is well formed."""

    text: str

    @cached_property
    def source(self) -> Source:
        """The text with its lines."""
        return Source("", self.text)

    def ranges(self, wanted: Wanted) -> dict[DocumentPath, Range]:
        """The places of the values on the wanted paths, as far as there are such values."""
        walk = _Walk(self, wanted)
        for event in yaml.parse(self.text, Loader=LOADER):
            walk.take(event)
        return walk.found

    def at(self, start: Mark, end: Mark) -> Range:
        """Lines and columns from one mark to another; one behind the last line stands at its end."""
        last = len(self.source.line_starts)
        places = [
            (mark.line + 1, mark.column + 1) if mark.line < last else (last, len(self.source.line(last)) + 1)
            for mark in (start, end)
        ]
        return Range(*places[0], *places[1])

    def rows(self, path: DocumentPath, above: int, below: int, wanted: Wanted) -> dict[DocumentPath, Range]:
        """The places of rows and fields in a table that is a block of text between two lines."""
        found: dict[DocumentPath, Range] = {}
        last = min(below, len(self.source.line_starts) + 1)
        numbers = [number for number in range(above + 1, last) if self.source.line(number).strip()]
        for row, columns in wanted.items():
            number = numbers[int(row)]
            line = self.source.line(number)
            fields = row_fields(line, Span(0, len(line)), _MOST_COLUMNS)
            spans: dict[DocumentPath, Span] = {(): trimmed(line, 0, len(line))}
            spans |= {(column,): fields[int(column)].span for column in columns if int(column) < len(fields)}
            for inner, (start, end) in spans.items():
                found[*path, row, *inner] = Range(number, start + 1, number, end + 1)
        return found


@dataclass(slots=True)
class _Open:
    """A list or mapping: what is wanted below it (None: nothing), and the index or key of the next value."""

    path: DocumentPath
    wanted: Wanted | None
    start: Mark
    keyed: bool
    key: str = ""
    waiting: bool = True
    index: int = -1

    def next_name(self) -> str | int:
        """Go on to the next value."""
        if self.keyed:
            self.waiting = True
            return self.key
        self.index += 1
        return self.index


@dataclass(slots=True)
class _Walk:
    places: YamlPlaces
    wanted: Wanted
    found: dict[DocumentPath, Range] = field(default_factory=dict)
    stack: list[_Open] = field(default_factory=list)

    def take(self, event: yaml.Event) -> None:
        if isinstance(event, yaml.CollectionEndEvent):
            done = self.stack.pop()
            if done.wanted is not None:
                self.found[done.path] = self.places.at(done.start, end_of(event))
        elif isinstance(event, yaml.ScalarEvent | yaml.CollectionStartEvent):
            top = self.stack[-1] if self.stack else None
            if top and top.keyed and top.waiting and isinstance(event, yaml.ScalarEvent):
                top.key, top.waiting = event.value, False
            else:
                self._value(event, top)

    def _value(self, event: yaml.ScalarEvent | yaml.CollectionStartEvent, top: _Open | None) -> None:
        path: DocumentPath = ()
        wanted: Wanted | None = self.wanted
        if top:
            name = top.next_name()
            wanted = None if top.wanted is None else top.wanted.get(name)
            path = () if wanted is None else (*top.path, name)
        if isinstance(event, yaml.CollectionStartEvent):
            self.stack.append(_Open(path, wanted, start_of(event), isinstance(event, yaml.MappingStartEvent)))
        elif wanted is not None:
            self.found[path] = self.places.at(start_of(event), end_of(event))
            if event.style == "|":
                self.found |= self.places.rows(path, start_of(event).line + 1, end_of(event).line + 1, wanted)
