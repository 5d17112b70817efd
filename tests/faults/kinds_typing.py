"""Faults of the keyboard: characters mistyped, left out, or brought along by pasting."""

from __future__ import annotations

from tests.faults.draft import Draft, Row, typed
from tests.faults.kind import Group, swap

TYPING = Group("typing")
kind = TYPING.kind

UNREADABLE = ("SYN001", "SYN002", "SYN003", "SYN015", "SYN016", "STY004")
"""A value or a line that cannot be read: which of these codes says so depends on the line."""


def _node(draft: Draft) -> Row:
    """A node in the middle of the listed ones."""
    rows = draft.numbers("*NODE")
    return rows[len(rows) // 2]


def _point(draft: Draft) -> Row:
    points = draft.curve()
    return points[len(points) // 2]


# -------------------------------------------------------------------------------------------------------- wrong letters


@kind("SYN002")
def letter_o_in_coordinate(draft: Draft) -> None:
    """The letter O for a zero in a coordinate."""
    row = next((each for each in draft.numbers("*NODE")[2:] if "0" in each.text.rpartition(",")[2]), None)
    draft.needs(row)
    if row:
        head, mark, last = row.text.rpartition(",")
        draft.write(row, f"{head}{mark}{last.replace('0', 'O', 1)}".strip())


@kind("SYN002")
def letter_o_in_section(draft: Draft) -> None:
    """The letter O for a zero in a section."""
    row = draft.sections("RIGID")[0]
    draft.retyped(row, 2, lambda text: text.replace("0", "O", 1))


@kind("SYN002")
def letter_l_for_one(draft: Draft) -> None:
    """The letter l for a one, in the water density."""
    draft.retyped(draft.numbers("*OCEAN")[0], 1, lambda text: text.replace("1", "l", 1))


@kind("SYN002")
def letter_o_in_curve(draft: Draft) -> None:
    """The letter O for a zero in a ratio."""
    draft.retyped(_point(draft), 0, lambda text: text.replace("0", "O", 1))


@kind("SYN002", "REF002", "SYN005")
def letter_o_in_stiffness(draft: Draft) -> None:
    """The letter O for a zero in STIFFNESS=, which makes it the name of a curve."""
    row = draft.setting("*SEABED PROPERTIES", "STIFFNESS")
    draft.needs(row.text.partition("=")[2][:1].isdigit())
    draft.swap(row, "0", "O")


@kind("SYN002", "SYN016")
def letter_in_node_number(draft: Draft) -> None:
    """The letter O in a node number of an element."""
    rows = [row for row in draft.numbers("*ELEMENT") if draft.field(row, 1).endswith("0")]
    draft.needs(rows)
    draft.retyped(rows[0], 1, lambda text: f"{text[:-1]}O")


# -------------------------------------------------------------------------------------------------- points and commas


@kind("SYN015", "SYN003", "SYN001", "UNT001")
def decimal_comma_in_ocean(draft: Draft) -> None:
    """9,81 for 9.81: one value too many, or a gravity of 9."""
    draft.retyped(draft.numbers("*OCEAN")[0], 2, lambda text: text.replace(".", ","))


@kind("SYN015", "SYN003", "SYN001", "UNT006")
def decimal_comma_in_coordinate(draft: Draft) -> None:
    """A decimal comma in a coordinate: the node gets a Z that it does not have, and its place is far off."""
    row = next((each for each in draft.numbers("*NODE")[1:] if draft.field(each, 1).startswith("-0.")), None)
    draft.needs(row)
    if row:
        draft.retyped(row, 1, lambda text: text.replace(".", ","))


@kind("SYN015", "SYN003", "SYN001", "GEO001", "SBD010")
def decimal_comma_in_section(draft: Draft) -> None:
    """A decimal comma in a diameter: a Do of 0, a Di of hundreds."""
    draft.retyped(draft.sections("RIGID")[0], 2, lambda text: text.replace(".", ","))


@kind("SYN015", "SYN003", "SYN001")
def decimal_comma_in_curve(draft: Draft) -> None:
    """A decimal comma in a ratio."""
    draft.retyped(_point(draft), 0, lambda text: text.replace(".", ","))


@kind("SYN015", "SYN003", "SYN001")
def decimal_commas_throughout(draft: Draft) -> None:
    """A curve pasted from a spreadsheet with decimal commas. Seen at any of its points."""
    for row in draft.curve():
        draft.write(row, row.text.replace(".", ",").strip())


@kind("SYN015", "SYN003", "SYN001")
def decimal_comma_in_stiffness(draft: Draft) -> None:
    """STIFFNESS=60000,0."""
    row = draft.setting("*SEABED PROPERTIES", "STIFFNESS")
    draft.needs(row.text.partition("=")[2][:1].isdigit())
    draft.swap(row, ".", ",")


@kind(*UNREADABLE)
def lost_comma_in_coordinates(draft: Draft) -> None:
    """The comma between X and Y is missing."""
    row = _node(draft)
    fields = draft.fields(row)
    draft.needs(len(fields) == 3)
    draft.write(row, f"{fields[0]}, {fields[1]} {fields[2]}")


@kind(*UNREADABLE)
def lost_comma_in_element(draft: Draft) -> None:
    """The comma between the nodes of an element is missing."""
    row = draft.numbers("*ELEMENT")[-1]
    fields = draft.fields(row)
    draft.write(row, f"{fields[0]}, {fields[1]} {fields[2]}")


@kind(*UNREADABLE)
def lost_comma_in_section(draft: Draft) -> None:
    """A comma of a section is missing."""
    row = draft.sections("RIGID")[0]
    draft.swap(row, ", ", " ")


@kind("SYN002", "SYN003")
def comma_too_many(draft: Draft) -> None:
    """Two commas between ratio and force."""
    draft.swap(_point(draft), ", ", ",, ")


@kind(*UNREADABLE)
def full_stop_for_comma(draft: Draft) -> None:
    """A full stop between two coordinates."""
    row = _node(draft)
    fields = draft.fields(row)
    draft.needs(len(fields) == 3)
    draft.write(row, f"{fields[0]}, {fields[1]}. {fields[2]}")


@kind(*UNREADABLE)
def semicolons(draft: Draft) -> None:
    """A row with semicolons, from a European CSV file."""
    row = _node(draft)
    draft.write(row, row.text.replace(",", ";").strip())


@kind("SYN002")
def two_points(draft: Draft) -> None:
    """0.1.5 for 0.15."""
    draft.retyped(_node(draft), 2, lambda text: f"{text[:1]}.{text[1:]}" if text.count(".") else "0.1.5")


@kind("SYN002")
def doubled_minus(draft: Draft) -> None:
    """--0.1 for -0.1."""
    row = next((each for each in draft.numbers("*NODE") if draft.field(each, 1).startswith("-")), None)
    draft.needs(row)
    if row:
        draft.swap(row, "-", "--")


@kind("SYN002", "SYN012")
def dash_for_minus(draft: Draft) -> None:
    """A dash for a minus sign, pasted from a word processor."""
    row = next((each for each in draft.numbers("*NODE") if draft.field(each, 1).startswith("-")), None)
    draft.needs(row)
    if row:
        draft.swap(row, "-", "\u2013")


@kind("SYN002", "SYN014")
def exponent_without_digits(draft: Draft) -> None:
    """2.07E for 2.07E11."""
    row = draft.sections("RIGID")[0]
    draft.retyped(row, 0, lambda text: text.partition("E")[0] + "E")


@kind("SYN002")
def blank_in_exponent(draft: Draft) -> None:
    """2.07 E11 for 2.07E11."""
    row = draft.sections("RIGID")[0]
    draft.needs("E" in draft.field(row, 0))
    draft.retyped(row, 0, lambda text: text.replace("E", " E"))


@kind("SYN002")
def power_of_ten(draft: Draft) -> None:
    """2.07x10^11 for 2.07E11."""
    row = draft.sections("RIGID")[0]
    draft.needs("E" in draft.field(row, 0))
    draft.retyped(row, 0, lambda text: text.replace("E", "x10^"))


@kind("STY003", "SYN002")
def fortran_exponent(draft: Draft) -> None:
    """2.07D11 for 2.07E11, out of an old Fortran file."""
    row = draft.sections("RIGID")[0]
    draft.needs("E" in draft.field(row, 0))
    draft.retyped(row, 0, lambda text: text.replace("E", "D"))


@kind("SYN003", "SYN015", "SYN001", "UNT004", "UNT001")
def thousands_separator(draft: Draft) -> None:
    """1,025.0 for 1025.0: a density of 1, a gravity of 25."""
    row = draft.numbers("*OCEAN")[0]
    draft.needs(draft.value(row, 1) > 1000)
    draft.retyped(row, 1, lambda text: f"{text[0]},{text[1:]}")
    if draft.units == "user":  # where either side of a contradiction may be the wrong one
        draft.mark(*draft.sections())


@kind(*UNREADABLE, "UNT004")
def thousands_separator_in_section(draft: Draft) -> None:
    """7,850.0 for 7850.0: a density of 7."""
    row = draft.sections("RIGID")[0]
    draft.needs(draft.value(row, 4) > 1000)
    draft.retyped(row, 4, lambda text: f"{text[0]},{text[1:]}")


@kind(*UNREADABLE)
def thousands_separator_in_curve(draft: Draft) -> None:
    """1,234.5 for a force of 1234.5."""
    row = next((each for each in draft.curve() if draft.value(each, 1) > 1000.0), None)
    draft.needs(row)
    if row:
        draft.retyped(row, 1, lambda text: f"{text[0]},{text[1:]}")


@kind("SYN002")
def blank_as_thousands_separator(draft: Draft) -> None:
    """60 000 for 60000."""
    row = draft.setting("*SEABED PROPERTIES", "STIFFNESS")
    text = row.text.partition("=")[2].strip()
    draft.needs(text[:1].isdigit() and typed(text) >= 10000)
    draft.swap(row, text, f"{int(typed(text)) // 1000} {int(typed(text)) % 1000:03}")


@kind("SYN002", "SYN001", "SYN003")
def unit_behind_value(draft: Draft) -> None:
    """1025.0 kg/m3, with the unit."""
    unit = {"metric": "kg/m3", "imperial": "slug/ft3"}.get(draft.units, "t/m3")
    draft.retyped(draft.numbers("*OCEAN")[0], 1, lambda text: f"{text} {unit}")


@kind("SYN002", "SYN001", "SYN003", "REF002")
def unit_behind_stiffness(draft: Draft) -> None:
    """STIFFNESS=60 kN/m/m, with the unit, which makes it the name of a curve."""
    row = draft.setting("*SEABED PROPERTIES", "STIFFNESS")
    draft.needs(row.text.partition("=")[2][:1].isdigit())
    draft.write(row, "STIFFNESS=60 kN/m/m")


@kind("SYN002", "SYN003")
def remark_behind_value(draft: Draft) -> None:
    """A remark at the end of a row."""
    draft.write(_node(draft), f"{_node(draft).text.strip()} ! hang-off")


@kind("SYN002", "SYN003")
def hash_remark_behind_value(draft: Draft) -> None:
    """A remark behind # at the end of a section."""
    row = draft.sections("RIGID")[0]
    draft.write(row, f"{row.text.strip()} # X65")


# -------------------------------------------------------------------------------------------------------- lost fields


@kind("SYN003", "SYN001", "UNT004")
def density_left_out(draft: Draft) -> None:
    """`*OCEAN` with depth and gravity only: a density of 9.81."""
    row = draft.numbers("*OCEAN")[0]
    fields = draft.fields(row)
    draft.write(row, f"{fields[0]}, {fields[2]}")


@kind("SYN003", "SYN001")
def inner_diameter_left_out(draft: Draft) -> None:
    """A section of RIGID with four values."""
    row = draft.sections("RIGID")[0]
    fields = draft.fields(row)
    draft.needs(len(fields) == 5)
    draft.write(row, ", ".join(fields[:3] + fields[4:]))


@kind("SYN003", "SYN001")
def coordinates_left_out(draft: Draft) -> None:
    """A node with its X only."""
    row = _node(draft)
    draft.write(row, ", ".join(draft.fields(row)[:2]))


@kind("SYN003", "SYN001")
def force_left_out(draft: Draft) -> None:
    """A point with a ratio and no force."""
    row = _point(draft)
    draft.write(row, draft.field(row, 0))


@kind("SYN003", "SYN001")
def second_node_left_out(draft: Draft) -> None:
    """An element with one node."""
    row = draft.numbers("*ELEMENT")[-1]
    draft.write(row, ", ".join(draft.fields(row)[:2]))


@kind("SYN003", "SYN001")
def third_value_at_a_point(draft: Draft) -> None:
    """A point with a third column, pasted from a table of three."""
    row = _point(draft)
    draft.write(row, f"{row.text.strip()}, 250.0")


# ------------------------------------------------------------------------------------------------- settings and choices


@kind("SYN004")
def misspelt_setting(draft: Draft) -> None:
    """STIFNESS= for STIFFNESS=."""
    draft.swap(draft.setting("*SEABED PROPERTIES", "STIFFNESS"), "STIFFNESS", "STIFNESS")


@kind("SYN004")
def misspelt_friction(draft: Draft) -> None:
    """FRICTON= for FRICTION=."""
    draft.swap(draft.setting("*SEABED PROPERTIES", "FRICTION"), "FRICTION", "FRICTON")


TYPING.row("misspelt-curve", "SYN004", "CURV= for CURVE=.", swap("*SEABED STIFFNESS", "CURVE", "CURVE", "CURV"))


@kind("SYN004")
def plural_setting(draft: Draft) -> None:
    """SETS= for SET= in `*GEOMETRIC SETS`."""
    draft.swap(draft.setting("*GEOMETRIC SETS", "SET"), "SET=", "SETS=")


TYPING.row("misspelt-choice", "SYN005", "TYPE=ELASTC.", swap("*SEABED PROPERTIES", "TYPE", "ELASTIC", "ELASTC"))


@kind("SYN005")
def unknown_option(draft: Draft) -> None:
    """OPTION=STEEL, which is not an option of a section."""
    draft.write(draft.setting("*GEOMETRIC SETS", "OPTION"), "OPTION=STEEL")


@kind("SYN001", "SYN002", "SYN004", "SYN003")
def colon_for_equals(draft: Draft) -> None:
    """SET: for SET=."""
    draft.swap(draft.setting("*SEABED PROPERTIES", "SET"), "=", ": ")


@kind("SYN001", "SYN002", "SYN003")
def equals_left_out(draft: Draft) -> None:
    """STIFFNESS and its value without =."""
    draft.swap(draft.setting("*SEABED PROPERTIES", "STIFFNESS"), "=", " ")


@kind("SYN001", "SYN002", "SYN003", "SYN005")
def empty_value(draft: Draft) -> None:
    """STIFFNESS= with nothing behind it."""
    draft.write(draft.setting("*SEABED PROPERTIES", "STIFFNESS"), "STIFFNESS=")


@kind("SYN001", "SYN002", "SYN003", "SYN005", "REF001")
def empty_set_name(draft: Draft) -> None:
    """SET= with nothing behind it."""
    draft.write(draft.setting("*SEABED PROPERTIES", "SET"), "SET=")


# ----------------------------------------------------------------------------------------------------------- equations


def _equation(draft: Draft, keyword: str) -> Row:
    row = next((each for each in draft.data(keyword) if "=[" in each.text and "*" in each.text), None)
    draft.needs(row)
    assert row
    return row


@kind("SYN006")
def unclosed_bracket(draft: Draft) -> None:
    """An equation without its closing bracket."""
    draft.swap(_equation(draft, "*GEOMETRIC SETS"), "WT]", "WT")


@kind("SYN017", "SYN006")
def unclosed_parenthesis(draft: Draft) -> None:
    """An equation with one parenthesis too few."""
    draft.swap(_equation(draft, "*GEOMETRIC SETS"), "))", ")")


@kind("REF013")
def misspelt_parameter(draft: Draft) -> None:
    """A parameter with a letter too few."""
    draft.swap(_equation(draft, "*SEABED STIFFNESS"), "Strength", "Strengh")


@kind("REF013")
def parameter_renamed(draft: Draft) -> None:
    """A parameter renamed where it is defined, not where it is used."""
    row = draft.data("*PARAMETERS")[0]
    draft.needs(row.text.strip().startswith("Depth") and "=[Depth]" in draft.text)
    row.text = row.text.replace("Depth", "Water Depth")
    draft.mark(next(each for each in draft.rows if "=[Depth]" in each.text))


@kind("REF017")
def parameter_defined_twice(draft: Draft) -> None:
    """A parameter added at the end of the list, that was there before."""
    draft.needs(draft.data("*PARAMETERS")[0].text.strip().startswith("Depth"))
    draft.insert(draft.data("*PARAMETERS")[-1], " Depth, 1150.0")


@kind("SYN017")
def operator_left_out(draft: Draft) -> None:
    """2WT for 2*WT."""
    draft.swap(_equation(draft, "*GEOMETRIC SETS"), "2*WT", "2 WT")


@kind("SYN016")
def label_without_braces(draft: Draft) -> None:
    """The label of a line's end without its braces."""
    row = draft.numbers("*BOUNDARY")[0]
    draft.needs("{" in row.text)
    draft.write(row, row.text.replace("{", "").replace("}", "").strip())
