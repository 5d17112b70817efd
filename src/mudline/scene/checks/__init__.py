"""What makes a deck illegal, doubtful, or impossible to evaluate: checks of a resolved deck, a module for each subject.

What reading and resolving notice on their way needs no function and is declared in `mudline.codes`.
All modules in here are imported.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING, NamedTuple

from mudline.diagnostics import MORE, Code, Problem
from mudline.limits import MOST_REPORTED
from mudline.resources import modules_of

if TYPE_CHECKING:
    from mudline.scene.resolved import ResolvedDeck


Find = Callable[["ResolvedDeck"], Iterable[Problem]]


class Check(NamedTuple):
    """A function that finds problems of a code in a scene; each says whether it keeps the deck from being evaluated.

    The page is the docstring of the function, unless the code has one.
    """

    code: Code
    find: Find


CHECKS: list[Check] = []
"""Those of the modules that were imported."""


def check(code: Code) -> Callable[[Find], Find]:
    """Declare a function as a check; for the form of its docstring see `mudline.linting.rule.rule`."""

    def declare(find: Find) -> Find:
        CHECKS.append(Check(code, find))
        return find

    return declare


@cache
def all_checks() -> tuple[Check, ...]:
    """Every check of a scene: what the modules of this package declare."""
    modules_of("mudline.scene.checks")
    return tuple(CHECKS)


def checked(scene: ResolvedDeck) -> list[Problem]:
    """What all checks find, of each without the rest where it is very much."""
    found: list[Problem] = []
    for one in all_checks():
        most = len(found) + MOST_REPORTED
        for problem in one.find(scene):
            if len(found) == most:
                found.append(replace(problem, message=MORE))
                break
            found.append(problem)
    return found
