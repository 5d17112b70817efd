"""Rules about what makes a deck illegal, doubtful, or impossible to evaluate, a module for each subject.

What reading and resolving notice on their way needs no function and is declared in `mudline.language.codes`.
All modules in here are imported.
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from mudline.basics.resources import modules_of
from mudline.language.rules import RULES, Rule, findings

if TYPE_CHECKING:
    from mudline.language.diagnostics import Problem
    from mudline.model.scene.resolved import ResolvedDeck


@cache
def _rules() -> tuple[Rule, ...]:
    modules_of("mudline.model.scene.rules")
    return tuple(one for one in RULES.values() if one.blocks)


def checked(scene: ResolvedDeck) -> list[Problem]:
    """Return what all rules that block find, of each without the rest where it is very much."""
    return [problem for found in findings(_rules(), scene).values() for problem in found]
