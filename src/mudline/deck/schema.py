"""The JSON Schema of a deck in JSON or YAML: exactly what `to_json` and `to_yaml` write."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from pydantic import BaseModel
from pydantic.json_schema import models_json_schema

from mudline.deck.document import DeckDocument, SectionDocument
from mudline.deck.model import Opaque
from mudline.keywords import catalogue
from mudline.keywords.model import Block

DIALECT = "https://json-schema.org/draft/2020-12/schema"
_REFERENCE = "#/$defs/{model}"

Schema = dict[str, Any]


def json_schema() -> Schema:
    """The schema: the document, its sections, every block with a model in its section, and blocks without one."""
    blocks = [catalogue.load(module) for module in catalogue.modules()]
    models: list[type[BaseModel]] = [DeckDocument, SectionDocument, Opaque, *blocks]
    _, made = models_json_schema([(model, "validation") for model in models], ref_template=_REFERENCE)
    definitions: dict[str, Schema] = made["$defs"]
    for block in blocks:
        _name_block(definitions[block.__name__], block)
    section = definitions.pop(SectionDocument.__name__)
    sections = {name: list(_modelled(name, blocks)) for name in catalogue.SECTIONS}
    modelled = {name: found for name, found in sections.items() if found}
    for name, found in modelled.items():
        definitions[_definition(name)] = _section(section, {"const": name}, found)
    rest = {**section["properties"]["name"], "not": {"enum": list(modelled)}}
    definitions["OtherSection"] = _section(section, rest, [])
    document = definitions.pop(DeckDocument.__name__)
    document["properties"]["sections"]["items"] = {"anyOf": _references([*map(_definition, modelled), "OtherSection"])}
    return {"$schema": DIALECT, **document, "title": "mudline deck", "$defs": dict(sorted(definitions.items()))}


def _name_block(definition: Schema, block: type[Block]) -> None:
    """A program may leave the keyword of a block out; a document may not."""
    definition["description"] = block.summary
    definition["required"] = ["keyword", *definition.get("required", [])]


def _modelled(section: str, blocks: Iterable[type[Block]]) -> Iterable[type[Block]]:
    """The blocks that have a model in a section."""
    return (block for block in blocks if any(catalogue.block_class(section, name) is block for name in block.names))


def _section(schema: Schema, name: Schema, blocks: Sequence[type[Block]]) -> Schema:
    """A section of a name: each keyword with a model has that, all others are kept line by line."""
    keywords = [name for block in blocks for name in block.names]
    opaque: Schema = {"$ref": _REFERENCE.format(model=Opaque.__name__)}
    if keywords:
        opaque["properties"] = {"keyword": {"not": {"enum": keywords}}}
    items = {"anyOf": [*_references(block.__name__ for block in blocks), opaque]}
    properties = {**schema["properties"], "name": name, "blocks": {"type": "array", "items": items}}
    return {**schema, "properties": properties}


def _definition(section: str) -> str:
    """`MODEL` to `ModelSection`."""
    return section.title().replace(" ", "") + "Section"


def _references(names: Iterable[str]) -> list[Schema]:
    return [{"$ref": _REFERENCE.format(model=name)} for name in names]
