"""The parameters of a deck, the values of equations, and the deck with numbers for its equations and labels."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from types import NoneType
from typing import TYPE_CHECKING, Any, NamedTuple, NewType, cast

from pydantic import BaseModel

from mudline.basics.spelling import Effort
from mudline.language.codes.fields import SYN002, SYN006, SYN017
from mudline.language.codes.references import REF013, REF014
from mudline.language.deck.model import Deck
from mudline.language.diagnostics import Blocks, Code, Problem, Severity, Where
from mudline.language.keywords.model import FieldSpec, ListRow, Part, record_schema
from mudline.language.keywords.table import Table
from mudline.language.keywords.text import shown, suggestion
from mudline.language.keywords.unknown import UNKNOWN, is_unknown
from mudline.language.keywords.values import Equation, Kind, Label
from mudline.language.syntax.rows import read_number

if TYPE_CHECKING:
    from mudline.language.deck.labels import LabelNumbers
    from mudline.language.expression.nodes import Expression, ExpressionError
    from mudline.language.keywords.library.preprocessor import Parameter


Value = float | str
_CONVERT = "convert"
"""A function that exists, and whose arguments are not public: a deck with it is no worse for that."""
PLACEHOLDER = re.compile(r"%([^%]+)%")
"""The name of a parameter in a text that is filled with its value."""
_ITEM = re.compile(r"""[,\s]*(?:([^\s,:;"=]+)[:;])?(=\[(?:[^\[\]]|\[[^\[\]]*\])*\]|"[^"]*"|[^\s,]+)""")


def folded(name: str) -> str:
    """A name as names compare: without case, blanks inside count."""
    return name.strip(" \t").casefold()


def bare(name: str) -> str:
    """A name without blanks, quotes or braces around it."""
    text = name.strip(" \t")
    if len(text) > 1 and text[0] + text[-1] in ('""', "{}"):
        text = text[1:-1].strip(" \t")
    return text


class ListItem(NamedTuple):
    """An item of a list: the name of its parameter, its value as written, and where that begins in the list."""

    name: str
    value: str
    start: int


def list_items(prefix: str, text: str) -> tuple[list[ListItem], str]:
    """The items of `/a:1 b:2 3/`, named and counted ones, and what is none."""
    items: list[ListItem] = []
    counter = 0
    end = len(text) - text[1:].endswith("/")
    at = 1
    while at < end and (match := _ITEM.match(text, at, end)):
        at = match.end()
        label = match[1]
        if not label:
            counter += 1
            label = str(counter)
        items.append(ListItem(f"{prefix}_{label}", match[2], match.start(2)))
    rest = text[at:end]
    return items, rest if rest.strip(" ,\t") else ""


@dataclass(slots=True, eq=False)
class Definition:
    """A parameter: the name as written, its value or equation, and where it stands.

    `expression` is the equation once it is read, `used` the parameters in it.
    """

    name: str
    value: Value | Equation
    where: Where
    expression: Expression | None = None
    used: Sequence[str] = ()


class NoValueError(Exception):
    """An equation without a value; `problem` is None when it has been reported elsewhere."""

    def __init__(self, problem: Problem | None = None) -> None:
        self.problem = problem
        super().__init__(problem.message if problem else "")


@dataclass(eq=False)
class Parameters:
    """All parameters of a deck, evaluated when asked for; names compare without case, the last definition holds."""

    deck: Deck
    definitions: dict[str, Definition] = field(default_factory=dict)
    values: dict[str, Value] = field(default_factory=dict)
    failed: set[str] = field(default_factory=set)
    problems: list[Problem] = field(default_factory=list)
    _effort: Effort = field(default_factory=Effort)

    def __post_init__(self) -> None:
        for where, block in self.deck.blocks("PARAMETERS", "PREPROCESSOR"):
            for index, parameter in enumerate(block.parameters):
                self._define(parameter, Where(where.section, where.block, ("parameters", index, "value")))
        for name in self.definitions:
            if name not in self.values and name not in self.failed:
                self._resolve(name)

    def number(self, value: object) -> float | None:
        """A field as a number: evaluated if it is an equation; None when it has no numeric value."""
        if isinstance(value, Equation):
            try:
                value = self.evaluate(value, Where())
            except NoValueError:
                return None
        return float(value) if isinstance(value, int | float) else None

    def filled(self, text: str) -> str:
        """A text with the value of each parameter in place of its `%name%`; what is not known stays."""
        return PLACEHOLDER.sub(self._placed, text)

    def _placed(self, match: re.Match[str]) -> str:
        value = self.values.get(folded(match[1]), match[0])
        return f"{value:.15g}" if isinstance(value, float) else value

    def evaluate(self, equation: Equation, where: Where) -> Value:
        """The value of an equation; raises NoValueError with the problem, placed at `where`."""
        expression = self._parse(equation, where)
        for name, _, _ in expression.name_spans:
            if folded(name) in self.failed:
                raise NoValueError
        return self._value(expression, where)

    def _define(self, parameter: Parameter, where: Where) -> None:
        name, value = parameter.name, parameter.value
        if is_unknown(name) or is_unknown(value):
            return
        if isinstance(value, str) and value.startswith("/"):
            self._define_list(name, value, where)
            return
        self._add(name, value, where)

    def _define_list(self, prefix: str, text: str, where: Where) -> None:
        """`/a:1 b:2 3/`: named items and counted ones."""
        items, rest = list_items(prefix, text)
        for item in items:
            self._add(item.name, item.value, where)
        if rest:
            message = f"{shown(rest)} is not an item of a list: write name:value or a value"
            self.problems.append(Problem(SYN006, message, None, None, where))

    def _add(self, name: str, value: Value, where: Where) -> None:
        """A text becomes an equation or a number where it reads as one; quotes around it are dropped."""
        if isinstance(value, str) and not isinstance(value, Equation):
            number = read_number(value)
            value = Equation.match(value) or (value.removeprefix('"').removesuffix('"') if number is None else number)
        self.definitions[folded(name)] = Definition(name, value, where)

    def _resolve(self, name: str) -> None:
        """Evaluate a parameter and, before it, those that it uses; an explicit stack, as chains may be long."""
        values, failed, definitions = self.values, self.failed, self.definitions
        stack = [name]
        open_names: set[str] = set()
        while stack:
            current = stack[-1]
            if current in values or current in failed:
                stack.pop()
                continue
            definition = definitions[current]
            if definition.expression is None and not self._read(current, definition):
                continue
            waiting = [other for other in definition.used if other not in values]
            useless = not failed.isdisjoint(waiting)
            if waiting and not useless and open_names.isdisjoint(waiting):
                open_names.add(current)
                stack += waiting
                continue
            stack.pop()
            open_names.discard(current)
            if not waiting:
                self._settle(current, definition)
            elif useless:
                self._fail(current, None)
            else:
                cyclic = sorted(open_names.union({current}).intersection(waiting))
                chain = " -> ".join(definitions[n].name for n in [*cyclic, current])
                message = f"parameter {definition.name} is defined through itself ({chain}): give one of them a value"
                self._fail(current, Problem(REF014, message, None, None, definition.where))

    def _read(self, name: str, definition: Definition) -> bool:
        """Read the equation of a parameter; returns whether it is still to be evaluated."""
        value = definition.value
        if not isinstance(value, Equation):
            self.values[name] = value
            return False
        try:
            expression = definition.expression = self._parse(value, definition.where)
        except NoValueError as reason:
            self._fail(name, reason.problem)
            return False
        used = [folded(use.name) for use in expression.name_spans]
        definition.used = [other for other in used if other in self.definitions]
        return True

    def _settle(self, name: str, definition: Definition) -> None:
        """Evaluate a parameter of which all that it uses has a value."""
        try:
            self.values[name] = self._value(cast("Expression", definition.expression), definition.where)
        except NoValueError as reason:
            self._fail(name, reason.problem)

    def _fail(self, name: str, problem: Problem | None) -> None:
        """A parameter without value: reported once, not again for each of its users."""
        self.failed.add(name)
        if problem:
            self.problems.append(problem)

    def _parse(self, equation: Equation, where: Where) -> Expression:
        from mudline.language.expression.nodes import ExpressionError  # noqa: PLC0415 - most decks have no equation
        from mudline.language.expression.parsing import parse  # noqa: PLC0415 - as above

        try:
            return parse(equation.expression)
        except ExpressionError as error:
            raise NoValueError(_problem(SYN017, equation, error, where)) from error

    def _known(self, name: str) -> Value:
        return self.values[folded(name)]

    def _value(self, expression: Expression, where: Where) -> Value:
        from mudline.language.expression.evaluation import evaluate  # noqa: PLC0415 - most decks have no equation
        from mudline.language.expression.nodes import ExpressionError, UndefinedName, UnknownFunction  # noqa: PLC0415 - as above

        try:
            return evaluate(expression, self._known)
        except UndefinedName as error:
            word = expression.text[error.start : error.end]
            known = (definition.name for definition in self.definitions.values())
            near = suggestion(word, known, self._effort)
            message = f"parameter {word} is not defined{near}: define it in *PARAMETERS"
            raise NoValueError(Problem(REF013, message, None, None, where)) from error
        except UnknownFunction as error:
            problem = _problem(SYN017, _equation(expression), error, where)
            message = f"{problem.message}; the equation is not evaluated"
            convert = expression.text[error.start : error.end].strip().casefold() == _CONVERT
            severity = Severity.INFO if convert else Severity.WARNING
            raise NoValueError(Problem(SYN017, message, None, severity, where)) from error
        except ExpressionError as error:
            raise NoValueError(_problem(SYN017, _equation(expression), error, where)) from error


def _equation(expression: Expression) -> Equation:
    """An expression as it is written in a deck."""
    return Equation(f"=[{expression.text}]")


def _problem(code: Code, equation: Equation, error: ExpressionError, where: Where) -> Problem:
    piece = equation.expression[error.start : error.end]
    at = f" at {shown(piece)}" if piece and shown(piece)[1:-1] not in error.message else ""
    return Problem(code, f"{shown(equation)}: {error.message}{at}", None, None, where)


def whole_fault(equation: Equation, value: Value, label: str, where: Where) -> Problem:
    """An equation in a field of whole numbers that gives something else."""
    return Problem(SYN002, f"{equation} gives {value!r}: {label} needs a whole number", None, None, where)


_PLAIN = frozenset({float, int, str, NoneType})
_EVALUATED = (Kind.REAL, Kind.WHOLE, Kind.WHOLE_OR_LABEL, Kind.REAL_OR_NAME)
DEFINING = "PREPROCESSOR"
"""The section of the parameters; `Parameters` and `mudline.editing.variations` evaluate what stands there."""

EvaluatedDeck = NewType("EvaluatedDeck", Deck)
"""A deck without equations in the sections of the model and of the analysis; only `evaluated` makes one.

A value that an equation did not give is unknown. A label of `*LABEL` is the number of its node or element; others stay.
"""


def evaluated(deck: Deck) -> tuple[EvaluatedDeck, list[Problem]]:
    """The deck with numbers for its equations and for the labels of `*LABEL`, and a problem for each without a value.

    Without a value of `$MODEL` nothing can be evaluated, were it only because a function is not known, which is a
    warning. What other sections hold has no influence on the contact.
    """
    copies = [type(one)(one.name, [*one.blocks], one.comments, one.lines) for one in deck.sections]
    ready = EvaluatedDeck(replace(deck, sections=copies))
    labelled = "LABEL" in deck.keywords()
    plain = deck.origin.no_equations and not deck.bases and not labelled
    written = [
        (i, j)
        for i, section in enumerate(() if plain else copies)
        if section.name != DEFINING
        for j, block in enumerate(section.blocks)
        if labelled or _has_equation(block)
    ]
    if not written and "PARAMETERS" not in deck.keywords(DEFINING):
        return ready, []
    parameters = Parameters(deck)
    evaluator = _Evaluator(parameters)
    if labelled:
        from mudline.language.deck.labels import labels_of  # noqa: PLC0415 - most decks have none

        evaluator.labels = labels_of(deck, parameters, evaluator.problems)
    for i, j in written:
        evaluator.blocks = Blocks.ALWAYS if copies[i].name == "MODEL" else Blocks.NEVER
        copies[i].blocks[j] = evaluator.part(copies[i].blocks[j], Where(i, j))
    noticed = parameters.problems
    if evaluator.lacks_parameter:
        noticed = [replace(problem, blocks=Blocks.ALWAYS) for problem in noticed]
    return ready, noticed + evaluator.problems


@cache
def _evaluated_slots(kind: type[BaseModel]) -> tuple[str, ...]:
    """Names of the fields of a part that can hold an equation, or parts that can; none of anything else.

    The question whether a class is one of parts takes longer than this cache.
    """
    slots = record_schema(kind).slots if issubclass(kind, Part) else ()
    return tuple(slot.name for slot in slots if slot.row or slot.record or slot.kind in _EVALUATED)


def _has_equation(value: Any) -> bool:
    """Whether there is an equation in a value or below it; most values are none that can hold one."""
    if isinstance(value, Equation):
        return True
    if isinstance(value, Table):
        return value.equations
    held = value
    if not isinstance(value, list):
        kind: type[BaseModel] = type(value)
        names = _evaluated_slots(kind)
        held = map(value.__dict__.__getitem__, names) if names else ()  # sooner than `getattr` of a model
    for item in held:  # noqa: SIM110 - `any` takes twice the time
        if type(item) not in _PLAIN and _has_equation(item):
            return True
    return False


class _Evaluator:
    def __init__(self, parameters: Parameters) -> None:
        self.parameters = parameters
        self.problems: list[Problem] = []
        self.labels: LabelNumbers = {}
        self.lacks_parameter = False
        self.blocks = Blocks.ALWAYS

    def part(self, part: Any, where: Where) -> Any:
        """A part without equations; the same object if it has none."""
        changed: dict[str, object] = {}
        kind: type[Part] = type(part)
        for slot in record_schema(kind).slots:
            value = getattr(part, slot.name)
            inner = where._replace(path=(*where.path, slot.json))
            new = self._value(value, slot, inner)
            if new is not value:
                changed[slot.name] = new
        return part.model_copy(update=changed) if changed else part

    def _value(self, value: object, slot: FieldSpec, where: Where) -> object:
        if isinstance(value, Equation):
            return self._number(value, slot.kind or Kind.REAL, slot.label, where)
        if isinstance(value, Label):
            return self._labelled(value, slot)
        if isinstance(value, Table):
            return self._table(value, slot, where) if value.equations or (self.labels and value.words) else value
        if isinstance(value, ListRow):
            return self._list_row(value, where)
        if isinstance(value, Part):
            return self.part(value, where)
        if isinstance(value, list) and value and isinstance(value[0], Part):
            new = [self.part(item, where._replace(path=(*where.path, i))) for i, item in enumerate(value)]
            return new if any(a is not b for a, b in zip(new, value, strict=True)) else value
        if self.labels and isinstance(value, list) and any(isinstance(item, Label) for item in value):
            return [self._labelled(item, slot) for item in value]
        return value

    def _labelled(self, value: object, slot: FieldSpec) -> object:
        """The number of a label that `*LABEL` gives; any other value stays."""
        if not isinstance(value, Label):
            return value
        return self.labels.get((slot.about.names or slot.about.defines, folded(bare(value))), value)

    def _list_row(self, row: ListRow, where: Where) -> ListRow:
        """Its fields have the index as path, as JSON holds them in a list."""
        changed: dict[str, object] = {}
        for index, slot in enumerate(record_schema(type(row)).columns):
            value = getattr(row, slot.name)
            if isinstance(value, Equation):
                place = where._replace(path=(*where.path, index))
                changed[slot.name] = self._number(value, slot.kind or Kind.REAL, slot.label, place)
            elif isinstance(value, Label):
                changed[slot.name] = self._labelled(value, slot)
        return row.model_copy(update=changed) if changed else row

    def _number(self, equation: Equation, kind: Kind, label: str, where: Where) -> Value:
        """The value of an equation."""
        whole = kind in (Kind.WHOLE, Kind.IDENT, Kind.WHOLE_OR_LABEL)
        nothing: Value = UNKNOWN
        try:
            value = self.parameters.evaluate(equation, where)
        except NoValueError as reason:
            if reason.problem:
                self.problems.append(replace(reason.problem, blocks=self.blocks))
            elif self.blocks is Blocks.ALWAYS:  # the problem is placed where the parameter is defined
                self.lacks_parameter = True
            return nothing
        if isinstance(value, str):
            if kind is Kind.REAL_OR_NAME:
                return value
            message = f"{equation} gives the text {value!r}: {label} needs a number"
            self.problems.append(Problem(SYN002, message, where=where, blocks=self.blocks))
            return nothing
        if not whole:
            return value
        if value.is_integer():
            return int(value)
        self.problems.append(replace(whole_fault(equation, value, label, where), blocks=self.blocks))
        return nothing

    def _table(self, table: Table, slot: FieldSpec, where: Where) -> Table:
        columns = slot.columns
        values = table.values.copy()
        words = dict(table.words)
        for (row, column), word in table.words.items():
            if isinstance(word, Equation):
                place = where._replace(path=(*where.path, row, column))
                values[row, column] = self._number(word, columns[column].kind, columns[column].label, place)
                del words[row, column]
            elif isinstance(word, Label) and slot.row:
                number = self._labelled(word, record_schema(slot.row).columns[column])
                if isinstance(number, int):
                    values[row, column] = number
                    del words[row, column]
        return Table(values, table.lengths, words)
