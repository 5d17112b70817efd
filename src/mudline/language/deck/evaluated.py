"""Deck with numbers in place of its equations and of the labels that `*LABEL` defines."""

from __future__ import annotations

from dataclasses import replace
from types import NoneType
from typing import TYPE_CHECKING, Any, NewType, cast

from mudline.language.codes.fields import SYN002
from mudline.language.codes.references import REF007
from mudline.language.deck.model import Deck
from mudline.language.deck.parameters import DEFINING, NoValueError, Parameters, Value, bare, name_key
from mudline.language.diagnostics import Blocks, Problem, Where
from mudline.language.keywords.model import FieldSpec, Part, Path, record_schema
from mudline.language.keywords.table import Table
from mudline.language.keywords.text import shown
from mudline.language.keywords.unknown import UNKNOWN
from mudline.language.keywords.values import Equation, Kind, Label, Names

if TYPE_CHECKING:
    from mudline.language.keywords.library.mesh import Labels

LabelNumbers = dict[tuple[Names | None, str], int]
"""Numbers of nodes and elements by kind (nodes or elements) and casefolded label."""


def labels_of(deck: Deck, parameters: Parameters, problems: list[Problem]) -> LabelNumbers:
    """Return the labels that `*LABEL` defines; a label defined twice keeps its first number, and is a problem."""
    numbers: LabelNumbers = {}
    own = len(deck.own_sections)
    for where, block in deck.blocks("LABEL"):
        kind = Names.NODE
        for index, line in enumerate(cast("Labels", block).labels):
            if line.thing in Names.__members__:
                kind = Names[str(line.thing)]
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
                place = where.inside("labels", index, "label")
                problems.append(Problem(REF007, message, where=place, blocks=Blocks.NEVER))
    return numbers


def labels_given(deck: Deck, kind: Names) -> dict[str, str]:
    """Return the labels of nodes or of elements that `*LABEL` defines, as written, by their casefolded form."""
    labels: dict[str, str] = {}
    for _, block in deck.blocks("LABEL"):
        thing: str | None = Names.NODE.name
        for line in cast("Labels", block).labels:
            thing = line.thing or thing
            if thing == kind.name and line.label:
                labels.setdefault(name_key(line.label), bare(line.label))
    return labels


def all_labels_read(deck: Deck) -> bool:
    """Return False if a line of `*LABEL` could not be read: it may define any label."""
    lines = (line for _, block in deck.blocks("LABEL") for line in cast("Labels", block).labels)
    return all(line.label for line in lines)


_PLAIN = frozenset({float, int, str, NoneType})
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
            section.blocks[j] = evaluator.part(block, ())
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

    def part(self, part: Any, path: Path) -> Any:
        """Return a part without equations; the same object if it has none."""
        changed: dict[str, object] = {}
        kind: type[Part] = type(part)
        for slot in record_schema(kind).slots:
            value = part.__dict__[slot.name]  # faster than `getattr` of a model
            if type(value) in _PLAIN:
                continue
            new = self._value(value, slot, (*path, slot.order if slot.of_list else slot.json))
            if new is not value:
                changed[slot.name] = new
        return part.model_copy(update=changed) if changed else part

    def _value(self, value: object, slot: FieldSpec, path: Path) -> object:
        if isinstance(value, Equation):
            return self._number(value, slot.kind or Kind.REAL, slot.label, path)
        if isinstance(value, Label):
            return self._labelled(value, slot)
        if isinstance(value, Table):
            return self._table(value, slot, path) if value.equations or (self.labels and value.words) else value
        if isinstance(value, Part):
            return self.part(value, path)
        if isinstance(value, list) and isinstance(next(iter(value), None), Part):
            new = [self.part(item, (*path, i)) for i, item in enumerate(value)]
            return new if any(a is not b for a, b in zip(new, value, strict=True)) else value
        if self.labels and isinstance(value, list) and any(isinstance(item, Label) for item in value):
            return [self._labelled(item, slot) for item in value]
        return value

    def _labelled(self, value: object, slot: FieldSpec) -> object:
        """Return the number of a label that `*LABEL` defines; any other value unchanged."""
        if not isinstance(value, Label):
            return value
        return self.labels.get((slot.about.names or slot.about.defines, name_key(value)), value)

    def _number(self, equation: Equation, kind: Kind, label: str, path: Path) -> Value:
        """Return the value of an equation."""
        where = self.where.inside(*path)
        whole = kind in (Kind.WHOLE, Kind.IDENT, Kind.WHOLE_OR_LABEL)
        nothing: Value = UNKNOWN
        try:
            value = self.parameters.evaluate(equation, where)
        except NoValueError as reason:
            if reason.problem:
                self.problems.append(replace(reason.problem, blocks=self.blocks))
            elif self.blocks is Blocks.ALWAYS:  # the problem is reported at the parameter's definition
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
        message = f"{equation} gives {value!r}: {label} needs a whole number"
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
