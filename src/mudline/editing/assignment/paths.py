"""What `mudline set` is asked for, read by the grammar: a path to a field, its new value, a condition."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any, cast

from lark import Lark, Token, Transformer, UnexpectedInput, v_args
from lark.exceptions import VisitError
from lark.tree import Meta

from mudline.basics.limits import LONGEST_ASSIGNMENT
from mudline.basics.resources import grammar_file
from mudline.language.syntax.rows import read_number
from mudline.language.syntax.tree import canonical_name

ORDERING = frozenset({"<", "<=", ">", ">="})
_SAME = {"=": "==", "<>": "!="}


class PathError(ValueError):
    """A path, a value or a condition that cannot be read, or that no deck has; the message says what to write."""


@dataclass(frozen=True, slots=True)
class Operand:
    """A text of the command line, and the number that it spells, if it spells one."""

    text: str
    number: float | None = None

    @classmethod
    def of(cls, written: str) -> Operand:
        """What is written; in quotes it is a text, whatever it spells."""
        if written.startswith('"'):
            return cls(written[1:-1])
        text = written.strip()
        return cls(text, read_number(text))


@dataclass(frozen=True, slots=True)
class Selector:
    """`[set=TDZ]`: the records whose field has a value; `[TDZ]`, without a field: those of a name or a set."""

    name: str
    value: Operand


@dataclass(frozen=True, slots=True)
class FieldPath:
    """`KEYWORD[set=NAME].field`; `count` is the N of `[N]`: of all that are found, the one with that number, from 1."""

    written: str
    keyword: str
    names: tuple[str, ...]
    selectors: tuple[Selector, ...] = ()
    count: int | None = None

    def __str__(self) -> str:
        return self.written


@dataclass(frozen=True, slots=True)
class Assignment:
    """A field and the value that it is to have, as it is written into the deck."""

    path: FieldPath
    value: str


@dataclass(frozen=True, slots=True)
class Comparison:
    """A field compared with a number or a text."""

    path: FieldPath
    operator: str
    operand: Operand


@dataclass(frozen=True, slots=True)
class Negated:
    """What holds where the other condition does not."""

    condition: Condition


@dataclass(frozen=True, slots=True)
class Joined:
    """Conditions of which all have to hold, or one (`any_of`)."""

    conditions: tuple[Condition, ...]
    any_of: bool


Condition = Comparison | Negated | Joined


def folded_name(name: str) -> str:
    """A field's name as names of fields compare: without case; blanks and hyphens are underscores."""
    return "_".join(name.replace("-", " ").replace("_", " ").split()).casefold()


def parse_assignment(text: str) -> Assignment:
    """`KEYWORD.field=value`, `KEYWORD[set=NAME].field=value`; raises PathError."""
    found = cast("Assignment", _parsed(text, "assignment"))
    if not found.value or not found.value.isprintable():
        raise PathError(f"{found.path}: expected a value of printable characters after =")
    return found


def parse_path(text: str) -> FieldPath:
    """`KEYWORD.field`, `KEYWORD[set=NAME].field`; raises PathError."""
    return cast("FieldPath", _parsed(text, "path"))


def parse_condition(text: str) -> Condition:
    """Comparisons of fields with numbers or texts, joined by and, or, not and brackets; raises PathError."""
    return cast("Condition", _parsed(text, "condition"))


_FORMS = {
    "path": "KEYWORD.field, such as SEABED PROPERTIES[TDZ].stiffness",
    "assignment": "KEYWORD.field=value, such as TIME.step=0.05",
    "condition": "comparisons such as OCEAN.depth > 100 and UNITS.units == METRIC",
}


def _parsed(text: str, start: str) -> object:
    if len(text) > LONGEST_ASSIGNMENT:
        raise PathError(f"more than {LONGEST_ASSIGNMENT} characters: expected {_FORMS[start]}")
    try:
        tree = _grammar(start).parse(text)
        return _Builder(text).transform(tree)
    except UnexpectedInput as error:
        at = cast("int | None", error.pos_in_stream)
        rest = text[at:] if at is not None and at >= 0 else ""
        place = f"at {rest[:20]!r}" if rest else "at its end"
        quoted = "; quote what has a space" if start == "assignment" and "=" not in text else ""
        raise PathError(f"{text!r} cannot be read {place}: expected {_FORMS[start]}{quoted}") from error
    except (RecursionError, VisitError) as error:  # whatever a method below raises, and what is nested too deep
        if isinstance(error, VisitError) and isinstance(error.orig_exc, PathError):
            raise error.orig_exc from error
        raise PathError(f"nested too deeply: expected {_FORMS[start]}") from error


@cache
def _grammar(start: str) -> Lark:
    """The parser of one of the two: in one for both, the lexer would not know which terminals may follow a path."""
    text = grammar_file("assignment.lark").read_text(encoding="utf-8")
    return Lark(text, parser="lalr", lexer="contextual", start=start, propagate_positions=True)


class _Builder(Transformer[Token, Any]):
    """Makes paths and conditions of what the rules matched."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self._text = text

    def selector(self, parts: list[Token]) -> Selector | int:
        """A selector, or the number of the place that is meant."""
        if len(parts) > 1:
            return Selector(folded_name(parts[0]), Operand.of(parts[1]))
        return int(parts[0]) if parts[0].type == "COUNT" else Selector("", Operand.of(parts[0]))

    @v_args(meta=True)
    def path(self, meta: Meta, parts: list[Any]) -> FieldPath:
        """A path; of several numbers in brackets the last one holds."""
        keyword, *others = parts
        names = tuple(folded_name(part) for part in others if isinstance(part, Token))
        selectors = tuple(part for part in others if isinstance(part, Selector))
        counts = [part for part in others if isinstance(part, int)]
        written = self._text[meta.start_pos : meta.end_pos]
        return FieldPath(written, canonical_name(f"*{keyword}"), names, selectors, counts[-1] if counts else None)

    def assignment(self, parts: list[Any]) -> Assignment:
        """An assignment."""
        return Assignment(parts[0], parts[1][1:].strip())

    def comparison(self, parts: list[Any]) -> Comparison:
        """A comparison; texts have no order."""
        path, written, value = parts
        operand = Operand.of(value)
        operator = _SAME.get(written, str(written))
        if operator in ORDERING and operand.number is None:
            raise PathError(f"{path} {operator} {value}: a text is compared by == or !=, an order needs a number")
        return Comparison(path, operator, operand)

    def negated(self, parts: list[Any]) -> Negated:
        """A negation."""
        return Negated(parts[0])

    def conjunction(self, parts: list[Any]) -> Joined:
        """Conditions joined by and."""
        return Joined(tuple(parts), any_of=False)

    def disjunction(self, parts: list[Any]) -> Joined:
        """Conditions joined by or."""
        return Joined(tuple(parts), any_of=True)
