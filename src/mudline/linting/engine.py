"""Running rules over decks, under the settings of a run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum
from functools import lru_cache
from pathlib import Path

from mudline.deck.loading import load_bytes
from mudline.deck.model import BaseProblem, Deck
from mudline.deck.reading import units_of
from mudline.diagnostics import Blocks, DeckError, Diagnostic, Problem, Severity
from mudline.keywords.model import Block
from mudline.keywords.reader import ReadBlock, read_block, read_piece
from mudline.linting.rule import LintContext, Noticed, Rule
from mudline.linting.suppression import suppressions
from mudline.syntax.tree import RawBlock


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
    """Which rules run, how severe their findings are, and which are fixed; it can be pickled.

    `units` None means those of the file. `severities` override the rules' own by code. Findings of `fail_on` or worse
    fail a run. Fixes of the codes in `unfixable` are never made.
    """

    rules: tuple[Rule, ...]
    units: str | None = None
    dialect: str = "mudline"
    severities: Mapping[str, Severity] = field(default_factory=dict)
    fail_on: Severity = Severity.WARNING
    fixing: Fixing = Fixing.NONE
    unfixable: frozenset[str] = frozenset()


def lint_context(context: LintContext, chosen: Sequence[Rule]) -> list[Diagnostic]:
    """All findings of the chosen rules in a deck, in the order of the file, without those that comments suppress.

    Those that follow from another finding are under it.
    """
    return context.deck.diagnose(grouped_problems(context, chosen))


def grouped_problems(context: LintContext, chosen: Sequence[Rule], *, suppress: bool = True) -> list[Problem]:
    """What the chosen rules find in a deck, with what follows from a finding under it (`Problem.following`).

    `suppress` False keeps what comments of the deck suppress.
    """

    def found_in(looked_at: LintContext) -> list[Problem]:
        found = problems_in(looked_at, chosen)
        return unsuppressed(looked_at, found, chosen) if suppress else found

    def check(data: bytes) -> tuple[LintContext, list[Problem]]:
        deck = context.deck
        units = None if units_of(deck) == deck.units else deck.units
        read = read_deck(data, deck.file, units=units, folder=deck.folder)
        corrected = LintContext(read, dialect=context.dialect)
        return corrected, found_in(corrected)

    found = found_in(context)
    if not found:
        return found
    from mudline.linting.causes import under_causes  # noqa: PLC0415 - most decks are without a finding

    return under_causes(context, found, check)


def named_causes(deck: Deck, refused: Sequence[Diagnostic], chosen: Sequence[Rule]) -> list[Diagnostic]:
    """The findings for which a deck was refused, with the cause in the place of those that follow from it."""
    waiting = {_place(one): one for one in refused}
    named: list[Diagnostic] = []
    for found in deck.diagnose(grouped_problems(LintContext(deck), chosen, suppress=False)):
        if found.following and any(_place(one) in waiting for one in (found, *found.following)):
            named.append(found)
            for one in (found, *found.following):
                waiting.pop(_place(one), None)
    return sorted([*named, *waiting.values()], key=lambda one: one.sort_key)


def _place(found: Diagnostic) -> tuple[str, str, int, int]:
    return found.file, found.code, found.line, found.column


def problems_in(context: LintContext, chosen: Sequence[Rule]) -> list[Problem]:
    """What the chosen rules find in a deck itself; what lies in a deck that it continues is reported for that one.

    Suppressed problems are among them; unused suppression comments are not.
    """
    found: list[Problem] = []
    noticed = bool(context.noticed)
    for rule in chosen:
        if isinstance(rule.check, Noticed):
            if noticed:
                found += rule.check(context)
        else:
            for problem in rule.check(context):
                found.append(_advice(problem))
    return [problem for problem in found if not _of_base(context.deck, problem)]


def _of_base(deck: Deck, problem: Problem) -> bool:
    """Whether a problem of a scene lies in a deck that `deck` continues, and not in `deck` itself."""
    beyond = problem.where is not None and problem.where.section >= len(deck.sections)
    return beyond or isinstance(problem, BaseProblem)


def _advice(problem: Problem) -> Problem:
    """A problem that does not keep the deck from being evaluated."""
    return problem if problem.blocking is Blocks.NEVER else replace(problem, blocks=Blocks.NEVER)


def unsuppressed(context: LintContext, problems: list[Problem], chosen: Sequence[Rule]) -> list[Problem]:
    """The problems that comments of the deck do not suppress, and the comments that suppress nothing."""
    found = context.once(suppressions)
    return problems if found is None else found.split(problems, chosen)[0]


_SHORT_BLOCK = 4096
"""Characters of a block that is remembered: decks of a project share their short blocks."""


class _Piece(str):
    """The text of a block, equal to that of any other; `raw` and `start` are those of the first one that was read."""

    __slots__ = ("raw", "start")

    raw: RawBlock
    start: int


@lru_cache(512)
def _read_piece(piece: _Piece, declared: type[Block], *, last: bool) -> ReadBlock:
    return read_piece(piece, piece.start, piece.raw, declared, last=last)


def _read_once(text: str, raw: RawBlock, declared: type[Block], *, last: bool) -> ReadBlock:
    """What `read_block` gives for a block; those of the same text share their model."""
    start = raw.head.span.start
    end = (raw.leaves[-1] if raw.leaves else raw.head).span.end
    if end - start > _SHORT_BLOCK:
        return read_block(text, raw, declared, last=last)
    piece = _Piece(text[start:end])
    piece.raw, piece.start = raw, start
    known = _read_piece(piece, declared, last=last)
    return known.at(text, start, [_reported_at(problem, start) for problem in known.problems])


def _reported_at(problem: Problem, by: int) -> Problem:
    span = problem.span and problem.span.moved(by)
    repair = problem.repair
    if repair is not None:
        repair = replace(repair, edits=tuple((place.moved(by), text) for place, text in repair.edits))
    return replace(problem, span=span, repair=repair)


def read_deck(data: bytes, name: str, *, units: str | None = None, folder: Path | None = None) -> Deck:
    """The deck of a file's content, whose models are shared with decks that were read before: it is not to be changed.

    Raises DeckError for a JSON or YAML file that holds no deck.
    """
    return load_bytes(data, name, units=units, folder=folder, read=_read_once)


def lint_bytes(
    data: bytes,
    name: str,
    chosen: Sequence[Rule],
    *,
    units: str | None = None,
    folder: Path | None = None,
    dialect: str = "mudline",
) -> list[Diagnostic]:
    """All findings in a file's content, in its order; `name` gives its form, and is named in the findings.

    `folder` is where files that the deck names are; without it none of them is looked for. `dialect` is the program
    that the deck is for, "mudline" or "flexcom".

    Never raises for content: a JSON or YAML file that holds no deck gives the reasons (DOC001, DOC002), whatever rules
    are chosen, as nothing else can be checked.
    """
    try:
        deck = read_deck(data, name, units=units, folder=folder)
    except DeckError as error:
        return list(error.diagnostics)
    return lint_context(LintContext(deck, dialect=dialect), chosen)
