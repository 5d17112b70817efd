"""`mudline schema`."""

from __future__ import annotations

import click

from mudline.cli import DONE, options
from mudline.cli.streams import emit_json
from mudline.deck.document import json_schema


@click.command("schema")
@click.argument("what", type=click.Choice(["deck", "config"]), default="deck")
@options.common
def command(*, what: str) -> int:
    """Print the JSON Schema of a deck in JSON or YAML, as `mudline convert` writes it, or of the configuration.

    Editors complete and check a mudline.toml by the schema of the configuration.
    """
    if what == "config":
        from mudline.linting.configuration_schema import configuration_schema  # noqa: PLC0415 - it imports all rules

        emit_json(configuration_schema())
    else:
        emit_json(json_schema())
    return DONE
