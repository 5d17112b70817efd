"""`mudline schema`."""

from __future__ import annotations

import json

import click

from mudline.cli import options
from mudline.cli.exits import DONE
from mudline.cli.streams import emit
from mudline.deck.schema import json_schema


@click.command("schema")
@options.common
def command() -> int:
    """Print the JSON Schema of a deck in JSON or YAML, as `mudline convert` writes it."""
    emit([json.dumps(json_schema(), indent=1, ensure_ascii=False), "\n"])
    return DONE
