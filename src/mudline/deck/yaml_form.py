"""A deck to YAML 1.2 and back. A long table is a block of rows, as a nested list would take a minute to read."""

from __future__ import annotations

from typing import Any, cast

import yaml

from mudline.deck.document import to_document
from mudline.deck.document_reading import decoded, from_document
from mudline.deck.faults import refusal
from mudline.deck.model import Deck
from mudline.deck.node_places import locator, mark_range
from mudline.deck.yaml_core import CoreDumper, CoreLoader, scalar
from mudline.diagnostics import DeckError
from mudline.keywords.listing import Listing
from mudline.keywords.writer import joined

DEEPEST = 100
"""The most levels of a document; a deck has about ten."""

SHORT_TABLE = 20
"""Tables up to this many rows are lists; longer ones a block of text, a row a line."""


def to_yaml(deck: Deck) -> str:
    """The deck as YAML text."""
    return yaml.dump(_node(to_document(deck)), Dumper=_Dumper, sort_keys=False, allow_unicode=True, width=2**30)


class _Literal(str):
    """Text that is written as a literal block."""

    __slots__ = ()


class _Flow(list[Any]):
    """A list that is written on one line."""


class _Dumper(CoreDumper):
    """Literal blocks, rows on one line, the shortest numbers that read back."""


_Dumper.add_representer(
    _Literal, lambda dumper, text: dumper.represent_scalar("tag:yaml.org,2002:str", str(text), style="|")
)
_Dumper.add_representer(
    _Flow, lambda dumper, row: dumper.represent_sequence("tag:yaml.org,2002:seq", row, flow_style=True)
)
_Dumper.add_representer(float, lambda dumper, value: dumper.represent_scalar("tag:yaml.org,2002:float", repr(value)))
_Dumper.add_representer(type(None), lambda dumper, _: dumper.represent_scalar("tag:yaml.org,2002:null", "null"))


def _node(value: Any) -> Any:
    """The document with its tables and rows marked for the dumper."""
    if isinstance(value, dict):
        return {key: _node(item) for key, item in value.items()}
    if isinstance(value, Listing):
        return _table(value)
    if not isinstance(value, list) or not value:
        return value
    if isinstance(value[0], str):
        return value
    if isinstance(value[0], dict | list):
        return [_node(item) for item in value]
    return _Flow(value)


def _table(listing: Listing) -> Any:
    if len(listing) > SHORT_TABLE:
        return _Literal("".join(f"{piece}\n" for piece in listing.lines(joined)))
    return [_Flow(row) for row in listing.rows()]


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
    try:
        _look_over(text, file)
        root = yaml.compose(text, Loader=CoreLoader)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        raise refusal(file, f"no YAML: {error.problem}", mark_range(text, mark)) from error
    except yaml.YAMLError as error:
        raise refusal(file, f"no YAML: {str(error).partition(chr(10))[0]}") from error
    document = None if root is None else _Reader(file, text).value(root)
    return from_document(document, file, locator(text, root))


def _look_over(text: str, file: str) -> None:
    """Refuse aliases, which could make a short file endless, and nesting that would exhaust the composer's stack."""
    depth = 0
    for event in yaml.parse(text, Loader=CoreLoader):
        depth += isinstance(event, yaml.CollectionStartEvent) - isinstance(event, yaml.CollectionEndEvent)
        if depth > DEEPEST:
            raise refusal(file, "nested too deeply: is this a deck?", mark_range(text, event.start_mark))
        if isinstance(event, yaml.AliasEvent):
            message = f"the alias *{event.anchor} is YAML that a deck does not use: write the value out"
            raise refusal(file, message, mark_range(text, event.start_mark))


class _Reader:
    """Nodes to values."""

    def __init__(self, file: str, text: str) -> None:
        self.file = file
        self.text = text

    def value(self, node: yaml.Node) -> Any:
        """The value of a node and all below it."""
        if isinstance(node, yaml.MappingNode):
            return self._mapping(node)
        if isinstance(node, yaml.SequenceNode):
            return [self.value(item) for item in node.value]
        try:
            return scalar(cast("yaml.ScalarNode", node))
        except ValueError as error:
            raise self._error(node, str(error)) from error

    def _mapping(self, node: yaml.MappingNode) -> dict[str, Any]:
        values: dict[str, Any] = {}
        for key_node, value_node in node.value:
            key = self.value(key_node)
            if not isinstance(key, str):
                raise self._error(key_node, f"a key must be a text, found {key!r}")
            if key in values:
                raise self._error(key_node, f"the key {key!r} stands twice in one mapping")
            values[key] = self.value(value_node)
        return values

    def _error(self, node: yaml.Node, message: str) -> DeckError:
        return refusal(self.file, message, mark_range(self.text, node.start_mark))
