"""Running rules over decks, under the settings of a run."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, fields, replace
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from mudline.checks.context import LintContext, read_deck
from mudline.checks.suppression import suppressions
from mudline.language.codes.lines import SYN009, SYN010
from mudline.language.deck.faults import MisspeltDeckError
from mudline.language.deck.loading import coverage_of
from mudline.language.deck.model import BaseProblem, Deck, Opaque
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import Blocks, Coverage, DeckError, Diagnostic, Problem, Severity, strongest
from mudline.language.keywords.contents import repeated_set
from mudline.language.keywords.model import Block
from mudline.language.rules import Rule, findings

if TYPE_CHECKING:
    from mudline.checks.recovery.engine import Recovered


class Fixing(StrEnum):
    """Fixes that are made: none, those that keep the deck's meaning, or also those that guess."""

    NONE = "none"
    SAFE = "safe"
    UNSAFE = "unsafe"

    def takes(self, applicability: str) -> bool:
        """Return True if fixes of an applicability ("safe" or "unsafe") are made."""
        return self is Fixing.UNSAFE or (self is Fixing.SAFE and applicability == "safe")


@dataclass(frozen=True, slots=True)
class LintSettings:
    """Settings of a run of the linter; they can be pickled.

    rules: the rules that run.
    units: the unit system of the decks; None for that of each file.
    dialect: the deck language that decks must keep to.
    severities: severities by code, which override those of the rules.
    fixing: the fixes that are made.
    unfixable: codes whose fixes are never made.
    no_outside: decks may name no file outside of their project.
    """

    rules: tuple[Rule, ...]
    units: str | None = None
    dialect: str = "mudline"
    severities: Mapping[str, Severity] = field(default_factory=dict)
    fixing: Fixing = Fixing.NONE
    unfixable: frozenset[str] = frozenset()
    no_outside: bool = False

    def __reduce__(self) -> tuple[Callable[..., LintSettings], tuple[object, ...]]:
        """Replace the rules by their codes, as their functions may not be picklable."""
        codes = frozenset(rule.code.code for rule in self.rules)
        return _with_rules, (codes, *(getattr(self, one.name) for one in fields(self)[1:]))


def _with_rules(codes: frozenset[str], *others: Any) -> LintSettings:  # noqa: ANN401 - the fields behind the first
    """Return settings with the rules of these codes; raises ImportError if a package with some of them is missing."""
    from mudline.checks.registry import rules  # noqa: PLC0415 - it imports the rules, which import this

    found = tuple(rule for rule in rules() if rule.code.code in codes)
    if len(found) < len(codes):
        raise ImportError(f"no rule {', '.join(sorted(codes - {rule.code.code for rule in found}))}")
    return LintSettings(found, *others)


def lint_context(context: LintContext, chosen: Sequence[Rule]) -> list[Diagnostic]:
    """Return the findings of the chosen rules in a deck, in the order of the file, without suppressed ones.

    Findings that only repeat another one, or follow from it, are joined to it.
    """
    return context.deck.diagnose(joined_problems(context, chosen))


def joined_problems(context: LintContext, chosen: Sequence[Rule], *, suppress: bool = True) -> list[Problem]:
    """Return the problems that the chosen rules find in a corrected deck: consequences of a fault are not reported.

    Problems that only repeat another one are joined to it (`Problem.following`). With `suppress` False, problems that
    comments of the deck suppress are included.
    """
    meant: Recovered | None = None
    if context.text and (may_recover(context.deck) or context.scene.lacks):
        from mudline.checks.recovery.engine import recovered  # noqa: PLC0415 - many decks do without

        meant = recovered(context, {rule.code.code for rule in chosen}, suppress=suppress)
    found = problems_in(meant.context if meant else context, chosen)
    if meant is not None:
        found = [*meant.as_written(found)]
        found = [*_as_severe(context, meant), *found]
    found = _misspelt_as_errors(context, found)
    found = unsuppressed(context, found, chosen) if suppress else found
    if not found:
        return found
    from mudline.checks.joining import joined_findings  # noqa: PLC0415 - most decks are without a finding

    return joined_findings(context, found)


_MISSPELT = (SYN009, SYN010)
"""Codes of unknown keywords and sections."""


def _as_severe(context: LintContext, meant: Recovered) -> list[Problem]:
    """Return the causes of a deck with the severity of their consequences: errors if the deck is refused for them.

    If there are errors, only misspelt keywords and sections are judged, whose lines are all lost. Other consequences
    are seen in the deck in which the errors are corrected.
    """
    causes = meant.causes
    doubtful = [one for one in causes if one.weight is not Severity.ERROR]
    if len(doubtful) < len(causes):
        doubtful = [one for one in doubtful if one.code in _MISSPELT]
    judged = meant.without_errors(context) if doubtful else None
    if judged is None:
        return causes
    others = {(one.code, one.message) for one in meant.context.scene.blocking()}
    following = [
        one
        for one in judged.scene.blocking()
        if one.weight is not Severity.INFO and (one.code, one.message) not in others
    ]
    if not following:
        return causes
    worst = max((one.weight for one in doubtful), key=lambda severity: severity.rank)
    return [_as_error(one, strongest(following)) if one in doubtful and one.weight is worst else one for one in causes]


def _as_error(problem: Problem, blocks: Blocks) -> Problem:
    return replace(problem, severity=Severity.ERROR, blocks=blocks)


def _misspelt_as_errors(context: LintContext, found: list[Problem]) -> list[Problem]:
    """Return the problems, with unknown names as errors if they may hide what the deck lacks, or if nothing is read."""
    unknown = [one for one in found if one.code in _MISSPELT]
    if not unknown:
        return found
    coverage, scene = coverage_of(context.deck), context.scene
    if coverage.read or coverage.partly:
        misplaced = scene.context.misplaced
        hiding = {one.maybe_defined_by for one in scene.blocking("cut")} & misplaced.keys()
        places = [misplaced[keyword][1] for keyword in hiding]
        lines = {context.deck.place(Problem(SYN009, "", where=place)).line for place in places}
        unknown = [one for one in unknown if context.deck.place(one).line in lines]
    else:
        unknown = [one for one in unknown if one.repair]
    return [_as_error(one, Blocks.ALWAYS) if one in unknown else one for one in found]


def may_recover(deck: Deck) -> bool:
    """Return True if something in a deck was not read, is passed through, or may be given twice."""
    origin = deck.origin
    if deck.problems or (isinstance(origin, TextOrigin) and any(read.lost for read in origin.read.values())):
        return True
    blocks = [block for section in deck.sections for block in section.blocks]
    count = Counter(block.keyword for block in blocks)
    for block in blocks:
        if type(block) is Opaque:
            return True
        facts = cast("Block", block).facts
        if facts.defines and (count[block.keyword] > 1 or not all(map(count.__contains__, facts.beside))):
            return True
        if facts.later_wins and repeated_set(cast("Block", block)):
            return True
    return False


def named_causes(deck: Deck, refused: Sequence[Diagnostic], chosen: Sequence[Rule]) -> list[Diagnostic]:
    """Return the reasons why a deck was refused, with causes instead of their consequences."""
    codes = {one.code for one in refused}
    context = LintContext(deck)
    reported = [
        one
        for one in joined_problems(context, chosen, suppress=False)
        if one.blocking is Blocks.ALWAYS or (one.blocking is Blocks.WITH_TENSION and one.code.code in codes)
    ]
    return context.deck.diagnose(reported) or list(refused)


@contextmanager
def naming_causes(deck: Deck) -> Iterator[None]:
    """Raise a DeckError from inside again with the causes of its findings."""
    try:
        yield
    except DeckError as error:
        from mudline.checks.registry import rules  # noqa: PLC0415 - only where the deck is refused

        raise DeckError(named_causes(deck, error.diagnostics, rules())) from error


def problems_in(context: LintContext, chosen: Sequence[Rule]) -> list[Problem]:
    """Return the problems that the chosen rules find in a deck itself, and not in a deck that it continues.

    Suppressed problems are included; unused suppression comments are not.
    """
    found: list[Problem] = []
    noticed = context.noticed
    advice = iter(findings([rule for rule in chosen if rule.check is not None and not rule.blocks], context))
    for rule in chosen:
        if rule.check is None or rule.blocks:
            found += noticed.get(rule.code.code, ())
        else:
            found += map(_advice, next(advice))
    return [problem for problem in found if not of_base(context.deck, problem)]


def of_base(deck: Deck, problem: Problem) -> bool:
    """Return True if a problem of a scene lies in a deck that `deck` continues, and not in `deck` itself."""
    beyond = problem.where is not None and problem.where.section >= len(deck.sections)
    return beyond or isinstance(problem, BaseProblem)


def _advice(problem: Problem) -> Problem:
    """Return a problem as one that does not keep the deck from being evaluated."""
    return problem if problem.blocking is Blocks.NEVER else replace(problem, blocks=Blocks.NEVER)


def unsuppressed(context: LintContext, problems: list[Problem], chosen: Sequence[Rule]) -> list[Problem]:
    """Return the problems that comments of the deck do not suppress, and the comments that suppress nothing."""
    found = context.once(suppressions)
    return problems if found is None else found.split(problems, chosen)[0]


def lint_bytes(
    data: bytes,
    name: str,
    chosen: Sequence[Rule],
    *,
    units: str | None = None,
    folder: Path | None = None,
    dialect: str = "mudline",
) -> list[Diagnostic]:
    """Return all findings in a file's content, in its order; `name` gives its form, and is named in the findings.

    `folder` is the folder of files that the deck names; without it they are not searched. `dialect` is the program that
    the deck is for, "mudline" or "flexcom".

    Never raises for content: a JSON or YAML file that holds no deck gives the reasons (DOC001, DOC002), whatever rules
        are chosen, as nothing else can be checked.
    """
    return covered_findings(data, name, chosen, units=units, folder=folder, dialect=dialect)[0]


def covered_findings(
    data: bytes,
    name: str,
    chosen: Sequence[Rule],
    *,
    units: str | None = None,
    folder: Path | None = None,
    dialect: str = "mudline",
) -> tuple[list[Diagnostic], Coverage]:
    """Return the findings of `lint_bytes`, and how many keywords were read."""
    try:
        deck = read_deck(data, name, units=units, folder=folder)
    except MisspeltDeckError as error:
        found = lint_context(LintContext(error.meant, dialect=dialect), chosen)
        return [*error.diagnostics, *found], coverage_of(error.meant)
    except DeckError as error:
        return list(error.diagnostics), Coverage()
    return lint_context(LintContext(deck, dialect=dialect), chosen), coverage_of(deck)
