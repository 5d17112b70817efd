"""`mudline schema`."""

from __future__ import annotations

import click

from mudline.cli import DONE, options
from mudline.cli.streams import emit_json
from mudline.deck.document import json_schema


@click.command("schema")
@options.common
def command() -> int:
    """Print the JSON Schema of a deck in JSON or YAML, as `mudline convert` writes it."""
    emit_json(json_schema())
    return DONE
