"""The forms in which findings are given to programs, and where each goes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import click

from mudline import __version__
from mudline.cli.writing import write_text
from mudline.diagnostics import Diagnostic
from mudline.linting.output.formats import TEXT, form, form_names


@dataclass(frozen=True, slots=True)
class Outputs:
    """The form of standard output, and the files besides."""

    form: str
    files: tuple[tuple[str, Path], ...]

    def write_files(self, found: Sequence[Diagnostic], files: Sequence[str]) -> None:
        """Write the findings in the files linted; ends the command when that is not possible."""
        for name, path in self.files:
            write_text(path, form(name, files, __version__)(found))


def complete(_context: click.Context, _parameter: click.Parameter, incomplete: str) -> list[str]:
    """What a shell completes behind `--output-format`."""
    return [name for name in (TEXT, *form_names()) if name.startswith(incomplete)]


def outputs(given: Sequence[str]) -> Outputs:
    """What `--output-format` asks for: FORM, or FORM=FILE. Raises click.UsageError."""
    known = [TEXT, *form_names()]
    printed: list[str] = []
    files: list[tuple[str, Path]] = []
    for word in given:
        name, mark, path = word.partition("=")
        if name not in known:
            raise click.UsageError(f"--output-format: {name!r} is not one of {', '.join(known)}")
        if not mark:
            printed.append(name)
        elif not path or name == TEXT:
            what = "text goes to the terminal: write concise=FILE" if path else f"write a file name behind {name}="
            raise click.UsageError(f"--output-format {word}: {what}")
        else:
            files.append((name, Path(path)))
    if len(set(printed)) > 1:
        raise click.UsageError(f"--output-format: standard output takes one form, not {', '.join(printed)}")
    return Outputs(printed[0] if printed else TEXT, tuple(files))
