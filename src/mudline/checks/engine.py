"""Running rules over decks, under the settings of a run; repeated findings are joined."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, fields, replace
from enum import StrEnum
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from mudline.basics.short_repr import counted
from mudline.checks.context import JOINTS, ROW_NUMBER, Joined, LintContext, also_in, read_deck
from mudline.checks.registry import rules
from mudline.checks.suppression import suppressions
from mudline.language.codes.fields import SYN002, SYN003, SYN015
from mudline.language.codes.lines import SYN001, SYN004, SYN009, SYN010, SYN014
from mudline.language.codes.references import REF007
from mudline.language.deck.faults import MisspeltDeckError
from mudline.language.deck.loading import coverage_of
from mudline.language.deck.model import BaseProblem, Deck, Origin
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import (
    MORE,
    Blocks,
    Coverage,
    DeckError,
    Diagnostic,
    Problem,
    Repair,
    Severity,
    strongest,
)
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
        found = [*_as_severe(context, meant), *meant.as_written(found)]
    found = _misspelt_as_errors(context, found)
    found = unsuppressed(context, found, chosen) if suppress else found
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
    blocking = (one for one in judged.scene.blocking() if one.weight is not Severity.INFO)
    following = [one for one in blocking if (one.code, one.message) not in others]
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
        lines = {context.deck.place(place).line for place in places}
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
        if not isinstance(block, Block):
            return True
        facts = block.facts
        if facts.defines and (count[block.keyword] > 1 or not all(map(count.__contains__, facts.beside))):
            return True
        if facts.later_wins and repeated_set(block):
            return True
    return False


def all_findings(context: LintContext) -> list[Problem]:
    """Return the findings of all rules in a deck, including those that its comments suppress."""
    return joined_problems(context, rules(), suppress=False)


def errors_of(problems: list[Problem]) -> list[Problem]:
    """Return the findings that make a deck illegal, the same in every command."""
    return [problem for problem in problems if problem.weight is Severity.ERROR]


def named_causes(deck: Deck, refused: Sequence[Diagnostic]) -> list[Diagnostic]:
    """Return the reasons why a deck was refused, with causes instead of their consequences."""
    codes = {one.code for one in refused}
    context = LintContext(deck)
    reported = [
        one
        for one in all_findings(context)
        if one.blocking is Blocks.ALWAYS or (one.blocking is Blocks.WITH_TENSION and one.code.code in codes)
    ]
    return context.deck.diagnose(reported) or list(refused)


@contextmanager
def naming_causes(deck: Deck) -> Iterator[None]:
    """Raise a DeckError from inside again with the causes of its findings."""
    try:
        yield
    except DeckError as error:
        raise DeckError(named_causes(deck, error.diagnostics)) from error


D = TypeVar("D", bound=Deck)


def readable(deck: D) -> D:
    """Return a deck; raises DeckError if something could not be read, with causes instead of their consequences."""
    if errors := deck.errors():
        context = LintContext(deck)
        causes = [one for one in errors_of(all_findings(context)) if one.code.code.startswith("SYN")]
        raise DeckError(context.deck.diagnose(causes) or deck.diagnose(errors))
    return deck


def problems_in(context: LintContext, chosen: Sequence[Rule]) -> list[Problem]:
    """Return the problems that the chosen rules find in a deck itself, and not in a deck that it continues.

    Suppressed problems are included; unused suppression comments are not.
    """
    noticed = context.noticed
    noticing = (rule for rule in chosen if rule.check is None or rule.blocks)
    found = [problem for rule in noticing for problem in noticed.get(rule.code.code, ())]
    advising = [rule for rule in chosen if rule.check is not None and not rule.blocks]
    advice = chain.from_iterable(findings(advising, context))
    # Advice does not keep a deck from being evaluated.
    found += [one if one.blocking is Blocks.NEVER else replace(one, blocks=Blocks.NEVER) for one in advice]
    found.sort(key=lambda problem: problem.code.code)
    return [problem for problem in found if not of_base(context.deck, problem)]


def of_base(deck: Deck, problem: Problem) -> bool:
    """Return True if a problem of a scene lies in a deck that `deck` continues, and not in `deck` itself."""
    beyond = problem.where is not None and problem.where.section >= len(deck.sections)
    return beyond or isinstance(problem, BaseProblem)


def unsuppressed(context: LintContext, problems: list[Problem], chosen: Sequence[Rule]) -> list[Problem]:
    """Return the problems that comments of the deck do not suppress, and the comments that suppress nothing."""
    found = context.once(suppressions)
    return problems if found is None else found.reported([*problems, *found.unused(problems, chosen)])


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
    return covered_findings(data, name, LintSettings(tuple(chosen), units, dialect), folder)[0]


def covered_findings(
    data: bytes, name: str, settings: LintSettings, folder: Path | None = None
) -> tuple[list[Diagnostic], Coverage]:
    """Return the findings of `lint_bytes` under the settings, and how many keywords were read."""
    refused: tuple[Diagnostic, ...] = ()
    try:
        deck = read_deck(data, name, units=settings.units, folder=folder)
    except MisspeltDeckError as error:
        deck, refused = error.meant, error.diagnostics
    except DeckError as error:
        return list(error.diagnostics), Coverage()
    found = lint_context(LintContext(deck, dialect=settings.dialect), settings.rules)
    return [*refused, *found], coverage_of(deck)


# ---------------------------------------------------------------------------------------------------- joining


FEWEST = 3
"""Number of consecutive rows, or fields of a row, with the same fault that are joined; two may be separate faults."""
MOST_NAMED = 4
"""Number of rows below the first one whose numbers are named."""
_OF_ROWS = frozenset(code.code for code in (SYN001, SYN002, SYN003, SYN004, SYN014, SYN015, REF007))
"""Codes of faults of a row, which one slip gives to many rows."""
_DIGITS = re.compile(r"-?[0-9]+")


def joined_findings(context: LintContext, problems: list[Problem]) -> list[Problem]:
    """Return one finding for one cause: those that repeat another one, or that a joint declares, are joined to it.

    They are in its `Problem.following`. Nothing is read or checked for this.
    """
    text, origin = context.text, context.deck.origin
    if not problems or type(origin) is Origin:  # a program made the deck, which has no lines
        return problems
    by_code: dict[str, list[Problem]] = {}
    for problem in problems:
        if problem.message != MORE:
            by_code.setdefault(problem.code.code, []).append(problem)
    declared = (join(context, by_code) for codes, join in JOINTS if not codes.isdisjoint(by_code))
    repeated = _repeated(text, by_code) if text else ()
    under: dict[int, Problem] = {}
    hidden: set[int] = set()
    for joined in chain(*declared, repeated, _alike(origin, by_code)):
        if id(joined.first) not in hidden and (joined.others or joined.message):
            cause = under.get(id(joined.first), joined.first)
            cause = replace(cause, message=joined.message or cause.message, span=joined.place or cause.span)
            others = [under.get(id(each), each) for each in joined.others]
            under[id(joined.first)] = _joined(cause, others, joined.words) if others else cause
            hidden.update(map(id, joined.others))
    return [under.get(id(joined), joined) for joined in problems if id(joined) not in hidden]


def _joined(cause: Problem, others: Sequence[Problem], words: str) -> Problem:
    """Return a finding with others joined to it: as severe as the worst, and an error if one prevents evaluation."""
    everything = (cause, *others)
    blocks = strongest(everything)
    severity = max((item.weight for item in everything), key=lambda severity: severity.rank)
    below = tuple(each for item in others for each in (replace(item, following=()), *item.following))
    left_out = "finding that follows from it is" if len(others) == 1 else "findings that follow from it are"
    return replace(
        cause,
        message=f"{cause.message}; {words or f'{len(others)} {left_out} left out'}",
        severity=Severity.ERROR if blocks is Blocks.ALWAYS else severity,
        blocks=blocks,
        repair=cause.repair and _of_all(everything)
        if all(item.code is cause.code for item in others)
        else cause.repair,
        following=(*cause.following, *below),
    )


def _of_all(problems: Sequence[Problem]) -> Repair | None:
    """Return the repair of a finding with the edits of equal findings; None if one of them has no repair."""
    repairs = [problem.repair for problem in problems if problem.repair]
    if len(repairs) < len(problems):
        return None
    return replace(repairs[0], edits=tuple(sorted({edit for repair in repairs for edit in repair.edits})))


def _repeated(text: TextOrigin, by_code: dict[str, list[Problem]]) -> Iterator[Joined]:
    """Yield further fields of the same row, and consecutive rows with the same fault."""
    for code in _OF_ROWS & by_code.keys():
        rows: dict[int, list[Problem]] = {}
        for problem in by_code[code]:
            rows.setdefault(text.place(problem).line, []).append(problem)
        after = 0
        for line, row in sorted(rows.items()):
            if line < after:
                continue
            after = line + 1
            while after in rows and _said(rows[after][0]) == _said(row[0]):
                after += 1
            below = [rows[each] for each in range(line + 1, after)] if after - line >= FEWEST else []
            after = after if below else line + 1
            whole_row = len(row) == text.source.line(line).count(",") + 1
            same = row[1:] if len(row) >= FEWEST or whole_row or code == SYN014.code else []
            yield Joined(row[0], [*same, *chain(*below)], f"and {' and '.join(_counts(text, same, below))}")


def _said(problem: Problem) -> str:
    """Return the message of a row without its numbers."""
    return _DIGITS.sub("0", problem.message)


def _counts(text: TextOrigin, same: Sequence[Problem], below: Sequence[Sequence[Problem]]) -> Iterator[str]:
    """Yield in words the number of further fields of a row, and the rows below it, with the same fault."""
    if same:
        yield f"{counted(len(same), 'more field')} of this row"
    if below:
        lines = [text.place(row[0]).line for row in below]
        ids = [number[1] for line in lines if (number := ROW_NUMBER.match(text.source.line(line)))]
        named = f" ({', '.join(ids)})" if len(ids) == len(below) <= MOST_NAMED else ""
        yield f"{len(below)} more rows of this block{named}, the last in line {text.place_in_file(below[-1][0]).line}"


def _lacking(problem: Problem) -> str:
    """Return the name that a deck lacks; for numbers that one unread line may define, return that line."""
    doubt = problem.message.rpartition("; ")[2]
    one_cause = problem.lacks.isdecimal() and doubt.endswith("could not be used may define it")
    return doubt if one_cause else problem.lacks.casefold()


def _alike(origin: Origin, by_code: dict[str, list[Problem]]) -> Iterator[Joined]:
    """Yield further lines that use an undefined name, and further fields of a row with the same message.

    The fields of a row are joined only in a text: a line of JSON may be the whole deck.
    """
    has_rows = isinstance(origin, TextOrigin)
    for code, problems in by_code.items():
        alike: dict[tuple[str, int], list[Problem]] = {}
        for problem in problems if len(problems) > 1 else ():
            if problem.lacks:
                alike.setdefault((_lacking(problem), 0), []).append(problem)
            elif has_rows and code not in _OF_ROWS:
                alike.setdefault((problem.message, origin.place(problem).line), []).append(problem)
        for first, *others in (sorted(same, key=lambda one: origin.place(one).line) for same in alike.values()):
            fields = f"and {counted(len(others), 'more field')} of it"
            yield Joined(first, others, also_in(origin, others) if others and first.lacks else fields)
