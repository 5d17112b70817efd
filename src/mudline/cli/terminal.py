"""Notes and errors on standard error."""

from __future__ import annotations

from collections.abc import Sequence

import click

from mudline.diagnostics import Diagnostic


def tell(message: str) -> None:
    """A note."""
    click.echo(f"mudline: {message}", err=True)


def tell_diagnostics(diagnostics: Sequence[Diagnostic]) -> None:
    """Why a deck cannot be used."""
    for found in diagnostics:
        place = f"{found.file}:{found.line}:{found.column}"
        click.echo(f"{place}: {found.severity}: {found.code} {found.message}", err=True)
