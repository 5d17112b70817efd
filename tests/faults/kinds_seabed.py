"""Faults of the two families of seabed keywords, and of the law that a set gets."""

from __future__ import annotations

from tests.faults.draft import Draft, plain
from tests.faults.kind import Group

SEABED = Group("seabed laws and families")
kind = SEABED.kind


# ------------------------------------------------------------------------------------------------------------- seabeds


@kind("SBD003")
def type_left_out(draft: Draft) -> None:
    """`*SEABED PROPERTIES` without TYPE=. Seen at the keyword or at the line behind."""
    block = draft.block("*SEABED PROPERTIES")
    draft.remove([draft.setting("*SEABED PROPERTIES", "TYPE")])
    draft.mark(block[0], block[2])


@kind("SBD003")
def first_set_left_out(draft: Draft) -> None:
    """The first law of `*SEABED PROPERTIES` without SET=. Seen at its first line."""
    row = draft.setting("*SEABED PROPERTIES", "SET")
    rows = draft.data("*SEABED PROPERTIES")
    draft.mark(rows[rows.index(row) + 1])
    draft.remove([row])


@kind("SBD006")
def stiffness_left_out(draft: Draft) -> None:
    """A law with friction and no stiffness. Seen at its SET= or its friction."""
    rows = draft.data("*SEABED PROPERTIES")
    draft.needs("STIFFNESS=" in rows[2].text and len(rows) > 3 and "FRICTION=" in rows[3].text)
    draft.remove([rows[2]])
    draft.mark(rows[1], rows[3])


@kind("SBD006", "UNT002", "SBD010")
def stiffness_zero(draft: Draft) -> None:
    """STIFFNESS=0. Seen there or at its SET=."""
    row = draft.setting("*SEABED PROPERTIES", "STIFFNESS")
    draft.write(row, "STIFFNESS=0.0")
    draft.mark(draft.previous(row))


@kind("SBD010")
def stiffness_negative(draft: Draft) -> None:
    """STIFFNESS= with a minus."""
    row = draft.setting("*SEABED PROPERTIES", "STIFFNESS")
    draft.needs(row.text.partition("=")[2][:1].isdigit())
    draft.swap(row, "=", "=-")


@kind("SBD010")
def friction_negative(draft: Draft) -> None:
    """A friction coefficient with a minus."""
    draft.swap(draft.setting("*SEABED PROPERTIES", "FRICTION"), "=", "=-")


@kind("SBD010", "SBD019")
def mobilisation_zero(draft: Draft) -> None:
    """A mobilisation length of 0, meant as rigid-plastic."""
    row = draft.setting("*SEABED PROPERTIES", "FRICTION")
    fields = draft.fields(row)
    draft.needs(len(fields) == 4)
    draft.write(row, ", ".join([*fields[:2], "0.0", "0.0"]))


@kind("SBD019")
def mobilisation_tiny(draft: Draft) -> None:
    """A mobilisation length of a thousandth of a millimetre, meant as rigid-plastic."""
    row = draft.setting("*SEABED PROPERTIES", "FRICTION")
    fields = draft.fields(row)
    draft.needs(len(fields) == 4)
    draft.write(row, ", ".join([*fields[:2], "1.0E-6", "1.0E-6"]))


@kind("SBD024")
def one_friction_coefficient(draft: Draft) -> None:
    """FRICTION=0.35 alone, meant for both directions."""
    row = draft.setting("*SEABED PROPERTIES", "FRICTION")
    fields = draft.fields(row)
    draft.needs(len(fields) == 2 and fields[1] not in ("0.0", "0"))
    draft.write(row, fields[0])


@kind("SBD024")
def one_legacy_coefficient(draft: Draft) -> None:
    """A legacy surface with one friction coefficient, meant for both directions."""
    surface = "*ELASTIC SURFACE" if "*ELASTIC SURFACE" in draft.text else "*RIGID SURFACE"
    row = draft.numbers(surface)[0]
    draft.write(row, ", ".join(draft.fields(row)[:-1]))


@kind("SBD006")
def law_of_one_set_deleted(draft: Draft) -> None:
    """The law of the set on the seabed deleted: its elements have none. Seen at the block, a law or an element."""
    rows = draft.data("*SEABED PROPERTIES")
    sets = [row for row in rows if "SET=" in row.text]
    draft.needs(len(sets) == 2 and sets[0].text.strip() != "SET=ALL" and "*LINES" not in draft.text)
    draft.remove(rows[rows.index(sets[0]) : rows.index(sets[1])])
    name = sets[0].text.strip()
    draft.mark(*draft.block("*SEABED PROPERTIES"), *(row for row in draft.rows if row.text.strip() == name))
    draft.mark(*draft.numbers("*ELEMENT"))


@kind("SBD006")
def seabed_on_the_wrong_set(draft: Draft) -> None:
    """The law given to the part that hangs, not to that on the seabed. Seen at the law or at an element."""
    row = draft.setting("*SEABED PROPERTIES", "SET")
    names = [each.text.strip() for each in draft.settings("*ELEMENT SETS", "SET")]
    draft.needs(row.text.strip() == "SET=ALL" and len(names) >= 2)
    draft.needs(len(draft.settings("*SEABED PROPERTIES", "SET")) == 1)
    draft.write(row, names[-1])
    draft.mark(*draft.block("*SEABED PROPERTIES"), *draft.numbers("*ELEMENT"))


@kind("SBD007")
def lateral_with_friction(draft: Draft) -> None:
    """LATERAL= added to a law with transverse friction. Seen at LATERAL= or FRICTION=."""
    row = draft.setting("*SEABED PROPERTIES", "FRICTION")
    draft.needs("LATERAL" not in draft.text and draft.units == "metric" and not draft.field(row, 1).startswith("0.0"))
    draft.insert(row, " LATERAL=20000.0")
    draft.mark(row)


@kind("SBD007")
def friction_with_lateral(draft: Draft) -> None:
    """The transverse coefficient filled in beside LATERAL=. Seen at LATERAL= or FRICTION=."""
    lateral = draft.setting("*SEABED PROPERTIES", "LATERAL")
    draft.swap(draft.setting("*SEABED PROPERTIES", "FRICTION"), ", 0.0", ", 0.6")
    draft.mark(lateral)


@kind("SBD015", "SBD010", "SYN002", "SYN003")
def extent_without_stiffness(draft: Draft) -> None:
    """SUCTION= with the extent of the zone and without its stiffness."""
    row = draft.setting("*SEABED PROPERTIES", "SUCTION")
    draft.write(row, f"SUCTION=, {draft.field(row, 1)}")


@kind("SBD002", "SBD001", "SBD005")
def rigid_type_over_curves(draft: Draft) -> None:
    """TYPE=RIGID in a deck with laws of an elastic seabed. Seen at TYPE= or at a law."""
    row = draft.setting("*SEABED PROPERTIES", "TYPE")
    draft.swap(row, "ELASTIC", "RIGID")
    draft.mark(
        *(each for each in draft.data("*SEABED PROPERTIES") if each.text.strip()[:4] in ("STIF", "LATE", "SUCT"))
    )


# ------------------------------------------------------------------------------------------------------------ families


@kind("SBD016")
def legacy_curve_in_new_deck(draft: Draft) -> None:
    """`*EMBEDMENT` pasted into a deck of `*SEABED PROPERTIES`. Seen at either keyword, or at a line of it."""
    block = draft.block("*SEABED PROPERTIES")
    draft.needs("TYPE=ELASTIC" in block[1].text)
    name = draft.setting("*SEABED PROPERTIES", "SET").text.strip()
    factor = 0.0685 if draft.units == "imperial" else 0.001 if draft.units == "user" else 1.0
    points = [f" {ratio}, {plain(force * factor)}" for ratio, force in ((0.1, 700.0), (0.2, 900.0), (0.5, 1300.0))]
    draft.insert(block[-1], "*EMBEDMENT", f" {name}", " 0.0, 0.0", *points)
    draft.mark(*block)


@kind("SBD016")
def surface_in_new_deck(draft: Draft) -> None:
    """`*ELASTIC SURFACE` left in a deck that has `*SEABED PROPERTIES`. Seen at either keyword, or at a line of it."""
    block = draft.block("*SEABED PROPERTIES")
    draft.needs("TYPE=ELASTIC" in block[1].text and draft.units == "metric")
    draft.insert(block[-1], "*ELASTIC SURFACE", " 40000.0, 0.35, 0.6")
    draft.mark(*block)


@kind("SBD002")
def rigid_surface_in_new_deck(draft: Draft) -> None:
    """`*RIGID SURFACE` left in a deck of an elastic seabed. Seen at either keyword, or at a line of it."""
    block = draft.block("*SEABED PROPERTIES")
    draft.needs("TYPE=ELASTIC" in block[1].text)
    draft.insert(block[-1], "*RIGID SURFACE", " 0.3, 0.5")
    draft.mark(*block)


@kind("SBD002")
def both_surfaces(draft: Draft) -> None:
    """`*RIGID SURFACE` left beside `*ELASTIC SURFACE`. Seen at either."""
    block = draft.block("*ELASTIC SURFACE")
    draft.insert(block[-1], "*RIGID SURFACE", " 0.3, 0.5")
    draft.mark(*block)


@kind("SBD005", "SBD002")
def rigid_for_elastic_surface(draft: Draft) -> None:
    """`*RIGID SURFACE` where `*EMBEDMENT` needs an elastic one. Seen at either keyword or a set of the curves."""
    draft.mark(*(row for row in draft.data("*EMBEDMENT") if "SET=" in row.text), draft.block("*EMBEDMENT")[0])
    rows = draft.block("*ELASTIC SURFACE")
    draft.write(rows[0], "*RIGID SURFACE")
    draft.write(rows[1], "0.35, 0.6")


@kind("SBD005")
def surface_deleted(draft: Draft) -> None:
    """`*ELASTIC SURFACE` deleted, `*EMBEDMENT` left. Seen there, or at a set of the curves."""
    draft.mark(*(row for row in draft.data("*EMBEDMENT") if "SET=" in row.text), draft.block("*EMBEDMENT")[0])
    draft.remove(draft.block("*ELASTIC SURFACE"))


@kind("SBD004", "SBD006")
def embedment_deleted(draft: Draft) -> None:
    """`*EMBEDMENT` deleted, `*ELASTIC SURFACE` without a stiffness. Seen there."""
    rows = draft.block("*ELASTIC SURFACE")
    draft.needs(rows[1].text.strip().startswith(","))
    draft.remove(draft.block("*EMBEDMENT"))
    draft.mark(*rows)


@kind("SBD004", "SBD006", "SYN003")
def surface_stiffness_left_out(draft: Draft) -> None:
    """`*ELASTIC SURFACE` without its stiffness, and no curves. Seen there."""
    draft.needs("*EMBEDMENT" not in draft.text)
    rows = draft.block("*ELASTIC SURFACE")
    draft.write(rows[1], ", " + ", ".join(draft.fields(rows[1])[1:]))
    draft.mark(rows[0])


@kind("SBD013")
def legacy_order_in_friction(draft: Draft) -> None:
    """The row of a legacy surface behind FRICTION=: characteristic lengths where mobilisation lengths belong."""
    row = draft.setting("*SEABED PROPERTIES", "FRICTION")
    fields = draft.fields(row)
    draft.needs(len(fields) == 2 and draft.units in ("metric", "imperial"))
    length = "3.048" if draft.units == "metric" else "10.0"
    draft.write(row, ", ".join([*fields, length, length]))


@kind("SYN001", "SYN002", "SYN003")
def legacy_row_in_new_block(draft: Draft) -> None:
    """The row of `*ELASTIC SURFACE` under `*SEABED PROPERTIES`."""
    rows = draft.data("*SEABED PROPERTIES")
    draft.needs("TYPE=ELASTIC" in rows[0].text)
    draft.remove(rows[1:])
    draft.insert(rows[0], " 40000.0, 0.35, 0.6")


@kind("SYN001", "SYN004")
def new_settings_in_old_block(draft: Draft) -> None:
    """STIFFNESS= and FRICTION= under `*ELASTIC SURFACE`."""
    row = draft.numbers("*ELASTIC SURFACE")[0]
    draft.write(row, "STIFFNESS=40000.0")
    draft.insert(row, " FRICTION=0.35, 0.6")


@kind("SYN004", "SYN001", "SYN013")
def curve_for_set_in_embedment(draft: Draft) -> None:
    """CURVE= for SET= under `*EMBEDMENT`, which a C in column 1 makes a comment."""
    draft.swap(draft.setting("*EMBEDMENT", "SET"), "SET=", "CURVE=")


@kind("SYN004", "SYN001")
def set_for_curve_in_stiffness(draft: Draft) -> None:
    """SET= for CURVE= under `*SEABED STIFFNESS`."""
    draft.swap(draft.setting("*SEABED STIFFNESS", "CURVE"), "CURVE=", "SET=")


@kind("SYN008")
def seabed_in_load_case(draft: Draft) -> None:
    """The seabed moved into the load case. Seen at its keyword."""
    block = draft.block("*SEABED PROPERTIES")
    texts = [row.text for row in block]
    case = draft.block("$LOAD CASE")[0]
    draft.needs(draft.rows.index(case) > draft.rows.index(block[0]))
    draft.remove(block)
    draft.mark(draft.insert(case, *texts, mark=False)[0])


@kind("SYN008")
def boundary_in_model(draft: Draft) -> None:
    """`*BOUNDARY` moved into the model. Seen at its keyword."""
    block = draft.block("*BOUNDARY")
    head = draft.block("$MODEL")[0]
    draft.needs(draft.rows.index(head) < draft.rows.index(block[0]) and "*RESTART" not in draft.text)
    texts = [row.text for row in block if row.text.strip()]
    draft.remove(block)
    draft.mark(draft.insert(head, *texts, mark=False)[0])


@kind("SYN003")
def option_line_deleted(draft: Draft) -> None:
    """OPTION=RIGID deleted, so that the section is read as FLEXIBLE. Seen at the property line."""
    row = draft.setting("*GEOMETRIC SETS", "OPTION")
    pipe = draft.sections("RIGID")[0]
    draft.remove([row])
    draft.mark(pipe)


@kind("SYN003", "SYN001")
def section_of_other_option(draft: Draft) -> None:
    """OPTION=RIGID over the values of a mooring line. Seen at the property line."""
    draft.mark(draft.sections("MOORING")[0])
    row = draft.setting("*GEOMETRIC SETS", "OPTION")
    draft.needs("MOORING" in row.text)
    row.text = " OPTION=RIGID"


@kind("GEO002")
def number_beside_curve(draft: Draft) -> None:
    """A bending stiffness left beside its curve. Seen at the property line or at its SET=."""
    row = draft.sections("FLEXIBLE")[0]
    head = draft.previous(row)
    draft.needs(", EI=" in head.text)
    draft.write(row, ", ".join(["90000.0", "90000.0", *draft.fields(row)[2:]]))
    draft.mark(head)


@kind("EXT001", "SBD002", "SBD001")
def extension_on_rigid_seabed(draft: Draft) -> None:
    """TYPE=RIGID under an extension keyword. Seen at TYPE=, at a law of it, or at the extension keyword."""
    name = next((each for each in ("CONTACT", "SUCTION", "TRENCH", "UNLOADING") if f"*SEABED {each}" in draft.text), "")
    head = draft.block(f"*SEABED {name}")
    draft.swap(draft.setting("*SEABED PROPERTIES", "TYPE"), "ELASTIC", "RIGID")
    draft.mark(*head, *draft.settings("*SEABED PROPERTIES", "STIFFNESS"))


@kind("EXT002")
def planes_and_slope(draft: Draft) -> None:
    """`*SEABED PLANES` together with a sloping profile. Seen at either keyword."""
    block = draft.block("*SEABED PLANES")
    draft.insert(block[-1], "*SEABED PROFILE", " TYPE=SLOPING", " SLOPE=1.0")
    draft.mark(*block)


@kind("SBD011")
def three_dimensional_rigid(draft: Draft) -> None:
    """A 3D survey under a rigid seabed. Seen at the profile or at TYPE=RIGID."""
    row = draft.setting("*SEABED PROFILE", "TYPE")
    draft.needs("TYPE=RIGID" in draft.text)
    draft.write(row, "TYPE=3D")
    draft.write(draft.setting("*SEABED PROFILE", "SLOPE"), "FILE=bed.fcsbd")
    draft.mark(draft.setting("*SEABED PROPERTIES", "TYPE"), draft.block("*SEABED PROFILE")[0])


@kind("EXT003")
def trench_widths_exchanged(draft: Draft) -> None:
    """The bottom of a trench wider than its top."""
    draft.exchange(draft.setting("*SEABED TRENCH", "GEOMETRY"), 1, 2)


@kind("SYN003", "SYN001", "SBD006", "REF002", "REF018", "GEO005")
def ocean_deleted(draft: Draft) -> None:
    """`*OCEAN` deleted from a deck with waves or currents. Seen at the first line, or at the wave or current."""
    waves = [row for row in draft.rows if row.text.startswith(("*WAVE", "*CURRENT"))]
    draft.needs(waves)
    draft.mark(draft.rows[0], *waves)
    draft.remove(draft.block("*OCEAN"))
