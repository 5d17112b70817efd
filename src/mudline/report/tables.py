"""The sections of a page as tables, from their content."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any, NamedTuple

from mudline.limits import SHOWN_ROWS
from mudline.quantities import UnitNames, headed, labelled, shown
from mudline.results.summary import OPEN
from mudline.results.totals import NOT_KNOWN, touchdown_words
from mudline.scene.deck_curves import OF_SEABED
from mudline.short_repr import counted, cut
from mudline.study import Study
from mudline.study.screen import precision_table, stability_table, stages_table

MOST_CURVES = 50
"""Curves and sets that a page shows."""
_MOST_TOUCHDOWNS = 5
LONGEST, LONGEST_NAME = 600, 80
"""Characters of a message and of a name that a page shows."""

Cell = str | float | None


class Table(NamedTuple):
    """A table: its caption, heads and rows; what it says of rows that are left out; anchors of its rows and its own.

    `numeric` columns are set to the right also where their cells are texts.
    """

    caption: str
    heads: Sequence[str]
    rows: Sequence[Sequence[Cell]]
    note: str = ""
    anchors: Sequence[str] = ()
    anchor: str = ""
    numeric: frozenset[int] = frozenset()


def _table(
    caption: str,
    heads: Sequence[str],
    rows: Iterable[Sequence[Cell]],
    most: int = SHOWN_ROWS,
    anchor: str = "",
    longest: int = LONGEST_NAME,
) -> Table:
    found = [[cut(cell, longest) if isinstance(cell, str) else cell for cell in row] for row in rows]
    anchors = [f"{anchor}-{number}" for number in range(1, len(found[:most]) + 1)] if anchor else []
    note = _more(len(found) - most, "row")
    words = [head.replace("\n", " ") for head in heads]
    return Table(caption, words, found[:most], note, anchors)


def _elements(one: dict[str, Any]) -> str | int:
    """The elements of a set, with a plus where it may have more."""
    return f"{one['elements']}+" if one["open"] else one["elements"]


def _more(count: int, what: str) -> str:
    return f"{counted(count, f'more {what}')}: the JSON of this report has all" if count > 0 else ""


def _model(found: dict[str, Any], names: UnitNames) -> Iterator[Table]:
    more = "+" if found["sets"][0]["open"] else ""  # of ALL, which comes first
    counts = [(name, f"{found[name]}{more}") for name in ("nodes", "elements")]
    counts += [("seabed", found["floor"]["kind"]), (labelled("length of line", names.length), found["length"])]
    yield _table("Size", ("what", "value"), counts)._replace(numeric=frozenset({1}))
    sets = [(one["name"], _elements(one), one["length"]) for one in found["sets"]]
    heads: tuple[str, ...] = ("set", "elements", headed("length", names.length))
    yield _counting(_table("Element sets", heads, sets, MOST_CURVES), 1, found["sets"])
    sizes = [(one["diameter"], one["elements"]) for one in found["diameters"]]
    yield _table("External diameters", (headed("diameter", names.length), "elements"), sizes)
    heads = ("set", "law", headed("weight", names.line_force), "ratio", headed("penetration", names.length))
    rows = [
        [one[key] for key in ("set", "law", "weight", "ratio", "penetration", "stiffness")]
        for one in found["static_embedment"]
    ]
    yield _table("Static embedment", (*heads, headed("stiffness", names.stiffness)), rows)
    keywords = [
        (f"${section['name']}", f"*{one['keyword']}", _extent(one))
        for section in found["keywords"]
        for one in section["keywords"]
    ]
    yield _table("Keywords", ("section", "keyword", "lines"), keywords, 4 * SHOWN_ROWS)


def _extent(keyword: dict[str, Any]) -> str:
    return "read in part" if keyword["partly"] else "read" if keyword["read"] else "not read"


def _counting(table: Table, column: int, sets: Sequence[dict[str, Any]]) -> Table:
    """A table with the counts of `_elements` in a column, and with what a plus means, if there is one."""
    note = " ".join(filter(None, (table.note, OPEN if any(one["open"] for one in sets) else "")))
    return table._replace(numeric=frozenset({column}), note=note)


def _curves(found: dict[str, Any], names: UnitNames) -> Iterator[Table]:
    rows = [
        (*_named(one), _elements(one), _values(one["values"]), f"line {one['line']} of {one['file']}")
        for one in found["laws"]
    ]
    heads = ("law", "set", "elements", "values", "deck line")
    table = _table("Laws and resistance by set", heads, rows, MOST_CURVES, "law", longest=LONGEST)
    yield _counting(table, 2, found["laws"])
    for number, row in enumerate(found["curves"][:MOST_CURVES], 1):
        over, value = row["axes"]
        slopes = [one["slope"] for one in row["segments"]]
        points = [(x, y, slope) for (x, y), slope in zip(row["points"], [*slopes, None], strict=True)]
        caption = f"{row['kind']} {cut(row['name'], LONGEST_NAME)} (*{row['keyword']}): {counted(len(points), 'point')}"
        ends = f"; slope {shown(slopes[0])} below the first, {shown(slopes[-1])} above the last" if slopes else ""
        unit = names.line_force if row["kind"] == OF_SEABED else ""
        columns = (over, headed(value, unit), headed("slope to the next", unit))
        yield _table(caption + ends, columns, points)._replace(anchor=f"curve-{number}")
    yield Table("", (), (), _more(len(found["curves"]) - MOST_CURVES, "curve"))


def _named(law: dict[str, Any]) -> tuple[str, str]:
    return cut(law["law"], LONGEST_NAME), cut(law["set"], LONGEST_NAME)


def _values(values: dict[str, Any]) -> str:
    return "; ".join(f"{name.replace('_', ' ')} {_value(value)}" for name, value in values.items())


def _value(value: Any) -> str:  # noqa: ANN401 - whatever JSON holds
    if isinstance(value, dict):
        return ", ".join(_value(one) for one in value.values())
    if isinstance(value, list):
        between = " / " if any(isinstance(one, list) for one in value) else ", "
        return between.join("-" if one is None else _value(one) for one in value)
    return shown(value) if isinstance(value, float) else str(value)


def _contact(found: dict[str, Any], names: UnitNames) -> Iterator[Table]:
    figures = [
        (labelled("total reaction", names.force), _known(found["reaction"])),
        (labelled("submerged weight of the elements in contact", names.force), found["weight"]),
        ("reaction over weight", found["ratio"]),
    ]
    if deepest := found["deepest"]:
        words = labelled(f"largest penetration, element {deepest['element']}", names.length)
        figures.append((words, deepest["depth"]))
    yield _table("Equilibrium of the deck's own coordinates", ("what", "value"), figures)
    rows = [
        [one[key] for key in ("law", "set_name", "elements", "touching")]
        + [one["deepest"] if one["touching"] else None, one["reaction"]]
        for one in found["laws"]
    ]
    heads = ("law", "set", "elements", "in contact", headed("largest depth", names.length))
    yield _table("By law and set", (*heads, headed("reaction", names.force)), rows, MOST_CURVES)
    lines = [
        (
            one["line"],
            f"{one['first_element']} to {one['last_element']}",
            _touchdown(one),
            one["contact_length"],
            (one["largest_force"] or {}).get("force"),
            _known(one["reaction"]),
            one["ratio"],
        )
        for one in found["lines"]
    ]
    where = (headed("touchdown at arc length", names.length), headed("length in contact", names.length))
    forces = (headed("largest force", names.line_force), headed("reaction", names.force))
    yield _table("Touchdown", ("line", "elements", *where, *forces, "over weight"), lines)
    states = [(one["law"], one["state"], one["count"]) for one in found["states"]]
    yield _table("States", ("law", "state", "count"), states)
    warnings = [(one["code"], one["line"], cut(one["message"], LONGEST)) for one in found["warnings"]]
    yield Table("Warnings about these results", ("code", "deck line", "message"), warnings[:SHOWN_ROWS])


def _known(reaction: float | None) -> float | str:
    return NOT_KNOWN if reaction is None else reaction


def _touchdown(line: dict[str, Any]) -> str:
    places = [point["arc_length"] for point in line["touchdown"]]
    return touchdown_words(places, line["contact_length"], line["length"], _MOST_TOUCHDOWNS)


def study_tables(found: Study) -> list[Table]:
    """The tables of the screen of a study."""
    screens = [screen for make in (precision_table, stability_table, stages_table) if (screen := make(found))]
    return [
        Table(
            screen.title,
            [head.replace("\n", " ") for head in screen.heads],
            screen.rows,
            screen.note,
            numeric=frozenset(at for at, head in enumerate(screen.heads) if head not in screen.left),
        )
        for screen in screens
    ]


def _plan(found: dict[str, Any], _names: UnitNames) -> Iterator[Table]:
    rows = [(one["stage"], "in" if one["active"] else "left out", one["why"]) for one in found["stages"]]
    yield Table(f"Stages of the evaluation, {found['steps']}", ("stage", "in or out", "why"), rows)


TABLES: dict[str, Callable[[dict[str, Any], UnitNames], Iterator[Table]]] = {
    "model": _model,
    "curves": _curves,
    "contact": _contact,
    "plan": _plan,
}
"""What makes the tables of a section."""
