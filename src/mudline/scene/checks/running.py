"""All checks, and what they find."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from itertools import islice
from typing import TYPE_CHECKING

from mudline.diagnostics import Problem
from mudline.resources import modules_of
from mudline.scene import checks
from mudline.scene.checks.declaring import CHECKS, Check
from mudline.scene.context import MORE, MOST_TOLD

if TYPE_CHECKING:
    from mudline.scene.model import Scene


@cache
def all_checks() -> tuple[Check, ...]:
    """Every check of a scene: what the modules of this package declare."""
    modules_of(checks)
    return tuple(CHECKS)


def checked(scene: Scene) -> list[Problem]:
    """What all checks find."""
    return [problem for check in all_checks() for problem in _first(check, scene)]


def _first(check: Check, scene: Scene) -> Iterator[Problem]:
    """What a check finds, without the rest where it is very much."""
    for count, problem in enumerate(islice(check.find(scene), MOST_TOLD + 1)):
        yield problem if count < MOST_TOLD else replace(problem, message=MORE)
