"""Verdict on a deck: its errors and warnings, and how much of it was read; its contents, as far as they can be read."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from mudline.basics.short_repr import counted
from mudline.checks.context import LintContext
from mudline.checks.engine import all_findings, errors_of, of_base, unsuppressed
from mudline.checks.registry import rules, select
from mudline.language.codes.contact import SBD006
from mudline.language.deck.loading import coverage_of, load_bytes
from mudline.language.deck.model import Deck
from mudline.language.diagnostics import Blocks, Coverage, DeckError, Diagnostic, Problem, Severity
from mudline.model.results.warnings import seabed_warnings

if TYPE_CHECKING:
    from mudline.model.scene.sheet import Sheet


@dataclass(frozen=True, slots=True)
class Verdict:
    """Counts of a deck: its findings, and how much of it was read.

    Attributes:
        file: name of the file.
        errors: number of findings that make the deck illegal.
        warnings: number of findings that are likely mistakes.
        sections: number of its sections.
        keywords: its keywords by how much of them was read.
        curves: number of its force-embedment curves.
        elements: number of its elements.
    """

    file: str
    errors: int
    warnings: int = 0
    sections: int = 0
    keywords: Coverage = field(default_factory=Coverage)
    curves: int = 0
    elements: int = 0

    @property
    def ok(self) -> bool:
        """True if no rule of severity error found anything."""
        return not self.errors

    @property
    def short(self) -> str:
        """Verdict in short: `2 errors`, `no errors`, or `no errors found` if not all keywords were read."""
        if self.errors:
            return counted(self.errors, "error")
        return "no errors" if self.keywords.whole else "no errors found"

    def __str__(self) -> str:
        """Return the short form; if keywords of a deck without errors are unread, add `(31 of 38 keywords read)`."""
        words = self.keywords
        return self.short if words.whole or self.errors else f"{self.short} ({words.share} read)"

    def row(self) -> dict[str, Any]:
        """Return the verdict as an object of the JSON output."""
        head = {"file": self.file, "ok": self.ok, "verdict": str(self), "errors": self.errors}
        return head | {"warnings": self.warnings, "unread": self.keywords.total - self.keywords.read} | asdict(self)


class Judgement(NamedTuple):
    """Verdict and the findings it rests on."""

    verdict: Verdict
    errors: list[Diagnostic]
    warnings: list[Diagnostic]


def refused(file: str, error: DeckError) -> Verdict:
    """Return the verdict on a file that holds no deck."""
    return Verdict(file, len(error.diagnostics))


def errors_beside(deck: Deck) -> list[Diagnostic]:
    """Return the errors of a deck in spite of which it is evaluated: contact does not depend on them."""
    context = LintContext(deck)
    errors = errors_of(all_findings(context))
    return context.deck.diagnose([error for error in errors if error.blocking is not Blocks.WITH_TENSION])


def judge(context: LintContext) -> Judgement:
    """Return the verdict on a deck, by all rules of severity error and the warnings of the default rules."""
    deck = context.deck
    problems = all_findings(context)
    errors = deck.diagnose(errors_of(problems))
    known = {(each.code, each.line) for each in errors}
    warnings = [each for each in _warnings(context, problems, ok=not errors) if (each.code, each.line) not in known]
    counts = (len(deck.sections), coverage_of(deck), len(context.scene.laws.curves), len(context.scene.element_ids))
    return Judgement(Verdict(deck.file, len(errors), len(warnings), *counts), errors, warnings)


def judge_content(data: bytes, name: str, units: str | None, folder: Path | None) -> Judgement:
    """Return the verdict on the content of a file in any form; `folder` is the folder of files that the deck names."""
    try:
        deck = load_bytes(data, name, units=units, folder=folder)
    except DeckError as error:
        return Judgement(refused(name, error), list(error.diagnostics), [])
    return judge(LintContext(deck))


def _warnings(context: LintContext, problems: list[Problem], *, ok: bool) -> list[Diagnostic]:
    """Return the warnings of lint; for a deck without errors also those of its evaluation at the deck's coordinates."""
    codes = {rule.code.code for rule in select()}
    kept = unsuppressed(context, problems, rules())
    own = [each for each in kept if each.weight is Severity.WARNING and each.code.code in codes]
    reported = {each.code.code for each in problems if each.weight is Severity.WARNING}
    more = seabed_warnings(context.scene) if ok and SBD006.code not in reported else []
    return [*context.deck.diagnose(own), *(each.diagnostic for each in more if each.diagnostic.code not in reported)]


# ------------------------------------------------------------------------------------------------------------- contents


class Overview(NamedTuple):
    """Overview of a deck.

    Attributes:
        summary: sections, keywords, counts, sets, curves, diameters and laws, as `mudline show --output-format json`.
        sheet: `columns` by key, with heading and unit, and in `rows` the values of each run of elements with the same
            properties, by the same keys.
        errors: reasons why the deck is not legal; summary and sheet may lack parts because of them.
    """

    summary: dict[str, Any]
    sheet: Sheet
    errors: list[Diagnostic]


def overview(deck: Deck) -> Overview:
    """Return the overview of a deck; never raises for its content."""
    from mudline.model.results.summary import summarise  # noqa: PLC0415 - a verdict does without it
    from mudline.model.scene.sheet import sheet_of  # noqa: PLC0415 - as above

    context = LintContext(deck)
    scene = context.scene
    errors = [*errors_of(all_findings(context)), *(problem for problem in scene.errors() if of_base(deck, problem))]
    return Overview(summarise(scene), sheet_of(scene), scene.deck.diagnose(errors))
