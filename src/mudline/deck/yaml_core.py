"""YAML 1.2, core schema, on PyYAML's parser: what a plain scalar means is set here."""

from __future__ import annotations

import math
import re
from typing import Any

import yaml

try:
    from yaml import CSafeDumper as _Dumper
    from yaml import CSafeLoader as _Loader
except ImportError:  # PyYAML without its C library
    from yaml import SafeDumper as _Dumper  # type: ignore[assignment]
    from yaml import SafeLoader as _Loader  # type: ignore[assignment]

_MOST_DIGITS = 400
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


class CoreLoader(_Loader):
    """Reads plain scalars by the core schema."""

    yaml_implicit_resolvers = _resolvers()


class CoreDumper(_Dumper):
    """Quotes what the core schema would read as something else."""

    yaml_implicit_resolvers = _resolvers()


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
            if len(text) > _MOST_DIGITS:
                raise ValueError(f"a whole number of {len(text)} digits is too large")
            return int(text, 8 if text.startswith("0o") else 16 if text.startswith("0x") else 10)
        case "float":
            value = float(text) if "n" not in text.lower() else math.nan
            if not math.isfinite(value):
                raise ValueError(f"{text} is no finite number")
            return value
    raise ValueError(f"the tag {node.tag} is not used in a deck")
