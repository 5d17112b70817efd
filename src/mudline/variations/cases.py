"""`*VARIATION` to cases: the values that its parameters have together, and what is done in every one of them."""

from __future__ import annotations

from collections.abc import Iterator
from decimal import Decimal
from typing import TYPE_CHECKING

from mudline.codes import EXP001
from mudline.codes.references import REF013
from mudline.deck.model import Deck
from mudline.deck.parameters import NoValueError
from mudline.diagnostics import Problem, Where
from mudline.keywords.text import shown
from mudline.keywords.values import Equation
from mudline.variations.actions import action_of
from mudline.variations.model import MOST_DECKS, Action, Cases
from mudline.variations.names import name_key, unquoted
from mudline.variations.targets import Target, Targets

if TYPE_CHECKING:
    from mudline.keywords.library.variation import NamedVariation, ValueRange, VariedParameter

_NOISE = Decimal("1e-9")
"""Share of a step by which a range may miss its last value: ends may come from equations."""


class CaseReader:
    """Reads the variations of a deck that was read from text; what is wrong with them is in `problems`."""

    def __init__(self, deck: Deck, targets: Targets) -> None:
        self.deck = deck
        self.targets = targets
        self.problems: list[Problem] = []

    def read(self) -> dict[str, Cases]:
        """Every variation by its name as names compare."""
        found: dict[str, Cases] = {}
        for where, block in self.deck.blocks("VARIATION", "PREPROCESSOR"):
            for index, variation in enumerate(block.variations):
                place = where._replace(path=("variations", index))
                cases = self._cases(variation, place)
                if name_key(cases.name) in found:
                    message = f"there is a variation {shown(cases.name)} already: choose another name"
                    self._tell(message, place._replace(path=(*place.path, "name")))
                found[name_key(cases.name)] = cases
        return found

    def _tell(self, message: str, where: Where) -> None:
        self.problems.append(Problem(EXP001, message, None, None, where))

    def _cases(self, variation: NamedVariation, where: Where) -> Cases:
        name = unquoted(variation.name)
        columns: dict[str, list[str]] = {}
        for index, varied in enumerate(variation.parameters):
            place = where._replace(path=(*where.path, "parameters", index))
            if problem := self.targets.undefined(unquoted(varied.parameter), place):
                self.problems.append(problem)
                continue
            target = self.targets.target(unquoted(varied.parameter))
            if target.name in columns:
                self._tell(f"{shown(target.name)} varies twice in {shown(name)}: keep one of its lines", place)
                continue
            columns[target.name] = self._values(varied, target, place)
        self._in_step(name, columns, where)
        rows = list(zip(*columns.values(), strict=False)) if columns else [()]
        return Cases(name, where, list(columns), rows, list(self._actions(variation, where)))

    def _actions(self, variation: NamedVariation, where: Where) -> Iterator[Action]:
        for index, varied in enumerate(variation.blocks):
            action = action_of(self.deck, varied, where._replace(path=(*where.path, "blocks", index)))
            if isinstance(action, Problem):
                self.problems.append(action)
            else:
                yield action

    def _in_step(self, name: str, columns: dict[str, list[str]], where: Where) -> None:
        """Parameters of one variation change together, so that each needs a value for every case."""
        counts = {len(values) for values in columns.values() if values}
        if len(counts) > 1:
            listed = ", ".join(f"PARA={target} has {len(values)}" for target, values in columns.items() if values)
            message = (
                f"the parameters of variation {shown(name)} change together and need equally many values: {listed}; "
                "what varies on its own is a variation of its own"
            )
            self._tell(message, where)

    def _values(self, varied: VariedParameter, target: Target, where: Where) -> list[str]:
        """The values as fields of `*PARAMETERS`; none when they have been told to be faulty."""
        if varied.generate is not None:
            return self._range(varied.generate, where._replace(path=(*where.path, "generate")))
        if not varied.values:
            self._tell(f"PARA={varied.parameter} has no value", where)
        values: list[str] = []
        for index, text in enumerate(varied.values or []):
            place = where._replace(path=(*where.path, "values", index))
            field = target.field(text)
            if field is None:
                self._tell(f"value {index + 1} of PARA={varied.parameter}, {shown(text)}, is no value", place)
                return []
            self._defined(field, place)
            values.append(field)
        return values

    def _defined(self, field: str, where: Where) -> None:
        """An equation among the values uses parameters of the deck; whether it has a value depends on the case."""
        if equation := Equation.match(field):
            try:
                self.targets.parameters.evaluate(equation, where)
            except NoValueError as reason:
                if reason.problem and reason.problem.code is REF013:
                    self.problems.append(reason.problem)

    def _range(self, given: ValueRange, where: Where) -> list[str]:
        ends = (given.start, given.end, 1.0 if given.increment is None else given.increment)
        numbers = [self.targets.parameters.number(end) for end in ends]
        known = [Decimal(repr(number)) for number in numbers if number is not None]
        if len(known) < len(numbers):
            self._tell("GEN= needs numbers, or equations that give numbers", where)
            return []
        start, end, step = known
        steps = (end - start) / step + _NOISE if step else Decimal(-1)
        if steps < 0:
            self._tell(f"GEN= gives no value: from {start} to {end} in steps of {step}", where)
            return []
        if steps >= MOST_DECKS:
            self._tell(f"GEN= gives more than {MOST_DECKS} values: is the step right?", where)
            return []
        return [_spelled(start + step * index) for index in range(int(steps) + 1)]


def _spelled(number: Decimal) -> str:
    """A number in digits, a whole one without a point; of a very large or small one the shortest form."""
    if not number:
        return "0"
    plain = number.normalize()
    return format(plain, "f") if -15 < plain.adjusted() < 16 else repr(float(plain)).upper()
