"""Whether a deck is legal: the verdict on one, and the total of many."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import NamedTuple

from mudline.cli.inputs import Input
from mudline.codes.contact import SBD006
from mudline.deck.loading import load_bytes
from mudline.diagnostics import DeckError, Diagnostic, Problem, Severity
from mudline.linting.engine import grouped_problems, unsuppressed
from mudline.linting.registry import rules, select
from mudline.linting.rule import LintContext
from mudline.results.warnings import seabed_warnings
from mudline.short_repr import counted


@dataclass(frozen=True, slots=True)
class Verdict:
    """Counts of a deck, and "legal", "legal, 3 warnings", "illegal" or, for a file without any section, "empty"."""

    file: str
    sections: int
    keywords: int
    curves: int
    elements: int
    errors: int
    warnings: int
    verdict: str

    @property
    def legal(self) -> bool:
        """Whether the deck is legal, with warnings or without."""
        return self.verdict.startswith("legal")


@dataclass(slots=True)
class Total:
    """Decks by verdict, their errors and warnings, and the files that could not be read, which are not counted."""

    decks: int = 0
    legal: int = 0
    illegal: int = 0
    empty: int = 0
    errors: int = 0
    warnings: int = 0
    unreadable: int = 0

    def add(self, verdict: Verdict) -> None:
        """Count one more deck."""
        self.decks += 1
        self.legal += verdict.legal
        self.illegal += verdict.verdict == "illegal"
        self.empty += verdict.verdict == "empty"
        self.errors += verdict.errors
        self.warnings += verdict.warnings

    def __str__(self) -> str:
        """The total for a reader, without counts of zero."""
        others = [
            f"{self.illegal} illegal" if self.illegal else "",
            f"{self.empty} empty" if self.empty else "",
            counted(self.errors, "error") if self.errors else "",
            counted(self.warnings, "warning") if self.warnings else "",
            f"{counted(self.unreadable, 'file')} unreadable" if self.unreadable else "",
        ]
        rest = ", ".join(filter(None, others))
        return f"{self.legal} of {counted(self.decks, 'deck')} legal" + (f": {rest}" if rest else "")


class Judged(NamedTuple):
    """A deck with its errors, the warnings too where they are asked for, and its content, which is not kept."""

    verdict: Verdict
    found: list[Diagnostic]
    data: bytes


class Order(NamedTuple):
    """What `judge_order` is given, in any process; `here` is the working folder of the command."""

    data: bytes
    file: Input
    units: str | None
    verbose: bool
    here: str


def judge_order(order: Order) -> tuple[Verdict, list[Diagnostic]]:
    """The verdict on a deck and its findings as they are to be shown."""
    return judge(order.data, order.file.seen_from(order.here), order.units, verbose=order.verbose)


def judge(data: bytes, file: Input, units: str | None, *, verbose: bool) -> tuple[Verdict, list[Diagnostic]]:
    """The verdict on the content of a file and its errors; `verbose` adds the warnings."""
    try:
        deck = load_bytes(data, file.name, units=units, folder=file.folder)
    except DeckError as error:
        return Verdict(file.name, 0, 0, 0, 0, len(error.diagnostics), 0, "illegal"), list(error.diagnostics)
    context = LintContext(deck)
    problems = grouped_problems(context, rules(), suppress=False)
    errors = deck.diagnose([one for one in problems if one.weight is Severity.ERROR])
    warnings = _warnings(context, problems, legal=not errors)
    keywords = sum(len(section.blocks) for section in deck.sections)
    curves, elements = len(context.scene.laws.curves), len(context.scene.element_ids)
    behind = f", {counted(len(warnings), 'warning')}" if warnings else ""
    verdict = "illegal" if errors else f"legal{behind}" if deck.sections else "empty"
    counts = (len(deck.sections), keywords, curves, elements, len(errors), len(warnings))
    found = sorted([*errors, *warnings], key=lambda one: one.sort_key) if verbose else errors
    return Verdict(deck.file, *counts, verdict), found


def _warnings(context: LintContext, problems: list[Problem], *, legal: bool) -> list[Diagnostic]:
    """What lint warns of, and of a legal deck what evaluating it at its own coordinates adds to that."""
    codes = _default_codes()
    kept = unsuppressed(context, problems, rules())
    found = [one for one in kept if one.weight is Severity.WARNING and one.code.code in codes]
    reported = {one.code.code for one in problems if one.weight is Severity.WARNING}
    more = seabed_warnings(context.scene) if legal and SBD006.code not in reported else []
    return [*context.deck.diagnose(found), *(one.diagnostic for one in more if one.diagnostic.code not in reported)]


@cache
def _default_codes() -> frozenset[str]:
    """The codes of the rules that lint runs unless it is asked for others."""
    return frozenset(rule.code.code for rule in select())
