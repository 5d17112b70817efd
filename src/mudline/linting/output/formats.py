"""The forms of findings by name; the module of a form is imported when the form is asked for."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import partial
from importlib import import_module
from typing import cast

from mudline.diagnostics import Diagnostic

Form = Callable[[Iterable[Diagnostic]], Iterable[str]]

FORMS = {
    "concise": ("concise", "concise"),
    "json": ("json_objects", "json_array"),
    "jsonl": ("json_objects", "json_lines"),
    "github": ("github", "github"),
    "gitlab": ("gitlab", "gitlab"),
    "junit": ("junit", "junit"),
    "sarif": ("sarif", "sarif"),
}
"""Module beside this one and function of every form but text."""


def form(name: str, files: Sequence[str], version: str) -> Form:
    """The function that makes the text of findings in a form.

    `files` are those linted, which JUnit lists; `version` is that of mudline, which SARIF tells.
    """
    module, function = FORMS[name]
    found = getattr(import_module(f"mudline.linting.output.{module}"), function)
    if name == "junit":
        return partial(found, files=files)
    return cast("Form", partial(found, version=version) if name == "sarif" else found)
