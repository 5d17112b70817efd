"""Faults of the keyboard: characters mistyped, left out, or brought along by pasting."""

from __future__ import annotations

from tests.faults.changes import node
from tests.faults.draft import Draft, typed


def letter_o_in_coordinate(draft: Draft) -> None:
    row = draft.first(each for each in draft.numbers("*NODE")[2:] if "0" in each.text.rpartition(",")[2])
    head, mark, last = row.text.rpartition(",")
    draft.write(row, f"{head}{mark}{last.replace('0', 'O', 1)}".strip())


def letter_in_node_number(draft: Draft) -> None:
    rows = [row for row in draft.numbers("*ELEMENT") if draft.field(row, 1).endswith("0")]
    draft.needs(rows)
    draft.retyped(rows[0], 1, lambda text: f"{text[:-1]}O")


def decimal_comma_in_coordinate(draft: Draft) -> None:
    row = draft.first(each for each in draft.numbers("*NODE")[1:] if draft.field(each, 1).startswith("-0."))
    draft.retyped(row, 1, lambda text: text.replace(".", ","))


def two_points(draft: Draft) -> None:
    draft.retyped(node(draft), 2, lambda text: f"{text[:1]}.{text[1:]}" if text.count(".") else "0.1.5")


def exponent_without_digits(draft: Draft) -> None:
    row = draft.sections("RIGID")[0]
    draft.retyped(row, 0, lambda text: text.partition("E")[0] + "E")


def thousands_separator(draft: Draft) -> None:
    row = draft.numbers("*OCEAN")[0]
    draft.needs(draft.value(row, 1) > 1000)
    draft.retyped(row, 1, lambda text: f"{text[0]},{text[1:]}")
    if draft.units == "user":  # where either side of a contradiction may be the wrong one
        draft.mark(*draft.sections())


def thousands_separator_in_curve(draft: Draft) -> None:
    row = draft.first(each for each in draft.curve() if draft.value(each, 1) > 1000.0)
    draft.retyped(row, 1, lambda text: f"{text[0]},{text[1:]}")


def blank_as_thousands_separator(draft: Draft) -> None:
    row = draft.setting("*SEABED PROPERTIES", "STIFFNESS")
    text = row.text.partition("=")[2].strip()
    draft.needs(text[:1].isdigit() and typed(text) >= 10000)
    draft.swap(row, text, f"{int(typed(text)) // 1000} {int(typed(text)) % 1000:03}")


def unit_behind_value(draft: Draft) -> None:
    unit = {"metric": "kg/m3", "imperial": "slug/ft3"}.get(draft.units, "t/m3")
    draft.retyped(draft.numbers("*OCEAN")[0], 1, lambda text: f"{text} {unit}")


def parameter_renamed(draft: Draft) -> None:
    row = draft.data("*PARAMETERS")[0]
    draft.needs(row.text.strip().startswith("Depth") and "=[Depth]" in draft.text)
    row.text = row.text.replace("Depth", "Water Depth")
    draft.mark(next(each for each in draft.rows if "=[Depth]" in each.text))


def parameter_defined_twice(draft: Draft) -> None:
    draft.needs(draft.data("*PARAMETERS")[0].text.strip().startswith("Depth"))
    draft.insert(draft.data("*PARAMETERS")[-1], " Depth, 1150.0")


def label_without_braces(draft: Draft) -> None:
    row = draft.numbers("*BOUNDARY")[0]
    draft.needs("{" in row.text)
    draft.write(row, row.text.replace("{", "").replace("}", "").strip())
