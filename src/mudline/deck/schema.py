"""The JSON Schema of a deck in JSON or YAML: exactly what `to_json` and `to_yaml` write."""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel, TypeAdapter
from pydantic.json_schema import models_json_schema

from mudline.deck.document import FORMAT, UNITS
from mudline.deck.model import Opaque
from mudline.keywords import catalogue
from mudline.keywords.model import Comment
from mudline.keywords.values import Text

DIALECT = "https://json-schema.org/draft/2020-12/schema"
_REFERENCE = "#/$defs/{model}"


def json_schema() -> dict[str, Any]:
    """The schema: document, sections, every block with a model, the block without one.

    In which section a keyword belongs is left to reading, as a deck may hold a keyword in the wrong one.
    """
    blocks = [catalogue.load(module) for module in catalogue.modules()]
    models: list[type[BaseModel]] = [*blocks, Opaque, Comment]
    made, schema = models_json_schema([(model, "validation") for model in models], ref_template=_REFERENCE)
    references = {model: made[model, "validation"] for model in models}
    for block in blocks:
        definition = schema["$defs"][references[block]["$ref"].rsplit("/", 1)[1]]
        definition["required"] = sorted({"keyword", *definition.get("required", [])})
        definition["description"] = block.summary
    comments = {"type": "array", "items": references[Comment]}
    line = TypeAdapter(Text).json_schema()
    lines = {"type": "array", "items": line}
    section = _object(
        {
            "name": {**line, "description": "section name without the $"},
            "lines": {**lines, "description": "stray lines before the first keyword"},
            "comments": comments,
            "blocks": {
                "type": "array",
                "items": {"anyOf": [references[model] for model in models if model is not Comment]},
            },
        },
        required=("name", "blocks"),
    )
    document = _object(
        {
            "format": {"const": FORMAT},
            "source": {"type": "string", "description": "name of the file that the deck was read from"},
            "units": {"enum": list(UNITS)},
            "preamble": {**lines, "description": "lines before the first section"},
            "comments": comments,
            "sections": {"type": "array", "items": {"$ref": "#/$defs/Section"}},
        },
        required=("format", "sections"),
    )
    return {
        "$schema": DIALECT,
        "title": "mudline deck",
        **document,
        "$defs": {**schema["$defs"], "Section": section},
    }


def _object(properties: dict[str, Any], required: tuple[str, ...]) -> dict[str, Any]:
    return {"type": "object", "properties": properties, "required": list(required), "additionalProperties": False}
