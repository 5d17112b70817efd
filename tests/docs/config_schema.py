"""docs/schemas/config.json: the keys of a mudline.toml, for editors, from the table of the configuration."""

from __future__ import annotations

import json
from typing import Any

from mudline.linting.configuration import _OF_CODES, _SEVERITIES, KEYS, LISTS, WORDS
from mudline.linting.registry import origin, rules

CONFIG_SCHEMA = "docs/schemas/config.json"

MEANINGS = {
    "select": "Only these rules run: codes, beginnings of codes, or slugs.",
    "ignore": "Rules that are left out.",
    "extend-select": "Rules that run too.",
    "include": "Patterns of files taken from a searched directory besides those with a deck's suffix.",
    "exclude": "Patterns of files left out of a searched directory.",
    "fixable": "Rules whose fixes are made.",
    "unfixable": "Rules whose fixes are never made.",
    "fail-on": "The least severity that fails a run; warning unless set.",
    "dialect": "The program that the decks are for.",
    "per-file-ignores": "Rules that are left out in the files that fit a pattern.",
    "severity": "Severities that hold instead of the rules' own; off leaves a rule out.",
}
"""What each key means."""


def config_schema() -> str:
    """The whole file."""
    properties = {key: {"description": MEANINGS[key], **_values(key)} for key in KEYS}
    schema = {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "mudline.toml, or [tool.mudline] of a pyproject.toml",
        "type": "object",
        "properties": properties,
        "additionalProperties": False,
        "definitions": {"rule": _rule()},
    }
    return json.dumps(schema, indent=1, ensure_ascii=False) + "\n"


def _values(key: str) -> dict[str, Any]:
    if key in WORDS:
        return {"enum": list(WORDS[key])}
    if key in LISTS:
        return _list(_code() if key in _OF_CODES else {"type": "string", "pattern": "\\S"})
    values = {"enum": list(_SEVERITIES)} if key == "severity" else _list(_code())
    names = {"propertyNames": _code()} if key == "severity" else {}
    return {"type": "object", **names, "additionalProperties": values}


def _list(item: dict[str, Any]) -> dict[str, Any]:
    return {"type": "array", "items": item}


def _code() -> dict[str, Any]:
    return {"$ref": "#/definitions/rule"}


def _rule() -> dict[str, Any]:
    """What names rules: an editor offers the families, codes and slugs of mudline, and takes those of plugins too."""
    own = [rule.code for rule in rules() if origin(rule.code.code) == "mudline"]
    families = dict.fromkeys(code.code.rstrip("0123456789") for code in own)
    known = [*families, *(word for code in own for word in (code.code, code.slug))]
    return {"type": "string", "anyOf": [{"enum": known}, {"pattern": "\\S"}]}
