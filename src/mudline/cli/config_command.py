"""Command `mudline config`."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

import click

from mudline.checks.configuration import DEFAULTS, Configured
from mudline.checks.output import visible
from mudline.cli import DONE, options
from mudline.cli.streams import emit, emit_json


@options.command("config")
@click.argument("path", default=".", metavar="[PATH]")
@options.config
@options.isolated
@options.output_format("text", "json")
@options.common
def command(*, path: str, config: str | None, isolated: bool, output_format: str) -> int:
    """Show the configuration of a deck, or of the decks in a directory, with the origin of each value."""
    from mudline.checks.registry import code_fault  # noqa: PLC0415 - of the commands, lint alone needs all rules

    inside = str(Path(path) / "-") if os.path.isdir(path) else path  # noqa: PTH112 - Path raises for a long name
    configuration = Configured(config, isolated, code_fault).of(inside)
    rows: list[tuple[str, Any, str]] = []
    for key, default in DEFAULTS.items():
        if key in configuration.values:
            file, line = configuration.origins[key]
            rows.append((key, configuration.values[key], f"{file.as_posix()}:{line}"))
        else:
            rows.append((key, default, "default"))
    if output_format == "json":
        emit_json([dict(zip(("key", "value", "from"), row, strict=True)) for row in rows])
    else:
        emit(
            f"{key} = {visible(json.dumps(value, ensure_ascii=False))}  # {visible(origin)}\n"
            for key, value, origin in rows
        )
    return DONE
