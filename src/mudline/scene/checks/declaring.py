"""How a check is declared."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from mudline.diagnostics import Code, Problem

if TYPE_CHECKING:
    from mudline.scene.model import Scene

Find = Callable[["Scene"], Iterable[Problem]]


@dataclass(frozen=True, slots=True)
class Check:
    """A function that finds problems of a code in a scene; each says whether it keeps the deck from being evaluated.

    The page is the docstring of the function, unless the code has one.
    """

    code: Code
    find: Find


CHECKS: list[Check] = []
"""Those of the modules that were imported."""


def check(code: Code) -> Callable[[Find], Find]:
    """Declare a function as a check; for the form of its docstring see `mudline.linting.registry.rule`."""

    def declare(find: Find) -> Find:
        CHECKS.append(Check(code, find))
        return find

    return declare
