"""Notes and errors on standard error."""

from __future__ import annotations

from collections.abc import Sequence

import click

from mudline.diagnostics import Diagnostic
from mudline.linting.output.visible import visible, visible_lines

MOST_TOLD = 20
"""Reasons why a deck cannot be used; the rest is counted."""


def tell(message: str) -> None:
    """A note."""
    click.echo(f"mudline: {visible_lines(message)}", err=True)


def tell_diagnostics(diagnostics: Sequence[Diagnostic]) -> None:
    """Why a deck cannot be used."""
    for found in diagnostics[:MOST_TOLD]:
        place = visible(f"{found.file}:{found.line}:{found.column}")
        click.echo(f"{place}: {found.severity}: {found.code} {visible(found.message)}", err=True)
    if len(diagnostics) > MOST_TOLD:
        tell(f"{len(diagnostics) - MOST_TOLD} more errors: mudline lint shows all")


def reason(error: OSError) -> str:
    """Why a file could not be read or written, in words."""
    return (error.strerror or str(error)).lower()
