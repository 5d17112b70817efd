"""Plan of the decks that a deck describes: all are checked before the first is written."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from decimal import Decimal
from itertools import chain, product
from math import prod
from pathlib import PurePath
from typing import NamedTuple

from mudline.basics.limits import MOST_DECKS, SHOWN_ROWS
from mudline.basics.spelling import Effort
from mudline.editing.variations.cases import Action, ParameterTarget, ParameterTargets, RefusedError, Values, action_of
from mudline.editing.variations.files import MANIFEST, ExpansionPlan, PlannedDeck, Taken, path_fault
from mudline.editing.variations.names import CALLS, filled, placeholders, undefined_variation, variation_key
from mudline.language.codes import EXP001
from mudline.language.codes.references import REF013
from mudline.language.deck.forms import KEYWORD
from mudline.language.deck.keyword_text import as_text
from mudline.language.deck.loading import load_bytes
from mudline.language.deck.model import Deck
from mudline.language.deck.parameters import DEFINING, NoValueError, unquoted
from mudline.language.deck.searching import has_suffix
from mudline.language.diagnostics import DeckError, Problem, Severity, Where
from mudline.language.keywords.library.preprocessor import Combination, NamedVariation, ValueRange, VariedParameter
from mudline.language.keywords.text import shown
from mudline.language.keywords.values import Equation

_NOISE = Decimal("1e-9")
"""Share of a step by which a range may miss its last value: ends may come from equations."""
MOST_LOOKED_AT = 1000
"""Number of decks whose names are checked if none is to be written."""


class Cases(NamedTuple):
    """A variation: names of parameters, a row of their values for each case, and the actions in every case."""

    name: str
    parameters: Sequence[str]
    rows: Sequence[Sequence[str]]
    actions: Sequence[Action]


class _CaseGroup(NamedTuple):
    """A combination with its variations: a deck for each combination of their cases.

    `names` are those that it gives its decks: folder, folder below it, file; None for a name that it does not give.
    """

    where: Where
    combination: Combination
    names: Sequence[str | None]
    cases: Sequence[Cases]


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
        self.problems: list[Problem] = []
        self.effort = Effort()

    def plan(self, most_named: int = MOST_DECKS) -> ExpansionPlan:
        variations = self._variations()
        self.problems = [*self.targets.parameters.problems, *self.problems]
        groups = [group for group in self._groups(variations) if self._is_valid(group)]
        self._raise_any()
        total = sum(prod(len(cases.rows) for cases in group.cases) for group in groups)
        if total > MOST_DECKS:
            self._report(f"{total} decks would be written: expected no more than {MOST_DECKS}", groups[-1].where)
        if not groups:
            self._report(f"no *COMBINATIONS: add it to $PREPROCESSOR to define the decks{self._excel()}", Where())
        self._raise_any()
        decks = self._named(groups, total) if total <= most_named else []
        self._raise_any()
        notes = ["*EXCEL VARIATIONS is not expanded: it is passed through unchanged"] if self._excel() else []
        planned = ExpansionPlan(PurePath(self.deck.file).name, self.text, self.targets, decks, notes)
        self._readable(planned)
        self._raise_any()
        return planned

    def _report(self, message: str, where: Where) -> None:
        self.problems.append(Problem(EXP001, message, None, None, where))

    def _raise_any(self) -> None:
        if any(problem.weight is Severity.ERROR for problem in self.problems):
            raise DeckError(self.deck.diagnose(self.problems))

    def _excel(self) -> str:
        there = "EXCEL VARIATIONS" in self.deck.keywords(DEFINING)
        return " (*EXCEL VARIATIONS is not expanded)" if there else ""

    # --------------------------------------------------------------------------------------------------- variations

    def _variations(self) -> dict[str, Cases]:
        """Return every variation by its name in the form in which names are compared."""
        by_name: dict[str, Cases] = {}
        for where, block in self.text.blocks("VARIATION", DEFINING):
            for index, variation in enumerate(block.variations):
                place = where.inside("variations", index)
                cases = self._cases(variation, place)
                if variation_key(cases.name) in by_name:
                    message = f"variation {shown(cases.name)} is already defined: choose another name"
                    self._report(message, place.inside("name"))
                by_name[variation_key(cases.name)] = cases
        return by_name

    def _cases(self, variation: NamedVariation, where: Where) -> Cases:
        name = unquoted(variation.name)
        columns: dict[str, list[str]] = {}
        for index, varied in enumerate(variation.parameters):
            place = where.inside("parameters", index)
            if problem := self.targets.undefined(unquoted(varied.parameter), place):
                self.problems.append(problem)
                continue
            target = self.targets.target(unquoted(varied.parameter))
            if target.name in columns:
                self._report(f"{shown(target.name)} varies twice in {shown(name)}: keep one of its lines", place)
                continue
            columns[target.name] = self._values(varied, target, place)
        counts = {len(values) for values in columns.values() if values}
        if len(counts) > 1:  # all parameters of a variation change together
            listed = ", ".join(f"PARA={target} has {len(values)}" for target, values in columns.items() if values)
            message = (
                f"the parameters of variation {shown(name)} change together and need equally many values: {listed}. "
                "Put those that vary independently into separate variations"
            )
            self._report(message, where)
        rows = list(zip(*columns.values(), strict=False)) if columns else [()]
        actions = list[Action]()
        for at, varied_block in enumerate(variation.blocks):
            try:
                actions.append(action_of(self.text, varied_block))
            except RefusedError as reason:
                self._report(str(reason), where.inside("blocks", at))
        return Cases(name, list(columns), rows, actions)

    def _values(self, varied: VariedParameter, target: ParameterTarget, where: Where) -> list[str]:
        """Return the values as fields of `*PARAMETERS`; an empty list if they are faulty."""
        if varied.generate is not None:
            return self._range(varied.generate, where.inside("generate"))
        if not varied.values:
            self._report(f"PARA={varied.parameter} has no value", where)
        values: list[str] = []
        for index, text in enumerate(varied.values or []):
            place = where.inside("values", index)
            field = target.field(text)
            if field is None:
                what = f"value {index + 1} of PARA={varied.parameter}, {shown(text)},"
                self._report(f"{what} cannot be a value: correct it", place)
                return []
            if equation := Equation.match(field):  # it may have a value in some cases only
                try:
                    self.targets.parameters.evaluate(equation, place)
                except NoValueError as reason:
                    if reason.problem and reason.problem.code == REF013:
                        self.problems.append(reason.problem)
            values.append(field)
        return values

    def _range(self, given: ValueRange, where: Where) -> list[str]:
        ends = (given.start, given.end, 1.0 if given.increment is None else given.increment)
        numbers = [self.targets.parameters.number(end) for end in ends]
        known = [Decimal(repr(number)) for number in numbers if number is not None]
        if len(known) < len(numbers):
            self._report("GEN= needs numbers, or equations that give numbers", where)
            return []
        start, end, step = known
        steps = (end - start) / step + _NOISE if step else Decimal(-1)
        if steps < 0:
            self._report(f"GEN= gives no value: from {start} to {end} in steps of {step}", where)
            return []
        if steps >= MOST_DECKS:
            self._report(f"GEN= gives more than {MOST_DECKS} values: correct the increment", where)
            return []
        return [_spelled(start + step * index) for index in range(int(steps) + 1)]

    # ------------------------------------------------------------------------------------------------- combinations

    def _groups(self, variations: dict[str, Cases]) -> Iterator[_CaseGroup]:
        for where, block in self.text.blocks("COMBINATIONS", DEFINING):
            for index, combination in enumerate(block.combinations):
                place = where.inside("combinations", index)
                given = (block.directory, combination.subdirectory, combination.filename)
                names = [name if name is None else unquoted(name) for name in given]
                yield _CaseGroup(place, combination, names, self._called(combination, place, variations))

    def _called(self, combination: Combination, where: Where, variations: dict[str, Cases]) -> list[Cases]:
        """Return the variations that a combination calls, each once; if it names none, all of the deck."""
        called: dict[str, Cases] = {}
        for path, _, name in combination.walk(CALLS):
            key = variation_key(name)
            if key in variations:
                called[key] = variations[key]
            elif key == "all":
                called |= variations
            else:
                known = (cases.name for cases in variations.values())
                problem = undefined_variation(name, known, self.effort, where.inside(*path))
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
        for name in (name for text in group.names if text is not None for name in placeholders(text)):
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
            parameters = [name for cases in group.cases for name in cases.parameters]
            for rows in product(*(cases.rows for cases in group.cases)):  # the last variation changes fastest
                values = dict(zip(parameters, chain.from_iterable(rows), strict=True))
                number = len(decks)
                path, fault = self._path(group.names, values, f"{number + 1:0{len(str(total))}d}")
                names = [cases.name for cases in group.cases]
                actions = [action for cases in group.cases for action in cases.actions]
                decks.append(PlannedDeck(path, unquoted(group.combination.description), names, values, actions))
                if not fault and (holder := taken.take(path, number)) is not None:
                    fault = "is that of the manifest" if holder < 0 else _clash(path, decks[holder])
                if fault:
                    self._report(f"the deck with {listed(values)}: its name {shown(path)} {fault}", group.where)
                    faults += 1
                if faults == SHOWN_ROWS:
                    return decks
        return decks

    def _path(self, names: Sequence[str | None], values: Values, counter: str) -> tuple[str, str]:
        """Return the path of a deck with `/` in the output folder, and the reason why it may not be used, or "".

        A deck without a name of its own has that of the source, in a folder of its own or followed by the counter.
        """
        own = PurePath(self.deck.file).name
        source, missing = PurePath("deck" if path_fault(own) else own), list[str]()

        def value_of(name: str) -> str:
            value = self.targets.in_a_name(name, values)
            if value is None:
                missing.append(name)
            return value or ""

        directory, subdirectory, filename = (None if text is None else filled(text, value_of) for text in names)
        name = filename
        if name is None:
            name = source.name if subdirectory is not None else f"{source.stem} {counter}"
        file = name if has_suffix(name) else name + (source.suffix or ".keyx")
        folders = [folder for folder in (directory, subdirectory) if folder is not None]
        path = "/".join([*(folder.removesuffix("/") or "/" for folder in folders), file])
        if missing:
            return path, f"needs the value of {shown(missing[0])}, which has none"
        if "/" in name:
            return path, "has a / in FILENAME=: folders belong in SUBDIRECTORY="
        if "" in folders:
            return path, "has a folder without a name"
        return path, path_fault(name) or path_fault(path)

    def _readable(self, planned: ExpansionPlan) -> None:
        """Read a deck for each set of actions: the lines that a file adds may be faulty."""
        first: dict[tuple[Action, ...], PlannedDeck] = {}
        for deck in planned.decks:
            first.setdefault(tuple(deck.actions), deck)
        for deck in first.values():
            content = planned.content(replace(deck, path=""))
            read = load_bytes(content, deck.path, form=KEYWORD, units=self.deck.units)
            for fault in read.diagnose(read.errors()[:SHOWN_ROWS]):
                what = f"the new deck {shown(deck.path)} cannot be read"
                self._report(f"{what}: line {fault.line}: {fault.message}", Where())


def listed(values: Values) -> str:
    """Return values as `Offset=-100, Period=08`."""
    return ", ".join(f"{name}={text}" for name, text in values.items()) or "no varied parameter"


def _clash(path: str, holder: PlannedDeck) -> str:
    same = "" if path == holder.path else f" (as {shown(holder.path)})"
    return f"is that of the deck with {listed(holder.values)}{same}: name what differs with %parameter%"


def _spelled(number: Decimal) -> str:
    """Return a number in digits, a whole number without a point; the shortest form if very large or small."""
    if not number:
        return "0"
    plain = number.normalize()
    return format(plain, "f") if -15 < plain.adjusted() < 16 else repr(float(plain)).upper()
