"""YAML 1.2, core schema, on PyYAML's events: what a plain scalar means is set here."""

from __future__ import annotations

import math
import re
from typing import Protocol, cast

import yaml

LOADER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
"""What cuts a text into events: the C library where PyYAML has it."""
DUMPER = getattr(yaml, "CSafeDumper", yaml.SafeDumper)

_TAG = "tag:yaml.org,2002:"
# the tables of section 10.3.2 of the YAML 1.2.2 specification
_PLAIN = re.compile(
    r"(?P<null>null|Null|NULL|~|)"
    r"|(?P<bool>true|True|TRUE|false|False|FALSE)"
    r"|(?P<int>[-+]?[0-9]+|0o[0-7]+|0x[0-9a-fA-F]+)"
    r"|(?P<float>[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-9]+)?|[-+]?\.(?:inf|Inf|INF)|\.(?:nan|NaN|NAN))"
)


class Mark(Protocol):
    """A place in the text: line and column, both from 0."""

    line: int
    column: int


def start_of(event: yaml.Event) -> Mark:
    """Where an event begins."""
    return cast("Mark", event.start_mark)


def end_of(event: yaml.Event) -> Mark:
    """Where an event ends."""
    return cast("Mark", event.end_mark)


Scalar = str | int | float | bool | None


def plain_kind(text: str) -> str:
    """What a plain scalar is: "null", "bool", "int", "float" or "str"."""
    match = _PLAIN.fullmatch(text)
    return str(match.lastgroup) if match else "str"


def scalar(event: yaml.ScalarEvent) -> Scalar:
    """The value of a scalar; raises ValueError for a tag outside the core schema, or one that does not fit the text."""
    text: str = event.value
    kind = event.tag.removeprefix(_TAG) if event.tag else plain_kind(text) if event.implicit[0] else "str"
    if kind in ("str", "!"):
        return text
    if kind != plain_kind(text) and (kind, plain_kind(text)) != ("float", "int"):
        known = kind in _PLAIN.groupindex
        raise ValueError(f"{text!r} is no {kind}" if known else f"the tag {event.tag} is not used in a deck")
    match kind:
        case "null":
            return None
        case "bool":
            return text.lower() == "true"
        case "int":
            return _whole(text)
    return float(text) if "n" not in text.lower() else math.nan if "a" in text.lower() else math.inf


def _whole(text: str) -> int:
    base = {"0o": 8, "0x": 16}.get(text[:2], 10)
    try:
        return int(text, base)
    except ValueError as error:
        raise ValueError("a whole number of thousands of digits: is this a deck?") from error
