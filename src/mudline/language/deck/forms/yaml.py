"""A deck to YAML 1.2 (core schema) and back. Long tables are blocks of rows: nested lists take far longer to read."""

from __future__ import annotations

import math
import re
from typing import Any, Protocol, cast

import yaml

from mudline.basics.limits import DEEPEST, LONGEST_NUMBER
from mudline.language.deck.document import decoded, from_document, to_document
from mudline.language.deck.faults import Locate, refusal
from mudline.language.deck.model import START, Deck, Range
from mudline.language.diagnostics import DeckError
from mudline.language.keywords.faults import DocumentPath
from mudline.language.keywords.table import Table
from mudline.language.keywords.writer import joined
from mudline.language.syntax.source import Source

try:
    from yaml import CSafeDumper as _SafeDumper
    from yaml import CSafeLoader as _SafeLoader
except ImportError:  # PyYAML without its C library
    from yaml import SafeDumper as _SafeDumper  # type: ignore[assignment]
    from yaml import SafeLoader as _SafeLoader  # type: ignore[assignment]

_TOO_DEEP = "nested too deeply: is this a deck?"
_TAG = "tag:yaml.org,2002:"
# the tables of section 10.3.2 of the YAML 1.2.2 specification
_CORE: dict[str, tuple[str, list[str]]] = {
    "null": (r"^(?:null|Null|NULL|~|)$", ["n", "N", "~", ""]),
    "bool": (r"^(?:true|True|TRUE|false|False|FALSE)$", list("tTfF")),
    "int": (r"^(?:[-+]?[0-9]+|0o[0-7]+|0x[0-9a-fA-F]+)$", list("-+0123456789")),
    "float": (
        r"^(?:[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-9]+)?|[-+]?\.(?:inf|Inf|INF)|\.(?:nan|NaN|NAN))$",
        list("-+.0123456789"),
    ),
}


def _resolvers() -> dict[str, list[tuple[str, re.Pattern[str]]]]:
    table: dict[str, list[tuple[str, re.Pattern[str]]]] = {}
    for name, (pattern, firsts) in _CORE.items():
        for first in firsts:
            table.setdefault(first, []).append((_TAG + name, re.compile(pattern)))
    return table


_OTHER_BREAK = re.compile("[\x85\u2028\u2029]")
"""Ends of lines for YAML 1.1, but not for YAML 1.2 nor for an editor; between double quotes they are escaped."""


def _quoted() -> dict[str, list[tuple[str, re.Pattern[str]]]]:
    ours, older = _resolvers(), _SafeDumper.yaml_implicit_resolvers
    return {first: [*ours.get(first, []), *older.get(first, [])] for first in ours.keys() | older.keys()}


class CoreLoader(_SafeLoader):
    """Reads plain scalars by the core schema."""

    yaml_implicit_resolvers = _resolvers()


class CoreDumper(_SafeDumper):
    """Quotes what the core schema would read as something else, and what readers of YAML 1.1 would: on, 1:30, =."""

    yaml_implicit_resolvers = _quoted()


def scalar(node: yaml.ScalarNode) -> Any:
    """The value of a scalar node; raises ValueError for a tag outside the core schema or a number out of range."""
    text = node.value
    match node.tag.removeprefix(_TAG):
        case "str":
            return text
        case "null":
            return None
        case "bool":
            return text.lower() == "true"
        case "int":
            if len(text) > LONGEST_NUMBER:
                raise ValueError(f"a whole number of {len(text)} digits is too large")
            return int(text, 8 if text.startswith("0o") else 16 if text.startswith("0x") else 10)
        case "float":
            value = float(text) if "n" not in text.lower() else math.nan
            if not math.isfinite(value):
                raise ValueError(f"{text} is not a finite number")
            return value
    raise ValueError(f"the tag {node.tag} is not used in a deck")


SHORT_TABLE = 20
"""Tables up to this many rows are lists; longer ones a block of text, a row a line."""


def to_yaml(deck: Deck) -> str:
    """The deck as YAML text."""
    return yaml.dump(_node(to_document(deck)), Dumper=_Dumper, sort_keys=False, allow_unicode=True, width=2**30)


write = to_yaml  # as `dump` knows it


class _Literal(str):
    """Text that is written as a literal block."""

    __slots__ = ()


class _Flow(list[Any]):
    """A list that is written on one line."""


class _Dumper(CoreDumper):
    """Literal blocks, rows on one line, the shortest numbers that read back."""


_Dumper.add_representer(_Literal, lambda dumper, text: dumper.represent_scalar(_TAG + "str", str(text), style="|"))
_Dumper.add_representer(_Flow, lambda dumper, row: dumper.represent_sequence(_TAG + "seq", row, flow_style=True))
_Dumper.add_representer(float, lambda dumper, value: dumper.represent_scalar(_TAG + "float", _with_point(repr(value))))
_Dumper.add_representer(
    str,
    lambda dumper, text: dumper.represent_scalar(_TAG + "str", text, style='"' if _OTHER_BREAK.search(text) else None),
)
_Dumper.add_representer(type(None), lambda dumper, _: dumper.represent_scalar(_TAG + "null", "null"))


def _with_point(number: str) -> str:
    """A number with a decimal point, without which YAML 1.1 takes 1e+16 for a text."""
    return number if "." in number else number.replace("e", ".0e")


def _node(value: Any) -> Any:
    """The document with its tables and rows marked for the dumper."""
    if isinstance(value, dict):
        return {key: _node(item) for key, item in value.items()}
    if isinstance(value, Table):
        if len(value) > SHORT_TABLE:
            return _Literal("".join(f"{piece}\n" for piece in value.lines(joined)))
        return [_Flow(row) for row in value.rows()]
    if not isinstance(value, list) or not value or isinstance(value[0], str):
        return value
    return [_node(item) for item in value] if isinstance(value[0], dict | list) else _Flow(value)


def read(data: bytes, file: str) -> Deck:
    """The deck of a file's content.

    Raises DeckError for what is not YAML, has a key twice or an alias, or breaks the schema.
    """
    text = decoded(data, file, "YAML")
    try:
        _look_over(text, file)
        root = yaml.compose(text, Loader=CoreLoader)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        # newer versions of the C library count the levels themselves, before the first event of a flow is there
        deep = "nesting depth" in str(error.problem)
        message = _TOO_DEEP if deep else f"not valid YAML: {error.problem}"
        raise refusal(file, message, mark_range(text, mark)) from error
    except yaml.YAMLError as error:
        raise refusal(file, f"not valid YAML: {str(error).partition(chr(10))[0]}") from error
    document = None if root is None else _Reader(file, text).value(root)
    return from_document(document, file, locator(text, root))


def _look_over(text: str, file: str) -> None:
    """Refuse aliases, which could make a short file endless, and nesting that would exhaust the composer's stack."""
    depth = 0
    for event in yaml.parse(text, Loader=CoreLoader):
        depth += isinstance(event, yaml.CollectionStartEvent) - isinstance(event, yaml.CollectionEndEvent)
        if depth > DEEPEST:
            raise refusal(file, _TOO_DEEP, mark_range(text, event.start_mark))
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
                raise self._error(key_node, f"the key {key!r} is given twice in one mapping")
            values[key] = self.value(value_node)
        return values

    def _error(self, node: yaml.Node, message: str) -> DeckError:
        return refusal(self.file, message, mark_range(self.text, node.start_mark))


class Mark(Protocol):
    """A place that the parser tells, whether its C library or its Python one; counted from 0."""

    index: int


def mark_range(text: str, mark: Mark | None) -> Range:
    """Line and column of a mark; none is at the start of the text."""
    if mark is None:
        return START
    place = Source("", text).position(mark.index)  # the parser counts by other line ends, too
    return Range(*place, *place)


def locator(text: str, root: yaml.Node | None) -> Locate:
    """A function that finds the place of a path, or of the nearest thing around it."""
    source = Source("", text)
    known: dict[int, dict[str, yaml.Node]] = {}
    rows: dict[int, list[int]] = {}

    def inner(node: yaml.Node, part: str | int) -> yaml.Node | None:
        if isinstance(node, yaml.MappingNode) and isinstance(part, str):
            if id(node) not in known:
                known[id(node)] = {key.value: value for key, value in node.value if isinstance(key, yaml.ScalarNode)}
            return known[id(node)].get(part)
        if isinstance(node, yaml.SequenceNode) and isinstance(part, int) and part < len(node.value):
            return cast("yaml.Node", node.value[part])
        return None

    def locate(path: DocumentPath) -> Range:
        node = root
        if node is None:
            return START
        for part in path:
            below = inner(node, part)
            if below is None:
                if isinstance(node, yaml.ScalarNode) and node.style == "|" and isinstance(part, int):
                    first = source.position(node.start_mark.index)[0] + 1
                    if id(node) not in rows:
                        lines = enumerate(node.value.split("\n"), first)
                        rows[id(node)] = [number for number, line in lines if line.strip()]  # a blank line is not a row
                    number = next(iter(rows[id(node)][part : part + 1]), first)
                    return Range(number, 1, number, 1)
                break
            node = below
        return Range(*source.position(node.start_mark.index), *source.position(node.end_mark.index))

    return locate
