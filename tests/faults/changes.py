"""The changes of the table of kinds: `place: step then step`, done to the rows of a deck at a place.

A place is a name of `PLACES`, or a keyword and one of: nothing (its first row of numbers) or the number of such a row,
`KEY=` (the first such setting) or `KEY= -1` (the last), `line` (its own line), `block` (all its lines), `end` (the last
of these), `last` (its last data line), `equation` (its first row with one that multiplies).
Steps are those of `STEPS`; columns count from 0, a factor may be a name of `FACTORS`.
"""

from __future__ import annotations

import re
import shlex
from collections.abc import Callable, Sequence
from itertools import groupby

from tests.faults.draft import Draft, Row, plain, typed

PSI = 144.0
"""lbf/ft2 in a pound per square inch."""
FACTORS = {"millimetres": (1000.0, 12.0), "gigapascals": (1e-9, 1 / PSI), "megapascals": (1e-6, 1 / PSI)}
"""For metric decks, and for others, which are in inches and psi."""


def pipe(draft: Draft) -> Row:
    """The section of a steel pipe, the first of the deck."""
    row = draft.sections("RIGID")[0]
    draft.needs(draft.units in ("metric", "imperial"))
    draft.needs(draft.value(row, 0) > (1.5e11 if draft.units == "metric" else 3e9))
    return row


def node(draft: Draft) -> Row:
    """A node in the middle of the listed ones."""
    rows = draft.numbers("*NODE")
    return rows[len(rows) // 2]


def point(draft: Draft) -> Row:
    """A point in the middle of a curve."""
    points = draft.curve()
    return points[len(points) // 2]


def stiffness(draft: Draft) -> Row:
    """STIFFNESS= with a number."""
    row = draft.setting("*SEABED PROPERTIES", "STIFFNESS")
    draft.needs(row.text.partition("=")[2][:1].isdigit())
    return row


def elements_of(draft: Draft, label: str) -> list[Row]:
    """Elements that use a node."""
    return [row for row in draft.numbers("*ELEMENT") if label in draft.fields(row)[1:]]


def _surface(draft: Draft) -> Row:
    return draft.numbers("*ELASTIC SURFACE" if "*ELASTIC SURFACE" in draft.text else "*RIGID SURFACE")[0]


PLACES: dict[str, Callable[[Draft], Sequence[Row]]] = {
    "pipe": lambda draft: [pipe(draft)],
    "rigid": lambda draft: draft.sections("RIGID")[:1],
    "flexible": lambda draft: draft.sections("FLEXIBLE")[:1],
    "chain": lambda draft: draft.sections("MOORING", "TRUSS")[:1],
    "node": lambda draft: [node(draft)],
    "negative": lambda draft: [draft.first(row for row in draft.numbers("*NODE") if draft.field(row, 1)[:1] == "-")],
    "curve": lambda draft: draft.curve(),
    "head": lambda draft: [draft.keyed_above(draft.curve()[0])],
    "points": lambda draft: draft.curve()[1:],
    "point": lambda draft: [point(draft)],
    "stiffness": lambda draft: [stiffness(draft)],
    "surface": lambda draft: [_surface(draft)],
}
_PLACE = re.compile(
    r"(?P<keyword>[*$][A-Z-]+(?: [A-Z-]+)*?)(?: (?P<key>[A-Z]+)=)?(?: (?P<which>-?\d+|line|block|end|last|equation))?"
)


def apply(draft: Draft, change: str) -> None:
    """Do a change of the table to a deck; raises NotHere where it cannot be done."""
    place, _, steps = change.partition(": ")
    rows = _rows(draft, place)
    for is_end, words in groupby(shlex.split(steps), "then".__eq__):
        if not is_end:
            name, *arguments = words
            for row in rows:
                STEPS[name](draft, row, *arguments)


def _rows(draft: Draft, place: str) -> Sequence[Row]:
    if place in PLACES:
        return PLACES[place](draft)
    if place.startswith("point "):
        return [draft.curve()[int(place[6:])]]
    found = _PLACE.fullmatch(place)
    assert found, place
    keyword, key, which = found["keyword"], found["key"], found["which"]
    match which:
        case "line":
            return draft.block(keyword)[:1]
        case "block":
            return draft.block(keyword)
        case "end":
            return draft.block(keyword)[-1:]
        case "last":
            return draft.data(keyword)[-1:]
        case "equation":
            return [draft.first(row for row in draft.data(keyword) if "=[" in row.text and "*" in row.text)]
    rows = draft.settings(keyword, key) if key else draft.numbers(keyword)
    return [rows[int(which or 0)]]


def _under(draft: Draft, row: Row, keyword: str) -> None:
    above = [each.text for each in draft.rows[: draft.rows.index(row)] if each.text.startswith("*")]
    draft.needs(above[-1:] == [keyword])


def _scale(draft: Draft, row: Row, columns: str, by: str) -> None:
    factor = FACTORS[by][draft.units != "metric"] if by in FACTORS else float(by)
    values = {int(column): draft.value(row, int(column)) for column in columns.split(",")}
    draft.needs(any(values.values()))
    for at in (at for at, value in values.items() if value):
        draft.scale(row, at, factor)


def _value(draft: Draft, row: Row, by: str) -> None:
    """The first number of a setting multiplied."""
    number = row.text.partition("=")[2].partition(",")[0].strip()
    draft.swap(row, number, plain(typed(number) * float(by)))


def _type(draft: Draft, row: Row, column: str, old: str, new: str) -> None:
    draft.needs(old in draft.field(row, int(column)))
    draft.retyped(row, int(column), lambda field: field.replace(old, new, 1))


def thousands(draft: Draft, row: Row, column: str) -> None:
    """A number above a thousand gets a comma behind its first digit."""
    draft.needs(draft.value(row, int(column)) > 1000)
    draft.retyped(row, int(column), lambda old: f"{old[0]},{old[1:]}")


def _more(draft: Draft, row: Row, by: str) -> None:
    """A larger number at the end of GEN=, in a deck that has few of them."""
    head, _, last = row.text.strip().rpartition(", ")
    draft.needs(draft.text.count("GEN=") < 8)
    draft.write(row, f"{head}, {int(last) + int(by)}")


def _join(draft: Draft, row: Row, column: str, mark: str) -> None:
    """Another mark than a comma between a field and the next one."""
    fields, at = draft.fields(row), int(column)
    draft.write(row, ", ".join([*fields[:at], mark.join(fields[at : at + 2]), *fields[at + 2 :]]))


def _drop(draft: Draft, row: Row, column: str) -> None:
    fields = draft.fields(row)
    del fields[int(column)]
    draft.write(row, ", ".join(fields))


def lose(draft: Draft, row: Row) -> None:
    """A line is missing: what is seen is the next one."""
    at = draft.rows.index(row)
    draft.needs(at > 1)
    draft.mark(draft.rows[at + 1])
    draft.remove([row])


def typo(draft: Draft, row: Row) -> None:
    """Exchange the last two letters of the name of a setting."""
    text = row.text.rstrip()
    draft.needs(len(text) > 2 and text[-1] != text[-2] and text[-2:].isalpha())
    draft.needs("," not in text and not text.endswith("=ALL"))
    row.text = text[:-2] + text[-1] + text[-2]
    draft.mark(row)


def _also(draft: Draft, row: Row, place: str) -> None:
    """Mark the line above or below too, or another place."""
    beside = {"above": -1, "below": 1}.get(place)
    draft.mark(*([draft.rows[draft.rows.index(row) + beside]] if beside else _rows(draft, place)))


def cut(draft: Draft, row: Row) -> None:
    """The file ends behind a line."""
    del draft.rows[draft.rows.index(row) + 1 :]
    draft.mark(row)


STEPS: dict[str, Callable[..., object]] = {
    # conditions
    "fields": lambda draft, row, count: draft.needs(len(draft.fields(row)) == int(count)),
    "has": lambda draft, _, part: draft.needs(part in draft.text),
    "lacks": lambda draft, _, part: draft.needs(part not in draft.text),
    "under": _under,
    # fields
    "put": lambda draft, row, column, text: draft.put(row, int(column), text),
    "copy": lambda draft, row, column, to: draft.put(row, int(to), draft.field(row, int(column))),
    "scale": _scale,
    "value": _value,
    "minus": lambda draft, row, column: draft.put(row, int(column), f"-{draft.field(row, int(column))}"),
    "thousands": thousands,
    "type": _type,
    "end": lambda draft, row, column, text: draft.retyped(row, int(column), lambda field: field + text),
    "exchange": lambda draft, row, one, other: draft.exchange(row, int(one), int(other)),
    "more": _more,
    "join": _join,
    "drop": _drop,
    "keep": lambda draft, row, count: draft.write(row, ", ".join(draft.fields(row)[: int(count)])),
    # texts
    "swap": lambda draft, row, old, new: draft.swap(row, old, new),
    "replace": lambda draft, row, old, new: draft.write(row, row.text.strip().replace(old, new)),
    "write": lambda draft, row, text: draft.write(row, text),
    "add": lambda draft, row, text: draft.write(row, row.text.strip() + text),
    "typo": typo,
    # lines
    "before": lambda draft, row, text: draft.insert(draft.previous(row), text),
    "behind": lambda draft, row, *texts: draft.insert(row, *texts),
    "delete": lambda draft, row: draft.remove([row]),
    "cut": cut,
    "double": lambda draft, row: draft.insert(row, row.text),
    "lose": lose,
    "also": _also,
}
