"""Writing an output file."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

import click

from mudline.cli.streams import encoded
from mudline.cli.terminal import reason
from mudline.files import replacement


@contextmanager
def writing(path: Path) -> Iterator[BinaryIO]:
    """A stream whose content becomes the file in one step; ends the command when that is not possible."""
    try:
        with replacement(path) as stream:
            yield stream
    except OSError as error:
        raise click.ClickException(f"{path}: cannot be written: {reason(error)}") from error


def write_bytes(path: Path, data: bytes) -> None:
    """Write a file's content."""
    with writing(path) as stream:
        stream.write(data)


def write_text(path: Path, pieces: Iterable[str]) -> None:
    """Write a text in pieces, as UTF-8."""
    with writing(path) as stream:
        stream.writelines(encoded(piece) for piece in pieces)
