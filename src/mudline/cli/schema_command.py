"""Command `mudline schema`, and the schema of a mudline.toml from configuration keys and rule codes."""

from __future__ import annotations

from typing import Any

import click

from mudline.checks.configuration import DEFAULTS, ENCODING, EXTEND, LISTS, NO_OUTSIDE, OF_CODES, SEVERITIES, WORDS
from mudline.checks.pages import origin
from mudline.cli import DONE, options
from mudline.cli.streams import emit_json
from mudline.language.deck.document import json_schema


@options.command("schema")
@click.argument("what", type=click.Choice(["deck", "config"]), default="deck")
@options.output(type=options.OUTPUT_TEXT, help="Write to this file.")
@options.common
def command(*, what: str, output: str | None) -> int:
    """Print the JSON Schema of a deck in JSON or YAML, as `mudline convert` writes it, or of the configuration.

    With the schema of the configuration, editors complete and check a mudline.toml.
    """
    emit_json(configuration_schema() if what == "config" else json_schema(), output)
    return DONE


# ---------------------------------------------------------------------------------------------------- the configuration

MEANINGS = {
    "extend": "A file with the same keys, relative to this file's folder; its values apply where this file sets none.",
    "select": "The only rules that run: codes, prefixes of codes, or slugs.",
    "ignore": "Rules that are left out.",
    "extend-select": "Further rules that run.",
    "include": "Patterns of files taken from a searched directory besides those with a deck's suffix.",
    "exclude": "Patterns of files left out of a searched directory.",
    "fixable": "Rules whose fixes are made.",
    "unfixable": "Rules whose fixes are never made.",
    "fail-on": "The lowest severity that fails a run; the default is warning.",
    "dialect": "The program for which the decks are written.",
    "no-outside": "If true, decks that name files outside their project are refused.",
    "encoding": "The encoding of keyword decks that are not in UTF-8, as Python names it.",
    "per-file-ignores": "Rules that are left out in files that match a pattern.",
    "severity": "Severities in place of the rules' own; off leaves a rule out.",
}
"""Descriptions of the keys."""


def configuration_schema() -> dict[str, Any]:
    """Return the schema in draft 7, which editors support best; codes of plugins are accepted, but not listed."""
    from mudline.checks.registry import rules  # noqa: PLC0415 - it imports all rules

    own = [rule.code for rule in rules() if origin(rule.code.code) == "mudline"]
    families = dict.fromkeys(code.code.rstrip("0123456789") for code in own)
    known = [*families, *(word for code in own for word in (code.code, code.slug))]
    properties = {key: {"description": MEANINGS[key], **_values(key)} for key in DEFAULTS}
    return {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "mudline.toml, or [tool.mudline] of a pyproject.toml",
        "type": "object",
        "properties": properties,
        "additionalProperties": False,
        "definitions": {"rule": {"type": "string", "anyOf": [{"enum": known}, {"pattern": "\\S"}]}},
    }


_PATH = {"type": "string", "pattern": "\\S"}
_CODE = {"$ref": "#/definitions/rule"}
_CODES = {"type": "array", "items": _CODE}


def _values(key: str) -> dict[str, Any]:
    if key in WORDS:
        return {"enum": list(WORDS[key])}
    if key in LISTS:
        return _CODES if key in OF_CODES else {"type": "array", "items": _PATH}
    values: dict[str, dict[str, Any]] = {
        NO_OUTSIDE: {"type": "boolean"},
        EXTEND: _PATH,
        ENCODING: {"type": "string", "minLength": 1},
        "severity": {
            "type": "object",
            "propertyNames": _CODE,
            "additionalProperties": {"enum": list(SEVERITIES)},
        },
    }
    return values.get(key, {"type": "object", "additionalProperties": _CODES})
