"""The verdict on a deck: legal or not, with how many warnings, and how much of it was read."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import NamedTuple

from mudline.basics.short_repr import counted
from mudline.checks.context import LintContext
from mudline.checks.engine import joined_problems, unsuppressed
from mudline.checks.registry import rules, select
from mudline.checks.rules.load_cases import SYN019
from mudline.language.codes.contact import SBD006
from mudline.language.deck.loading import coverage_of, load_bytes
from mudline.language.diagnostics import Coverage, DeckError, Diagnostic, Problem, Severity
from mudline.model.results.warnings import seabed_warnings


@dataclass(frozen=True, slots=True)
class Verdict:
    """Counts of a deck, and "legal", "legal, 3 warnings", "illegal" or, for a file without any section, "empty".

    A deck that was not read as a whole is "legal as far as read: 31 of 38 keywords, 5 in part; not read: *GUIDE (2)".
    """

    file: str
    sections: int
    keywords: Coverage
    curves: int
    elements: int
    errors: int
    warnings: int
    verdict: str

    @property
    def legal(self) -> bool:
        """Whether the deck is legal, with warnings or without, as far as it was read."""
        return self.verdict.startswith("legal")

    @property
    def short(self) -> str:
        """The verdict without what was read, in as few words as a table has place for."""
        return self.verdict.partition(":")[0].replace("legal as far", "as far")


class Judgement(NamedTuple):
    """A verdict, and what it rests on."""

    verdict: Verdict
    errors: list[Diagnostic]
    warnings: list[Diagnostic]


def refused(file: str, error: DeckError) -> Verdict:
    """The verdict on a file that holds no deck."""
    return Verdict(file, 0, Coverage(), 0, 0, len(error.diagnostics), 0, "illegal")


def all_findings(context: LintContext) -> list[Problem]:
    """Return the findings of all rules in a deck, those too that its comments suppress."""
    return joined_problems(context, rules(), suppress=False)


def errors_of(problems: list[Problem]) -> list[Problem]:
    """Return those of all findings in a deck that make it illegal, the same in every command."""
    return [one for one in problems if one.weight is Severity.ERROR]


def judge(context: LintContext) -> Judgement:
    """The verdict on a deck, by all rules of severity error and the warnings of the default ones."""
    deck = context.deck
    problems = all_findings(context)
    errors = deck.diagnose(errors_of(problems))
    keywords = coverage_of(deck)
    known = {(one.code, one.line) for one in errors}
    warnings = [one for one in _warnings(context, problems, legal=not errors) if (one.code, one.line) not in known]
    curves, elements = len(context.scene.laws.curves), len(context.scene.element_ids)
    empty = [one.code for one in errors] == [SYN019.code]
    verdict = "empty" if empty else "illegal" if errors else _legal(len(warnings), keywords)
    counts = (len(deck.sections), keywords, curves, elements, len(errors), len(warnings))
    return Judgement(Verdict(deck.file, *counts, verdict), errors, warnings)


def judge_content(data: bytes, name: str, units: str | None, folder: Path | None) -> Judgement:
    """The verdict on the content of a file, in whatever form; `folder` is where files are that the deck names."""
    try:
        deck = load_bytes(data, name, units=units, folder=folder)
    except DeckError as error:
        return Judgement(refused(name, error), list(error.diagnostics), [])
    return judge(LintContext(deck))


def _legal(warnings: int, keywords: Coverage) -> str:
    """The verdict on a deck without errors."""
    behind = f", {counted(warnings, 'warning')}" if warnings else ""
    return f"legal{behind}" if keywords.whole else f"legal as far as read{behind}: {keywords}"


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
