"""Fields of a line: separated by commas, except within brackets, braces, quotes and slash lists."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from functools import lru_cache
from typing import NamedTuple

from mudline.basics.limits import MOST_FIELDS
from mudline.language.codes.fields import SYN003, SYN006
from mudline.language.diagnostics import Problem, Span

_KEY = re.compile(r"[ \t]*([A-Za-z][\w \t-]*)=")
_BLANKS = re.compile(r"[ \t]+")
_MARKS = ',"[{/'
_MARK = re.compile(r'[,"\[{/]')
_OUTER = " \t\r\n"
_NESTING = re.compile(r'[\[\]"/]')
_CLOSERS = {"[": "]", "{": "}", '"': '"', "/": "/"}


class Field(NamedTuple):
    """Text of a field without outer blanks, and its offset."""

    text: str
    start: int

    @property
    def span(self) -> Span:
        """Span of the field."""
        return Span(self.start, self.start + len(self.text))


@dataclass(slots=True)
class FieldGroup:
    """Fields that belong together: the positional fields of a line (key ""), or a KEY with its values."""

    key: str
    span: Span
    fields: list[Field] = field(default_factory=list)


class FieldLine(NamedTuple):
    """Line split into groups, with its problems."""

    span: Span
    groups: list[FieldGroup]
    problems: list[Problem]


def trimmed(text: str, start: int, end: int) -> Span:
    """Return the span without blanks, tabs and line ends on both sides; an empty span stands at `start`."""
    right = text[start:end].lstrip(_OUTER)
    left = end - len(right) if right else start
    return Span(left, left + len(right.rstrip(_OUTER)))


@lru_cache(1024)
def canonical_key(key: str) -> str:
    """Return a KEY in upper case with single blanks."""
    key = key.strip(" \t")
    return key.upper() if key.isalpha() else _BLANKS.sub(" ", key).upper()


def read_line(text: str, span: Span, *, slashes: bool = False) -> FieldLine:
    """Return one line of `text`, split into groups of fields; with `slashes`, `/.../` is one field."""
    body = trimmed(text, *span)
    fields, problems = split(text, body, slashes=slashes)
    if text.find("=", body.start, body.end) < 0:
        return FieldLine(body, [FieldGroup("", body, fields)] if fields else [], problems)
    groups: list[FieldGroup] = []
    for item in fields:
        match = _KEY.match(item.text) if "=" in item.text else None
        if match is None:
            if not groups:
                groups.append(FieldGroup("", body))
            groups[-1].fields.append(item)
            continue
        value = item.text[match.end() :].lstrip(_OUTER)
        first = Field(value, item.start + (len(item.text) - len(value) if value else match.end()))
        groups.append(FieldGroup(canonical_key(match[1]), item.span, [first]))
    for group in groups:
        if group.key and len(group.fields) > 1:
            group.span = Span(group.span.start, group.fields[-1].span.end)
    return FieldLine(body, groups, problems)


def first_key(text: str, span: Span) -> str:
    """Return the KEY at the beginning of a line, or ""."""
    match = _KEY.match(text, span.start, span.end)
    return canonical_key(match[1]) if match else ""


def split(text: str, span: Span, *, slashes: bool = False) -> tuple[list[Field], list[Problem]]:
    """Return the fields of a line without outer blanks, and the problems of its brackets.

    An unclosed bracket ends with the line.
    """
    start, end = span
    if end - start >= MOST_FIELDS and sum(text.count(mark, start, end) for mark in _MARKS) >= MOST_FIELDS:
        message = f"more than {MOST_FIELDS} fields or brackets on one line: is this a deck?"
        return [], [Problem(SYN003, message, Span(start, start + 1))]
    fields: list[Field] = []
    problems: list[Problem] = []
    closed = start
    for match in _MARK.finditer(text, start, end):
        mark, place = match[0], match.start()
        if place < closed:
            continue
        if mark == ",":
            fields.append(_field(text, start, place))
            start = place + 1
        elif _opens(text, place, span.start, slashes=slashes):
            closed = _close(text, place, end)
            if closed < 0:
                what = "=[" if mark == "[" else mark
                message = f"{what} is not closed: {_CLOSERS[mark]} is missing before the end of the line"
                problems.append(Problem(SYN006, message, Span(place - (mark == "["), place + 1)))
                break
    fields.append(_field(text, start, end))
    return fields, problems


def _field(text: str, start: int, end: int) -> Field:
    written = text[start:end]
    inner = written.strip(_OUTER)
    return Field(inner, start + (written.find(inner) if inner else 0))


def _opens(text: str, at: int, start: int, *, slashes: bool) -> bool:
    """Return True if a mark opens an equation, a label or a string, or as the first character of a field a list."""
    if text[at] == "[":
        return text[at - 1 : at] == "="
    if text[at] != "/":
        return True
    while at > start and text[at - 1] in " \t":
        at -= 1
    return slashes and (at == start or text[at - 1] == ",")


def is_one_field(text: str) -> bool:
    """Return True if a text is exactly one field of a line."""
    fields, problems = split(text, Span(0, len(text)))
    return len(fields) == 1 and not problems and fields[0].text == text


def _close(text: str, start: int, end: int) -> int:
    """Return the offset behind the mark that closes the mark at `start`, or -1.

    Strings and braces hold any text; square brackets nest; a slash list may hold equations and strings.
    """
    opener = text[start]
    if opener in '"{':
        at = text.find(_CLOSERS[opener], start + 1, end)
        return at + 1 if at >= 0 else -1
    depth = 0
    at = start + 1
    while match := _NESTING.search(text, at, end):
        at, mark = match.end(), match[0]
        if mark == '"':
            closing = text.find('"', at, end)
            at = closing + 1 if closing >= 0 else at
        elif mark == "/":
            if opener == "/" and depth == 0:
                return at
        elif mark == "[":
            depth += 1
        elif depth:
            depth -= 1
        elif opener == "[":
            return at
    return -1
