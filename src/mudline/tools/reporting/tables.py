"""Sections of a page as tables."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import Any

from mudline.basics.display import DisplayTable, number, text
from mudline.basics.limits import SHOWN_ROWS
from mudline.basics.quantities import LINES, STEPS, labelled, shown
from mudline.basics.short_repr import counted, cut
from mudline.basics.units import UNITS
from mudline.model.results.summary_tables import (
    OPEN,
    diameter_table,
    elements_of,
    law_table,
    plan_table,
    set_table,
    sheet_tables,
    state_table,
    static_table,
    touchdown_table,
    weight_note,
)
from mudline.model.results.totals import NOT_KNOWN, touchdown_words
from mudline.model.scene.curves import OF_SEABED
from mudline.model.scene.sheet import Sheet
from mudline.tools.reporting.content import PageContent
from mudline.tools.touchdown_study.screen import TABLES as STUDY_TABLES

MOST_CURVES = 50
"""Curves and sets that a page shows."""
_FEW_INPUTS = 16
"""Inputs before the appendix, which has all."""
_MOST_TOUCHDOWNS = 5
LONGEST, LONGEST_NAME = 600, 80
"""Characters of a text, and of a name, in a table."""
_ALL = "the JSON of this report has all"


def on_page(table: DisplayTable, most: int = SHOWN_ROWS, longest: int = LONGEST_NAME) -> DisplayTable:
    """Return a table with at most `most` rows, and without empty columns; longer texts are cut."""
    return replace(table.filled().first(most, advice=_ALL), longest=longest)


def page_tables(report: PageContent) -> tuple[dict[str, list[DisplayTable]], dict[str, list[DisplayTable]]]:
    """Return the tables by section, and those of the appendix, which has the long ones too."""
    content, units = report.json, report.json["units"]
    sections = content["sections"]
    of_section = {"model": _model, "curves": _curves, "contact": _contact}
    of_appendix = {"model": _model_details, "curves": _curve_points, "contact": _states, "plan": _plan}
    tables, details = (
        {name: list(shape(sections[name], units)) for name, shape in each.items() if sections.get(name)}
        for each in (of_section, of_appendix)
    )
    if inputs := sections.get("inputs"):
        tables["inputs"] = list(_inputs(inputs, report.sheet, content["deck"]))
    for name, each in tables.items():
        if long := [table for table in each if len(table.rows) > table.few]:
            details[name] = [*long, *details.get(name, ())]
    if (study := report.study) is not None:
        tables["study"] = [
            on_page(table, longest=LONGEST) for part in study.parts if (table := STUDY_TABLES[part](study))
        ]
    return tables, details


_SHAPES = {"deck": "the deck's own coordinates", "rest shape": "the resting shape"}
"""Description of the shape of the line, by the source of its positions."""


def figure_table(content: dict[str, Any], units: str) -> DisplayTable:
    """Return the five numbers next to the verdict as a table of one row."""
    words = _touchdown(content["touchdown"], content["contact_length"], content["length"])
    doubt = f"warnings about these numbers: {', '.join(content['warnings'])}" if content["warnings"] else ""
    shape = f"at {_SHAPES[content['positions']]}; no load case is solved"
    notes = filter(None, [shape, _weight_note(content), doubt])
    columns = (
        LINES["first_touchdown"].column(units, lambda _: words),
        LINES["contact_length"].column(units),
        STEPS["deepest"].column(units, "depth"),
        STEPS["reaction"].column(units, missing=NOT_KNOWN),
        number("reaction over submerged weight", "ratio"),
    )
    return on_page(DisplayTable("Contact in five numbers", columns, [content], "; ".join(notes)))


def four_digits(value: float | None) -> str:
    """Return a number with four significant digits, without an exponent below ten million; "" for None."""
    text = shown(value, 4)
    return f"{float(text):.0f}" if "e+" in text and value is not None and abs(value) < _PLAIN else text


_PLAIN = 1e7


def _inputs(content: dict[str, Any], sheet: Sheet | None, deck: str) -> Iterator[DisplayTable]:
    """Yield the inputs of a deck and of the decks that it continues, and the sheet of the elements."""
    columns = (
        text("section", "section"),
        text("keyword", lambda row: f"*{row['keyword']}"),
        text("values", "values"),
        text("line", lambda row: str(row["line"]) if row["file"] == deck else f"{row['line']} of {row['file']}"),
    )
    title = "Water, conditions, loads, vessels and times"
    yield on_page(DisplayTable(title, columns, content["inputs"], few=_FEW_INPUTS), MOST_CURVES, LONGEST)
    for table in () if sheet is None else sheet_tables(sheet):
        yield on_page(table, 2 * SHOWN_ROWS)


def _model(content: dict[str, Any], units: str) -> Iterator[DisplayTable]:
    # empty and with contents side by side
    rows = sorted(content["static_embedment"], key=lambda row: int(row["element"]))
    yield on_page(static_table(rows, units, content["weights_without"], content["contents_case"], first=False))


def _model_details(content: dict[str, Any], units: str) -> Iterator[DisplayTable]:
    more = "+" if content["sets"][0]["open"] else ""  # of ALL, which comes first
    counts = [(name, f"{content[name]}{more}") for name in ("nodes", "elements")]
    counts += [
        ("seabed", content["floor"]["kind"]),
        (labelled("length of line", UNITS[units].unit("L")), content["length"]),
    ]
    yield on_page(DisplayTable("Size", _FIGURES, counts))
    yield on_page(set_table(content["sets"], units), MOST_CURVES)
    yield on_page(diameter_table(content["diameters"], units))
    keywords = [(section["name"], keyword) for section in content["keywords"] for keyword in section["keywords"]]
    columns = (
        text("section", lambda row: f"${row[0]}"),
        text("keyword", lambda row: f"*{row[1]['keyword']}"),
        text("lines", lambda row: "read in part" if row[1]["partly"] else "read" if row[1]["read"] else "not read"),
    )
    yield on_page(DisplayTable("Keywords", columns, keywords), 4 * SHOWN_ROWS)


_FIGURES = (text("what", 0), number("value", 1))


def _curves(content: dict[str, Any], _units: str) -> Iterator[DisplayTable]:
    columns = (
        text("law", lambda row: cut(row["law"], LONGEST_NAME)),
        text("set", lambda row: cut(row["set"], LONGEST_NAME)),
        number("elements", elements_of),
        text("values", "words"),
        text("deck line", lambda row: f"line {row['line']} of {row['file']}"),
    )
    note = OPEN if any(row["open"] for row in content["laws"]) else ""
    laws = DisplayTable("Laws and resistance by set", columns, content["laws"], note, row_anchor="law")
    yield on_page(laws, MOST_CURVES, LONGEST)


def _curve_points(content: dict[str, Any], units: str) -> Iterator[DisplayTable]:
    line_force = UNITS[units].unit("F/L")
    for place, row in enumerate(content["curves"][:MOST_CURVES], 1):
        over, value = row["axes"]
        slopes = [segment["slope"] for segment in row["segments"]]
        points = [(x, y, slope) for (x, y), slope in zip(row["points"], [*slopes, None], strict=True)]
        caption = f"{row['kind']} {cut(row['name'], LONGEST_NAME)} (*{row['keyword']}): {counted(len(points), 'point')}"
        of_seabed = row["kind"] == OF_SEABED
        ends = f"; slope {shown(slopes[0])} below the first, {shown(slopes[-1])} above the last" if slopes else ""
        own = ["", line_force] if of_seabed else [unit.replace("-", "") for unit in row.get("units", ["", ""])]
        slope = [number("slope to the next", 2, own[1])] if of_seabed else []
        of_points = (number(over, 0, own[0]), number(value, 1, own[1]), *slope)
        caption += ends if of_seabed else ""
        yield on_page(DisplayTable(caption, of_points, points, anchor=f"curve-{place}"))
    if (left := len(content["curves"]) - MOST_CURVES) > 0:
        yield DisplayTable("", (), (), f"{counted(left, 'more curve')}: {_ALL}")


def _weight_note(content: dict[str, Any]) -> str:
    return weight_note(content["weights_without"], content["contents_case"])


def _contact(content: dict[str, Any], units: str) -> Iterator[DisplayTable]:
    force = UNITS[units].unit("F")
    masses = "" if any(keyword.startswith("*MASS") for keyword in content["weights_without"]) else " and masses"
    weight = f"submerged weight of the elements in contact, with contents{masses}"
    figures = [
        (labelled("total reaction", force), NOT_KNOWN if content["reaction"] is None else content["reaction"]),
        (labelled(weight, force), content["weight"]),
        (labelled("the same, empty", force), content["empty_weight"]),
        ("reaction over weight with contents", content["ratio"]),
    ]
    if deepest := content["deepest"]:
        words = labelled(f"largest depth, element {deepest['element']}", UNITS[units].unit("L"))
        figures.append((words, deepest["depth"]))
    notes = [_weight_note(content), *content["notes"]]
    title = f"Equilibrium of {_SHAPES[content['positions']]}"
    yield on_page(DisplayTable(title, _FIGURES, figures, "; ".join(filter(None, notes))))
    yield on_page(law_table("By law and set", content["laws"], units), MOST_CURVES)

    def of_line(line: dict[str, Any]) -> str:
        places = (point["arc_length"] for point in line["touchdown"])
        return _touchdown(places, line["contact_length"], line["length"])

    yield on_page(touchdown_table(content["lines"], units, of_line, _weight_note(content)))
    columns = [text("code", "code"), number("deck line", "line"), text("message", "message")]
    warnings = content["warnings"][:SHOWN_ROWS]
    yield on_page(DisplayTable("Warnings about these results", columns, warnings), longest=LONGEST)


def _states(content: dict[str, Any], _units: str) -> Iterator[DisplayTable]:
    yield on_page(state_table(content["states"]))


def _touchdown(places: Iterable[float], in_contact: float, length: float) -> str:
    return touchdown_words([float(four_digits(each)) for each in places], in_contact, length, _MOST_TOUCHDOWNS)


def _plan(content: dict[str, Any], _units: str) -> Iterator[DisplayTable]:
    stages = content["stages"]
    yield on_page(plan_table(stages, content["steps"]), len(stages), LONGEST)
