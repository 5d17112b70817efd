"""Faults of keyword lines and of files: misspelt, missing, commented in another program's way, cut off."""

from __future__ import annotations

from tests.faults.changes import apply, cut
from tests.faults.draft import Draft


def model_line_missing(draft: Draft) -> None:
    head = draft.block("$MODEL")[0]
    draft.needs(draft.rows[0] is head)
    draft.remove([head])
    draft.mark(draft.rows[0])


def points_before_set(draft: Draft) -> None:
    rows = draft.data("*EMBEDMENT")
    draft.needs(len([row for row in rows if "SET=" in row.text]) == 2)
    draft.mark(rows[1])
    draft.rows.remove(rows[0])


def points_before_curve(draft: Draft) -> None:
    rows = draft.data("*SEABED STIFFNESS")
    draft.mark(rows[1])
    at = draft.rows.index(rows[0])
    draft.rows.remove(rows[0])
    draft.rows.insert(at + 2, rows[0])


def comment_without_blank(draft: Draft) -> None:
    row = draft.setting("*SEABED PROPERTIES", "FRICTION")
    draft.write(row, f"C{row.text.strip()}")
    row.text = row.text.strip()


def table_of_the_interface(draft: Draft) -> None:
    rows = draft.data("*EMBEDMENT")
    name = rows[0].text.partition("=")[2]
    draft.needs(len([row for row in rows if "SET=" in row.text]) == 1 or "SET=" in rows[8].text)
    for row in rows[1:8]:
        draft.write(row, f"{name}, {row.text.strip()}")
    draft.remove(rows[:1])


def row_numbers_pasted(draft: Draft) -> None:
    for i, row in enumerate(draft.curve(), 1):
        draft.write(row, f"{i}, {row.text.strip()}")


def cut_behind_comma(draft: Draft) -> None:
    row = draft.curve()[-1]
    draft.needs("$LOAD" in draft.text)
    draft.write(row, f"{draft.field(row, 0)},")
    cut(draft, row)


def cut_in_equation(draft: Draft) -> None:
    row = draft.first(each for each in draft.data("*SEABED STIFFNESS") if "=[" in each.text)
    draft.write(row, row.text.partition("*")[0].strip())
    cut(draft, row)


def nul_bytes(draft: Draft) -> None:
    row = draft.numbers("*NODE")[-1]
    draft.write(row, row.text.strip()[:-1] + "\0")


def parameters_line_missing(draft: Draft) -> None:
    draft.needs("=[" in draft.text)
    head = draft.block("*PARAMETERS")[0]
    draft.mark(draft.data("*PARAMETERS")[0])
    draft.remove([head])


def surface_line_missing(draft: Draft) -> None:
    hydrodynamics = draft.block("*HYDRODYNAMIC SETS")
    draft.needs("*EMBEDMENT" in draft.text)
    draft.remove(hydrodynamics)
    apply(draft, "*ELASTIC SURFACE line: under '*GEOMETRIC SETS' then lose")


def unloading_in_properties(draft: Draft) -> None:
    last = draft.data("*SEABED PROPERTIES")[-1]
    sets = [row.text for row in draft.settings("*SEABED PROPERTIES", "SET")]
    draft.needs(draft.units == "metric" and "*SEABED UNLOADING" not in draft.text and "TYPE=RIGID" not in draft.text)
    new = draft.insert(last, *(line for name in sets for line in (name, " STIFFNESS=900000.0")), mark=False)
    draft.mark(new[0])


def pipe_option_over_flexible(draft: Draft) -> None:
    draft.mark(draft.sections("FLEXIBLE")[0])
    draft.needs("OPTION=FLEXIBLE" in draft.text)
    row = next(each for each in draft.settings("*GEOMETRIC SETS", "OPTION") if "FLEXIBLE" in each.text)
    row.text = " OPTION=RIGID"


def mooring_option_over_pipe(draft: Draft) -> None:
    first = draft.sections("RIGID")[0]
    draft.needs(len(draft.fields(first)) == 5 and draft.units != "user")
    row = next(each for each in draft.settings("*GEOMETRIC SETS", "OPTION") if "RIGID" in each.text)
    row.text = " OPTION=MOORING"
    draft.mark(first)
