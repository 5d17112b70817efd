"""Plan of the decks that a deck describes: all are checked before the first is written."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product
from math import prod
from pathlib import PurePath
from typing import TYPE_CHECKING

from mudline.basics.limits import MOST_DECKS, SHOWN_ROWS
from mudline.basics.spelling import Effort
from mudline.editing.variations.cases import CaseReader, Cases, ParameterTargets, Values
from mudline.editing.variations.files import (
    MANIFEST,
    CaseRewriter,
    ExpansionPlan,
    Namer,
    PlannedDeck,
    Taken,
    Template,
    companions,
)
from mudline.editing.variations.names import name_key, placeholders, undefined_variation, unquoted
from mudline.language.codes import EXP001
from mudline.language.deck.keyword_text import as_text
from mudline.language.deck.model import Deck
from mudline.language.deck.reading import read_source
from mudline.language.diagnostics import DeckError, Problem, Severity, Where
from mudline.language.keywords.text import shown
from mudline.language.syntax.source import Source

if TYPE_CHECKING:
    from mudline.language.keywords.library.preprocessor import Combination


MOST_LOOKED_AT = 1000
"""Number of decks whose names are checked if none is to be written."""


@dataclass(frozen=True, slots=True)
class _CaseGroup:
    """A combination with its variations: a deck for each combination of their cases."""

    where: Where
    combination: Combination
    template: Template
    cases: Sequence[Cases]

    @property
    def count(self) -> int:
        """Number of decks."""
        return prod(len(cases.rows) for cases in self.cases)


def plan(deck: Deck) -> ExpansionPlan:
    """Plan the decks that a deck describes.

    Raises DeckError for a deck with errors, and for variations that cannot be expanded: an undefined parameter,
    parameters of one variation with different numbers of values, a name that leads out of the output folder, two decks
    with one name.
    """
    return _Planner(deck.require()).plan()


def plan_faults(deck: Deck) -> list[Problem]:
    """Return the problems of planning the decks of a deck; names are not checked if there are very many decks."""
    planner = _Planner(deck)
    try:
        planner.plan(MOST_LOOKED_AT)
    except DeckError:
        return [problem for problem in planner.problems if problem.weight is Severity.ERROR]
    return []


class _Planner:
    def __init__(self, deck: Deck) -> None:
        self.deck = deck
        self.text = as_text(deck).require()
        self.targets = ParameterTargets(self.text)
        self.namer = Namer(deck, self.targets)
        self.rewriter = CaseRewriter(self.text, self.targets)
        self.problems: list[Problem] = []
        self.effort = Effort()

    def plan(self, most_named: int = MOST_DECKS) -> ExpansionPlan:
        reader = CaseReader(self.text, self.targets)
        variations = reader.read()
        self.problems += self.targets.parameters.problems + reader.problems
        groups = [group for group in self._groups(variations) if self._is_valid(group)]
        self._raise_any()
        total = sum(group.count for group in groups)
        if total > MOST_DECKS:
            self._report(f"{total} decks would be written: expected no more than {MOST_DECKS}", groups[-1].where)
        if not groups:
            self._report(f"no *COMBINATIONS: add it to $PREPROCESSOR to define the decks{self._excel()}", Where())
        self._raise_any()
        decks = self._named(groups, total) if total <= most_named else []
        self._raise_any()
        self._readable(decks)
        self._raise_any()
        notes = ["*EXCEL VARIATIONS is not expanded: it is passed through unchanged"] if self._excel() else []
        return ExpansionPlan(PurePath(self.deck.file).name, decks, self.rewriter, notes, companions(self.text))

    def _report(self, message: str, where: Where) -> None:
        self.problems.append(Problem(EXP001, message, None, None, where))

    def _raise_any(self) -> None:
        if any(problem.weight is Severity.ERROR for problem in self.problems):
            raise DeckError(self.deck.diagnose(self.problems))

    def _excel(self) -> str:
        there = "EXCEL VARIATIONS" in self.deck.keywords("PREPROCESSOR")
        return " (*EXCEL VARIATIONS is not expanded)" if there else ""

    # ------------------------------------------------------------------------------------------------- combinations

    def _groups(self, variations: dict[str, Cases]) -> Iterator[_CaseGroup]:
        for where, block in self.text.blocks("COMBINATIONS", "PREPROCESSOR"):
            for index, combination in enumerate(block.combinations):
                place = where.inside("combinations", index)
                names = (block.directory, combination.subdirectory, combination.filename)
                template = Template(*(name if name is None else unquoted(name) for name in names))
                yield _CaseGroup(place, combination, template, self._called(combination, place, variations))

    def _called(self, combination: Combination, where: Where, variations: dict[str, Cases]) -> list[Cases]:
        """Return the variations that a combination calls, each once; if it names none, all of the deck."""
        called: dict[str, Cases] = {}
        for index, line in enumerate(combination.variations):
            for number, name in enumerate(line.names):
                key = name_key(name)
                if key in variations:
                    called[key] = variations[key]
                elif key == "all":
                    called |= variations
                else:
                    known = (cases.name for cases in variations.values())
                    place = where.inside("variations", index, "names", number)
                    problem = undefined_variation(name, known, self.effort, place)
                    self.problems.append(replace(problem, code=EXP001))
        return list((called if combination.variations else variations).values())

    def _is_valid(self, group: _CaseGroup) -> bool:
        """Return True if the parameters in file names are defined, and none varies in two variations at once."""
        before = len(self.problems)
        owners: dict[str, str] = {}
        for cases in group.cases:
            for name in cases.parameters:
                if name in owners:
                    message = (
                        f"{shown(name)} varies in {shown(owners[name])} and in {shown(cases.name)}: put its values in "
                        "one variation, or name only one of the two in VARIATIONS="
                    )
                    self._report(message, group.where)
                owners[name] = cases.name
        for name in (name for text in group.template if text is not None for name in placeholders(text)):
            if problem := self.targets.undefined(name, group.where):
                self.problems.append(problem)
        return len(self.problems) == before

    # -------------------------------------------------------------------------------------------------------- decks

    def _named(self, groups: Sequence[_CaseGroup], total: int) -> list[PlannedDeck]:
        """Return the decks with their paths, each of them unique."""
        decks: list[PlannedDeck] = []
        taken = Taken()
        taken.take(MANIFEST, -1)
        faults = 0
        for group in groups:
            for values in _products(group.cases):
                number = len(decks)
                path, fault = self.namer.path(group.template, values, f"{number + 1:0{len(str(total))}d}")
                names = [cases.name for cases in group.cases]
                actions = [action for cases in group.cases for action in cases.actions]
                deck = PlannedDeck(path, unquoted(group.combination.description), names, values, actions)
                decks.append(deck)
                if not fault and (holder := taken.take(path, number)) is not None:
                    fault = _clash(deck, decks[holder] if holder >= 0 else None)
                if fault:
                    self._report(f"the deck with {listed(values)}: its name {shown(path)} {fault}", group.where)
                    faults += 1
                if faults == SHOWN_ROWS:
                    return decks
        return decks

    def _readable(self, decks: Sequence[PlannedDeck]) -> None:
        """Read a deck for each set of actions: the lines that a file adds may be faulty."""
        tried: set[tuple[int, ...]] = set()
        for deck in decks:
            key = tuple(id(action) for action in deck.actions)
            if key in tried:
                continue
            tried.add(key)
            content = self.rewriter.content(PlannedDeck("", "", (), deck.values, deck.actions))
            read = read_source(Source.from_bytes(content, deck.path), units=self.deck.units)
            faults = [problem for problem in read.problems if problem.weight is Severity.ERROR]
            for fault in read.diagnose(faults[:SHOWN_ROWS]):
                what = f"the new deck {shown(deck.path)} cannot be read"
                self._report(f"{what}: line {fault.line}: {fault.message}", Where())


def _products(variations: Sequence[Cases]) -> Iterator[dict[str, str]]:
    """Yield the values of every combination of cases; the last variation changes fastest."""
    names = [name for cases in variations for name in cases.parameters]
    for rows in product(*(cases.rows for cases in variations)):
        yield dict(zip(names, (text for row in rows for text in row), strict=True))


def listed(values: Values) -> str:
    """Return values as `Offset=-100, Period=08`."""
    return ", ".join(f"{name}={text}" for name, text in values.items()) or "no varied parameter"


def _clash(deck: PlannedDeck, holder: PlannedDeck | None) -> str:
    if holder is None:
        return "is that of the manifest"
    same = "" if deck.path == holder.path else f" (as {shown(holder.path)})"
    return f"is that of the deck with {listed(holder.values)}{same}: name what differs with %parameter%"
