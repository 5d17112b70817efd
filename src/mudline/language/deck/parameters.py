"""Parameters of a deck, and the deck with numbers in place of its equations and of the labels that `*LABEL` defines."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, NamedTuple, NewType, cast

from mudline.basics.spelling import Effort
from mudline.language.codes.fields import SYN002, SYN006, SYN017
from mudline.language.codes.references import REF007, REF013, REF014
from mudline.language.deck.model import Deck
from mudline.language.diagnostics import Blocks, Problem, Severity, Where
from mudline.language.keywords.model import FieldSpec, Path, record_schema
from mudline.language.keywords.rebuilding import rebuilt
from mudline.language.keywords.table import Table
from mudline.language.keywords.text import shown, suggestion
from mudline.language.keywords.values import UNKNOWN, WHOLE_KINDS, Equation, Kind, Label, Names, is_unknown
from mudline.language.syntax.rows import read_number

if TYPE_CHECKING:
    from mudline.language.expression.parsing import Expression, ExpressionError
    from mudline.language.keywords.library.mesh import LabelLine, Labels
    from mudline.language.keywords.library.preprocessor import Parameter


Value = float | str
PLACEHOLDER = re.compile(r"%([^%]+)%")
"""Placeholder in a text: the name of a parameter, to be replaced by its value."""
_ITEM = re.compile(r"""[,\s]*(?:([^\s,:;"=]+)[:;])?(=\[(?:[^\[\]]|\[[^\[\]]*\])*\]|"[^"]*"|[^\s,]+)""")


def folded(name: str) -> str:
    """Return a name in the form in which names are compared: without case; blanks inside count."""
    return name.strip(" \t").casefold()


def unquoted(text: str) -> str:
    """Return a text without the double quotes around it."""
    return text[1:-1] if len(text) > 1 and text[0] == text[-1] == '"' else text


def bare(name: str) -> str:
    """Return a name without blanks, quotes or braces around it."""
    text = name.strip(" \t")
    if len(text) > 1 and text[0] + text[-1] in ('""', "{}"):
        text = text[1:-1].strip(" \t")
    return text


def name_key(name: str) -> str:
    """Return the name of an object in the form in which such names compare: without case, blanks, quotes, braces."""
    return bare(name).casefold()


class ListItem(NamedTuple):
    """Item of a list: name of its parameter, value as written, and offset of the value in the list."""

    name: str
    value: str
    start: int


def list_items(prefix: str, text: str) -> tuple[list[ListItem], str]:
    """Return the items of `/a:1 b:2 3/`, named and counted ones, and the text that is not an item."""
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
    """Parameter: name as written, value or equation, and place.

    `expression` is the parsed equation, `used` the parameters in it.
    """

    name: str
    value: Value | Equation
    where: Where
    expression: Expression | None = None
    used: Sequence[str] = ()


class NoValueError(Exception):
    """Equation without a value; `problem` is None if it has been reported elsewhere."""

    def __init__(self, problem: Problem | None = None) -> None:
        self.problem = problem
        super().__init__(problem.message if problem else "")


@dataclass(eq=False)
class Parameters:
    """Parameters of a deck, evaluated on demand; names are compared without case, the last definition holds.

    `given` are values as written, by name, in place of those of the deck.
    """

    deck: Deck
    given: Mapping[str, str] = field(default_factory=dict)
    definitions: dict[str, Definition] = field(default_factory=dict)
    values: dict[str, Value] = field(default_factory=dict)
    failed: set[str] = field(default_factory=set)
    problems: list[Problem] = field(default_factory=list)
    _effort: Effort = field(default_factory=Effort)

    def __post_init__(self) -> None:
        for where, block in self.deck.blocks("PARAMETERS", "PREPROCESSOR"):
            for index, parameter in enumerate(block.parameters):
                self._define(parameter, Where(where.section, where.block, ("parameters", index, "value")))
        for name, text in self.given.items():
            self._add(name, text, Where())
        for name in self.definitions:
            if name not in self.values and name not in self.failed:
                self._resolve(name)

    def number(self, value: object) -> float | None:
        """Return the number in a field, evaluated if it is an equation; None if the field has no numeric value."""
        if isinstance(value, Equation):
            try:
                value = self.evaluate(value, Where())
            except NoValueError:
                return None
        return float(value) if isinstance(value, int | float) else None

    def filled(self, text: str) -> str:
        """Return a text with the values of parameters in place of `%name%`; unknown names stay."""
        return PLACEHOLDER.sub(self._placed, text)

    def _placed(self, match: re.Match[str]) -> str:
        value = self.values.get(folded(match[1]), match[0])
        return f"{value:.15g}" if isinstance(value, float) else value

    def evaluate(self, equation: Equation, where: Where) -> Value:
        """Return the value of an equation; raises NoValueError with the problem, placed at `where`."""
        expression = self._parse(equation, where)
        if any(folded(use.name) in self.failed for use in expression.uses):
            raise NoValueError
        return self._value(expression, where)

    def _define(self, parameter: Parameter, where: Where) -> None:
        """Define a parameter, or the named and counted parameters of a list: `/a:1 b:2 3/`."""
        name, value = parameter.name, parameter.value
        if is_unknown(name) or is_unknown(value):
            return
        if not isinstance(value, str) or not value.startswith("/"):
            self._add(name, value, where)
            return
        items, rest = list_items(name, value)
        for item in items:
            self._add(item.name, item.value, where)
        if rest:
            message = f"{shown(rest)} is not an item of a list: write name:value or a value"
            self.problems.append(Problem(SYN006, message, None, None, where))

    def _add(self, name: str, value: Value, where: Where) -> None:
        """Define a parameter; its text, without quotes, becomes an equation or a number if it reads like one."""
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
            waiting = [parameter for parameter in definition.used if parameter not in values]
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
        """Read the equation of a parameter; return True if it is still to be evaluated."""
        value = definition.value
        if not isinstance(value, Equation):
            self.values[name] = value
            return False
        try:
            expression = definition.expression = self._parse(value, definition.where)
        except NoValueError as reason:
            self._fail(name, reason.problem)
            return False
        used = [folded(use.name) for use in expression.uses]
        definition.used = [key for key in used if key in self.definitions]
        return True

    def _settle(self, name: str, definition: Definition) -> None:
        """Evaluate a parameter whose used parameters all have values."""
        try:
            self.values[name] = self._value(cast("Expression", definition.expression), definition.where)
        except NoValueError as reason:
            self._fail(name, reason.problem)

    def _fail(self, name: str, problem: Problem | None) -> None:
        """Mark a parameter as without value; the problem is reported once, not for each use of the parameter."""
        self.failed.add(name)
        if problem:
            self.problems.append(problem)

    def _parse(self, equation: Equation, where: Where) -> Expression:
        from mudline.language.expression.parsing import ExpressionError, parse  # noqa: PLC0415 - few decks need it

        try:
            return parse(equation.expression)
        except ExpressionError as error:
            raise NoValueError(_problem(equation.expression, error, where)) from error

    def _value(self, expression: Expression, where: Where) -> Value:
        from mudline.language.expression.evaluation import evaluate  # noqa: PLC0415 - as above
        from mudline.language.expression.parsing import ExpressionError, UndefinedName, UnknownFunction  # noqa: PLC0415 - as above

        try:
            return evaluate(expression, lambda name: self.values[folded(name)])
        except UndefinedName as error:
            word = expression.text[error.start : error.end]
            known = (definition.name for definition in self.definitions.values())
            near = suggestion(word, known, self._effort)
            message = f"parameter {word} is not defined{near}: define it in *PARAMETERS"
            raise NoValueError(Problem(REF013, message, None, None, where)) from error
        except UnknownFunction as error:
            problem = _problem(expression.text, error, where)
            message = f"{problem.message}; the equation is not evaluated"
            # its arguments are not published: a deck that calls it has no fault for that reason
            convert = expression.text[error.start : error.end].strip().casefold() == "convert"
            severity = Severity.INFO if convert else Severity.WARNING
            raise NoValueError(Problem(SYN017, message, None, severity, where)) from error
        except ExpressionError as error:
            raise NoValueError(_problem(expression.text, error, where)) from error


def _problem(text: str, error: ExpressionError, where: Where) -> Problem:
    piece = text[error.start : error.end]
    at = f" at {shown(piece)}" if piece and shown(piece)[1:-1] not in error.message else ""
    return Problem(SYN017, f"{shown(f'=[{text}]')}: {error.message}{at}", None, None, where)


DEFINING = "PREPROCESSOR"
"""Section of the parameters; `Parameters` and `mudline.editing.variations` evaluate its lines."""


LabelNumbers = dict[tuple[Names | None, str], int]
"""Numbers of nodes and elements by kind (nodes or elements) and casefolded label."""


def labels_of(deck: Deck, parameters: Parameters, problems: list[Problem]) -> LabelNumbers:
    """Return the labels that `*LABEL` defines; a label defined twice keeps its first number, and is a problem."""
    numbers: LabelNumbers = {}
    own = len(deck.own_sections)
    for where, kind, line in _label_lines(deck):
        number = parameters.number(getattr(line.element if kind is Names.ELEMENT else line.node, "number", None))
        if number is None or not number.is_integer() or not line.label:
            continue
        name = name_key(line.label)
        if numbers.setdefault((kind, name), int(number)) != int(number) and where.section < own:
            thing = kind.name.lower()
            message = (
                f"label {shown(line.label)} is that of {thing} {numbers[kind, name]} and of {thing} {int(number)}: "
                "give one of them another label"
            )
            problems.append(Problem(REF007, message, where=where.inside("label"), blocks=Blocks.NEVER))
    return numbers


def labels_given(deck: Deck, kind: Names) -> dict[str, str]:
    """Return the labels of nodes or of elements that `*LABEL` defines, as written, by their casefolded form."""
    labels: dict[str, str] = {}
    for _, given, line in _label_lines(deck):
        if given is kind and line.label:
            labels.setdefault(name_key(line.label), bare(line.label))
    return labels


def all_labels_read(deck: Deck) -> bool:
    """Return False if a line of `*LABEL` could not be read: it may define any label."""
    return all(line.label for _, _, line in _label_lines(deck))


def _label_lines(deck: Deck) -> Iterator[tuple[Where, Names, LabelLine]]:
    """Yield the lines of `*LABEL`, each with its place and the kind of object that it labels."""
    for where, block in deck.blocks("LABEL"):
        kind = Names.NODE
        for index, line in enumerate(cast("Labels", block).labels):
            kind = Names[str(line.thing)] if line.thing in Names.__members__ else kind
            yield where.inside("labels", index), kind, line


EvaluatedDeck = NewType("EvaluatedDeck", Deck)
"""Deck without equations in the sections of the model and of the analysis; created only by `evaluated`.

A value is unknown if its equation gave none. A label that `*LABEL` defines is replaced by the number of its node or
element; other labels stay.
"""


def evaluated(deck: Deck) -> tuple[EvaluatedDeck, list[Problem]]:
    """Return the deck with numbers for equations and labels of `*LABEL`, and a problem for each missing value.

    A missing value in `$MODEL` prevents the evaluation of the deck, even if its only cause is an unknown function,
    which is a warning. Values of other sections have no influence on the contact.
    """
    copies = [type(each)(each.name, [*each.blocks], each.comments, each.lines) for each in deck.sections]
    ready = EvaluatedDeck(replace(deck, sections=copies))
    labelled = "LABEL" in deck.keywords()
    equations = not deck.origin.no_equations or bool(deck.bases) or "PARAMETERS" in deck.keywords(DEFINING)
    if not labelled and not equations:
        return ready, []
    parameters = Parameters(deck)
    evaluator = _Evaluator(parameters)
    if labelled:
        evaluator.labels = labels_of(deck, parameters, evaluator.problems)
    for i, section in enumerate(copies):
        evaluator.blocks = Blocks.ALWAYS if section.name == "MODEL" else Blocks.NEVER
        for j, block in enumerate(section.blocks if section.name != DEFINING else ()):
            evaluator.where = Where(i, j)
            section.blocks[j] = rebuilt(block, evaluator.changed, (Equation, Label, Table))
    noticed = parameters.problems
    if evaluator.lacks_parameter:
        noticed = [replace(problem, blocks=Blocks.ALWAYS) for problem in noticed]
    return ready, noticed + evaluator.problems


class _Evaluator:
    def __init__(self, parameters: Parameters) -> None:
        self.parameters = parameters
        self.problems: list[Problem] = []
        self.labels: LabelNumbers = {}
        self.lacks_parameter = False
        self.blocks = Blocks.ALWAYS
        self.where = Where(0)

    def changed(self, value: Equation | Label | Table, slot: FieldSpec, path: Path) -> object:
        """Return the number that takes the place of an equation or a label, or a table with such numbers."""
        if isinstance(value, Equation):
            return self._number(value, slot.kind or Kind.REAL, slot.label, path)
        if isinstance(value, Label):
            return self._labelled(value, slot)
        return self._table(value, slot, path) if value.equations or (self.labels and value.words) else value

    def _labelled(self, label: Label, slot: FieldSpec) -> int | Label:
        """Return the number of a label that `*LABEL` defines; the label itself without one."""
        return self.labels.get((slot.about.names or slot.about.defines, name_key(label)), label)

    def _number(self, equation: Equation, kind: Kind, label: str, path: Path) -> Value:
        """Return the value of an equation."""
        where = self.where.inside(*path)
        whole = kind in WHOLE_KINDS
        nothing: Value = UNKNOWN
        try:
            value = self.parameters.evaluate(equation, where)
        except NoValueError as reason:
            if reason.problem:
                self.problems.append(replace(reason.problem, blocks=self.blocks))
            elif self.blocks is Blocks.ALWAYS:  # the problem is reported at the parameter's definition
                self.lacks_parameter = True
            return nothing
        if isinstance(value, str) and kind is not Kind.REAL_OR_NAME:
            message = f"{equation} gives the text {value!r}: {label} needs a number"
        elif whole and isinstance(value, float) and not value.is_integer():
            message = f"{equation} gives {value!r}: {label} needs a whole number"
        else:
            return int(value) if whole else value
        self.problems.append(Problem(SYN002, message, where=where, blocks=self.blocks))
        return nothing

    def _table(self, table: Table, slot: FieldSpec, path: Path) -> Table:
        columns = table.columns
        values = table.values.copy()
        words = dict(table.words)
        for (row, column), word in table.words.items():
            if isinstance(word, Equation):
                kind, label = columns[column].kind, columns[column].label
                values[row, column] = self._number(word, kind, label, (*path, row, column))
                del words[row, column]
            elif isinstance(word, Label) and slot.row:
                number = self._labelled(word, record_schema(slot.row).columns[column])
                if isinstance(number, int):
                    values[row, column] = number
                    del words[row, column]
        return Table(values, table.lengths, words, table.columns)
