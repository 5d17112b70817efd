"""Joints: what a rule says of its findings and those of others that only follow from them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import NamedTuple

from mudline.checks.context import LintContext
from mudline.language.diagnostics import Code, Problem, Span


class Joined(NamedTuple):
    """A finding and those that say no more than it does; its message and its place may be of all of them."""

    first: Problem
    others: Sequence[Problem]
    words: str = ""
    message: str = ""
    place: Span | None = None


Found = Mapping[str, Sequence[Problem]]
"""The findings in a deck by code."""

Join = Callable[[LintContext, Found], Iterator[Joined]]
JOINTS: list[tuple[frozenset[str], Join]] = []
"""Those of all rules, each with the codes of which the deck must have one."""


def joint(*codes: Code) -> Callable[[Join], Join]:
    """Register what puts findings under those of some codes, beside the rule that reports these."""

    def register(join: Join) -> Join:
        JOINTS.append((frozenset(code.code for code in codes), join))
        return join

    return register
