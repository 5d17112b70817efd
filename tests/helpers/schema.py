"""The JSON Schema of decks, and what holds documents to it."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import TYPE_CHECKING, Any

import pytest

from mudline.language.deck.document import json_schema

if TYPE_CHECKING:
    from jsonschema import Draft202012Validator


@cache
def validator() -> Draft202012Validator:
    """What holds documents to the schema: a block to the form of its keyword alone, not to a hundred others."""
    library = pytest.importorskip("jsonschema")
    schema = json_schema()
    keywords = {
        f"#/$defs/{name}": form["properties"]["keyword"].get("const")
        for name, form in schema["$defs"].items()
        if "keyword" in form.get("properties", ())
    }

    def any_of(validator: object, forms: list[dict[str, Any]], instance: object, within: object) -> Iterator[object]:
        if isinstance(instance, dict) and "keyword" in instance:
            forms = [form for form in forms if keywords.get(form.get("$ref", "")) in (None, instance["keyword"])]
        yield from library.Draft202012Validator.VALIDATORS["anyOf"](validator, forms, instance, within)

    found: Draft202012Validator = library.validators.extend(library.Draft202012Validator, {"anyOf": any_of})(schema)
    return found
