"""The forms of findings, a module each, imported when it is asked for. A module is a form by being here.

It has the name of the form and holds what `FormModule` says.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from importlib import import_module
from pkgutil import iter_modules
from typing import Protocol, cast

from mudline.diagnostics import Diagnostic

TEXT = "text"
"""The form for people, which goes to the terminal as the findings come."""

TEXT_SUMMARY = "for people: place, message, the source line with a mark; standard output only"


@dataclass(frozen=True, slots=True)
class LintRun:
    """What a form may say besides the findings: the files linted, in their order, and the version of mudline."""

    files: Sequence[str]
    version: str


class FormModule(Protocol):
    """What the module of a form holds: a sentence for the documentation, and what makes its text."""

    SUMMARY: str

    def write(self, diagnostics: Iterable[Diagnostic], run: LintRun) -> Iterator[str]:
        """Return the text of findings in pieces."""


def form_names() -> list[str]:
    """Return the name of every form but text, found without importing one."""
    return sorted(found.name for found in iter_modules(__path__))


def form_module(name: str) -> FormModule:
    """Return the module of a form."""
    return cast("FormModule", import_module(f"{__name__}.{name}"))


def form(name: str, files: Sequence[str], version: str) -> Callable[[Iterable[Diagnostic]], Iterator[str]]:
    """Return the function that makes the text of findings in a form; `files` and `version` are those of `LintRun`."""
    return partial(form_module(name).write, run=LintRun(files, version))
