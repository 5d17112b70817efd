"""What holds for the linting of one file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum

from mudline.diagnostics import Severity
from mudline.linting.registry import Rule


class Fixing(StrEnum):
    """Which fixes are made: none, those that keep what the deck means, or also those that guess."""

    NONE = "none"
    SAFE = "safe"
    UNSAFE = "unsafe"

    def takes(self, applicability: str) -> bool:
        """Whether fixes of an applicability ("safe" or "unsafe") are made."""
        return self is Fixing.UNSAFE or (self is Fixing.SAFE and applicability == "safe")


@dataclass(frozen=True, slots=True)
class LintSettings:
    """Which rules run, how bad their findings are, and what is done about them; it can be pickled.

    `units` None means those that the file tells. `severities` holds by code instead of the rule's own. Findings of
    `fail_on` or worse fail a run. Fixes of the codes in `unfixable` are never made.
    """

    rules: tuple[Rule, ...]
    units: str | None = None
    dialect: str = "mudline"
    severities: Mapping[str, Severity] = field(default_factory=dict)
    fail_on: Severity = Severity.WARNING
    fixing: Fixing = Fixing.NONE
    unfixable: frozenset[str] = frozenset()
