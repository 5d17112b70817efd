"""Writing an output file."""

from __future__ import annotations

from pathlib import Path

import click

from mudline.cli.inputs import reason
from mudline.files import write_atomically


def write(path: Path, data: bytes) -> None:
    """Write a file in one step; ends the command when that is not possible."""
    try:
        write_atomically(path, data)
    except OSError as error:
        raise click.UsageError(f"{path}: cannot be written: {reason(error)}") from error
