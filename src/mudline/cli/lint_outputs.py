"""The forms in which findings are given to programs, and where each goes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import cast

import click

from mudline.cli.writing import write_text
from mudline.diagnostics import Diagnostic

Form = Callable[[Iterable[Diagnostic]], Iterable[str]]

TEXT = "text"
FORMS = {
    "concise": ("concise", "concise"),
    "json": ("json_objects", "json_array"),
    "jsonl": ("json_objects", "json_lines"),
}
"""Module of `mudline.linting.output` and function of every form but text; a module is imported when it is asked for."""


def form(name: str) -> Form:
    """The function that makes the text of findings in a form."""
    module, function = FORMS[name]
    return cast("Form", getattr(import_module(f"mudline.linting.output.{module}"), function))


@dataclass(frozen=True, slots=True)
class Outputs:
    """The form of standard output, and the files besides."""

    form: str
    files: tuple[tuple[str, Path], ...]

    def write_files(self, found: Sequence[Diagnostic]) -> None:
        """Write the findings to the files; ends the command when that is not possible."""
        for name, path in self.files:
            write_text(path, form(name)(found))


def outputs(given: Sequence[str]) -> Outputs:
    """What `--output-format` asks for: FORM, or FORM=FILE. Raises click.UsageError."""
    printed: list[str] = []
    files: list[tuple[str, Path]] = []
    for word in given:
        name, mark, path = word.partition("=")
        if name not in FORMS and name != TEXT:
            raise click.UsageError(
                f"--output-format: there is no form {name!r}: choose from {TEXT}, {', '.join(FORMS)}"
            )
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
