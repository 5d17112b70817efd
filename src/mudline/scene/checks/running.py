"""All checks, and what they find."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from importlib import import_module
from itertools import islice
from typing import TYPE_CHECKING

from mudline.diagnostics import Problem
from mudline.scene.checks.declaring import CHECKS, Check
from mudline.scene.context import MORE, MOST_TOLD

if TYPE_CHECKING:
    from mudline.scene.model import Scene

MODULES = ("laws", "curves", "sections", "ranges", "floor", "files", "extensions", "suction", "trench", "unloading")
"""The modules of this package that declare checks."""


def all_checks() -> list[Check]:
    """Every check of a scene."""
    for module in MODULES:
        import_module(f"mudline.scene.checks.{module}")
    return CHECKS


def checked(scene: Scene) -> list[Problem]:
    """What all checks find."""
    return [problem for check in all_checks() for problem in _first(check, scene)]


def _first(check: Check, scene: Scene) -> Iterator[Problem]:
    """What a check finds, without the rest where it is very much."""
    for count, problem in enumerate(islice(check.find(scene), MOST_TOLD + 1)):
        yield problem if count < MOST_TOLD else replace(problem, message=MORE)
