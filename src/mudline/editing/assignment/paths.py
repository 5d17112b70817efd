"""Arguments of `mudline set`, read by a grammar: a path to a field, and its new value."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any, NamedTuple, cast

from lark import Lark, Token, Transformer, UnexpectedInput, v_args
from lark.exceptions import VisitError
from lark.tree import Meta

from mudline.basics.limits import LONGEST_ASSIGNMENT
from mudline.basics.resources import grammar_file
from mudline.language.syntax.rows import read_number
from mudline.language.syntax.tree import canonical_name


class PathError(ValueError):
    """Invalid path, value or condition; the message says what to write."""


class WrittenOperand(NamedTuple):
    """A text of the command line, and its number if it is a number."""

    text: str
    number: float | None = None

    @classmethod
    def of(cls, written: str) -> WrittenOperand:
        """Return the operand of a text; a quoted text is never a number."""
        if written.startswith('"'):
            return cls(written[1:-1])
        text = written.strip()
        return cls(text, read_number(text))


class Selector(NamedTuple):
    """Selection of records: `[set=TDZ]` by the value of a field, `[TDZ]` by their set or name."""

    name: str
    value: WrittenOperand


@dataclass(frozen=True, slots=True)
class FieldPath:
    """A path `KEYWORD[set=NAME].field`; `count` is the N of `[N]`, the number of the chosen value, from 1."""

    written: str
    keyword: str
    names: tuple[str, ...]
    selectors: tuple[Selector, ...] = ()
    count: int | None = None

    def __str__(self) -> str:
        return self.written


class Assignment(NamedTuple):
    """A field and its new value, as written into the deck."""

    path: FieldPath
    value: str


def folded_name(name: str) -> str:
    """Return a field name in the form in which names are compared: without case, blanks and hyphens as underscores."""
    return "_".join(name.replace("-", " ").replace("_", " ").split()).casefold()


def parse_assignment(text: str) -> Assignment:
    """Return the assignment `KEYWORD.field=value` or `KEYWORD[set=NAME].field=value`; raises PathError."""
    assignment = cast("Assignment", parsed(text, "assignment"))
    if not assignment.value or not assignment.value.isprintable():
        raise PathError(f"{assignment.path}: expected a value of printable characters after =")
    return assignment


def parse_path(text: str) -> FieldPath:
    """Return the path `KEYWORD.field` or `KEYWORD[set=NAME].field`; raises PathError."""
    return cast("FieldPath", parsed(text, "path"))


_FORMS = {
    "path": "KEYWORD.field, such as SEABED PROPERTIES[TDZ].stiffness",
    "assignment": "KEYWORD.field=value, such as TIME.step=0.05",
    "condition": "comparisons such as OCEAN.depth > 100 and UNITS.units == METRIC",
}


def parsed(text: str, start: str, builder: type[PathBuilder] | None = None) -> object:
    """Return what a builder makes of a text by a start rule of the grammar; raises PathError."""
    if len(text) > LONGEST_ASSIGNMENT:
        raise PathError(f"more than {LONGEST_ASSIGNMENT} characters: expected {_FORMS[start]}")
    try:
        tree = _grammar(start).parse(text)
        return (builder or PathBuilder)(text).transform(tree)
    except UnexpectedInput as error:
        at = cast("int | None", error.pos_in_stream)
        rest = text[at:] if at is not None and at >= 0 else ""
        place = f"at {rest[:20]!r}" if rest else "at its end"
        quoted = "; quote what has a space" if start == "assignment" and "=" not in text else ""
        raise PathError(f"{text!r} cannot be read {place}: expected {_FORMS[start]}{quoted}") from error
    except (RecursionError, VisitError) as error:  # a method of the builder raises, or the nesting is too deep
        if isinstance(error, VisitError) and isinstance(error.orig_exc, PathError):
            raise error.orig_exc from error
        raise PathError(f"nested too deeply: expected {_FORMS[start]}") from error


@cache
def _grammar(start: str) -> Lark:
    """Return the parser of one start rule; with several, the lexer could not know which terminals may follow a path."""
    text = grammar_file("assignment.lark").read_text(encoding="utf-8")
    return Lark(text, parser="lalr", lexer="contextual", start=start, propagate_positions=True)


class PathBuilder(Transformer[Token, Any]):
    """Builder of paths and assignments from the parsed rules."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self._text = text

    def selector(self, parts: list[Token]) -> Selector | int:
        """Return a selector, or the number of the chosen value."""
        if len(parts) > 1:
            return Selector(folded_name(parts[0]), WrittenOperand.of(parts[1]))
        return int(parts[0]) if parts[0].type == "COUNT" else Selector("", WrittenOperand.of(parts[0]))

    @v_args(meta=True)
    def path(self, meta: Meta, parts: list[Any]) -> FieldPath:
        """Return a path; of several numbers in brackets the last applies."""
        keyword, *others = parts
        names = tuple(folded_name(part) for part in others if isinstance(part, Token))
        selectors = tuple(part for part in others if isinstance(part, Selector))
        counts = [part for part in others if isinstance(part, int)]
        written = self._text[meta.start_pos : meta.end_pos]
        return FieldPath(written, canonical_name(f"*{keyword}"), names, selectors, counts[-1] if counts else None)

    def assignment(self, parts: list[Any]) -> Assignment:
        """Return an assignment."""
        return Assignment(parts[0], parts[1][1:].strip())
