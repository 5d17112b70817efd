"""Faults of lengths and axes: diameters and coordinates in another unit, from another datum, along another axis."""

from __future__ import annotations

from tests.faults.draft import Draft, Row, plain
from tests.faults.kind import Group
from tests.faults.kinds_units import FOOT, ocean_row, only, per_length, pipe_row

LENGTHS = Group("lengths and axes")
kind = LENGTHS.kind


# ------------------------------------------------------------------------------------------------------------- lengths


@kind("UNT006", "UNT002")
def diameters_in_millimetres(draft: Draft) -> None:
    """Both diameters of a pipe in mm (in inches, in an imperial deck)."""
    row = pipe_row(draft)
    for column in (2, 3):
        draft.scale(row, column, per_length(draft))


@kind("UNT006", "UNT002")
def diameters_in_inches(draft: Draft) -> None:
    """Both diameters of a pipe in inches, in a metric deck."""
    row = pipe_row(draft)
    only(draft, "metric")
    draft.needs(draft.value(row, 2) < 2.0)
    for column in (2, 3):
        draft.scale(row, column, 1 / 0.0254)


@kind("UNT006", "UNT002", "GEO001")
def outer_diameter_in_millimetres(draft: Draft) -> None:
    """Do alone in mm or inches: a wall far thicker than the bore."""
    draft.scale(pipe_row(draft), 2, per_length(draft))


@kind("GEO001")
def inner_diameter_in_millimetres(draft: Draft) -> None:
    """Di alone in mm or inches: larger than Do."""
    draft.scale(pipe_row(draft), 3, per_length(draft))


@kind("UNT006")
def wall_for_inner_diameter(draft: Draft) -> None:
    """The wall thickness where Di belongs."""
    row = pipe_row(draft)
    draft.put(row, 3, plain((draft.value(row, 2) - draft.value(row, 3)) / 2))


LENGTHS.row("diameters-exchanged", "GEO001", "Di first, then Do.", lambda draft: draft.exchange(pipe_row(draft), 2, 3))


@kind("UNT006", "UNT002")
def mooring_diameter_in_millimetres(draft: Draft) -> None:
    """Do of a chain or a rope in mm (in inches, in an imperial deck)."""
    only(draft, "metric", "imperial")
    draft.scale(draft.sections("MOORING", "TRUSS")[0], 2, per_length(draft))


@kind("UNT006")
def mooring_mass_in_tonnes(draft: Draft) -> None:
    """The mass of a chain in t/m."""
    only(draft, "metric")
    draft.scale(draft.sections("MOORING", "TRUSS")[0], 1, 0.001)


@kind("UNT006", "UNT002")
def flexible_diameters_in_millimetres(draft: Draft) -> None:
    """All diameters of a flexible in mm (in inches, in an imperial deck)."""
    only(draft, "metric", "imperial")
    row = draft.sections("FLEXIBLE")[0]
    draft.needs(len(draft.fields(row)) == 10)
    for column in (6, 7, 8, 9):
        draft.scale(row, column, per_length(draft)) if draft.value(row, column) else None


@kind("UNT006")
def flexible_mass_in_tonnes(draft: Draft) -> None:
    """The mass of a flexible in t/m."""
    only(draft, "metric")
    draft.scale(draft.sections("FLEXIBLE")[0], 4, 0.001)


@kind("UNT006")
def flexible_mass_in_pounds(draft: Draft) -> None:
    """The mass of a flexible in lb/ft in an imperial deck, in kg/m in a deck of tonnes."""
    draft.needs(draft.units == "imperial" or (draft.units == "user" and draft.value(ocean_row(draft), 1) < 2.0))
    draft.scale(draft.sections("FLEXIBLE")[0], 4, 32.174 if draft.units == "imperial" else 1000.0)


@kind("UNT006", "UNT002")
def coating_in_millimetres(draft: Draft) -> None:
    """Drag and buoyancy diameters of a coated pipe in mm (in inches, in an imperial deck)."""
    row = pipe_row(draft)
    draft.needs(len(draft.fields(row)) > 9)
    for column in (8, 9):
        draft.scale(row, column, per_length(draft))


@kind("UNT006")
def mobilisation_in_millimetres(draft: Draft) -> None:
    """Mobilisation lengths of FRICTION= in mm (in inches, in an imperial deck)."""
    row = draft.setting("*SEABED PROPERTIES", "FRICTION")
    for column in (2, 3):
        draft.scale(row, column, per_length(draft))


@kind("UNT006", "GEO005", "SBD022")
def coordinates_in_millimetres(draft: Draft) -> None:
    """All coordinates in mm, the pipe in m. Seen at a node, or at an element that is too long."""
    only(draft, "metric")
    for row in draft.numbers("*NODE"):
        for column in range(1, len(draft.fields(row))):
            draft.scale(row, column, 1000.0) if draft.value(row, column) else None
        draft.mark(row)
    draft.mark(*draft.numbers("*ELEMENT"), draft.block("*NODE")[0])


@kind("UNT006")
def coordinate_with_a_digit_more(draft: Draft) -> None:
    """One node ten times as far along as it should be. Seen at the node, or at an element beside it."""
    row, following = _along(draft)
    draft.scale(row, 2, 10.0)
    label = draft.field(row, 0)
    draft.mark(following, *(each for each in draft.numbers("*ELEMENT") if label in draft.fields(each)[1:]))


@kind("UNT006")
def coordinate_without_point(draft: Draft) -> None:
    """One node typed without its decimal point. Seen at the node, or at an element beside it."""
    row, following = _along(draft)
    text = draft.field(row, 2)
    draft.needs(text.endswith(".0") or len(text.partition(".")[2]) > 1)
    draft.put(row, 2, text.replace(".", ""))
    label = draft.field(row, 0)
    draft.mark(following, *(each for each in draft.numbers("*ELEMENT") if label in draft.fields(each)[1:]))


def _along(draft: Draft) -> tuple[Row, Row]:
    """A node in the part of a line that lies along Y, of a deck that lists all nodes, and the one behind it."""
    rows = draft.numbers("*NODE")
    draft.needs(len(rows) > 12 and draft.value(rows[5], 2) > 0)
    return rows[5], rows[6]


# ---------------------------------------------------------------------------------------------------------------- axes


@kind("SBD022")
def datum_at_the_surface(draft: Draft) -> None:
    """X counted from the water surface: the seabed lies at minus the depth. Seen at a node."""
    depth = draft.value(ocean_row(draft), 0)
    draft.needs("*P-Y" not in draft.text and "SEABED P" in draft.text)
    for row in draft.numbers("*NODE"):
        draft.put(row, 1, plain(draft.value(row, 1) - depth))


@kind("GEO005", "SBD022")
def z_is_up(draft: Draft) -> None:
    """The vertical coordinate written last, as in other programs. Seen at a node or at the block."""
    draft.needs("*P-Y" not in draft.text and "SEABED P" in draft.text and "*SEABED PROFILE" not in draft.text)
    heights = [draft.value(row, 1) for row in draft.numbers("*NODE")]
    draft.needs(max(heights) > 10.0)
    for row in draft.numbers("*NODE"):
        fields = draft.fields(row)
        across = fields[3] if len(fields) > 3 else "0.0"
        draft.write(row, f"{fields[0]}, {fields[2]}, {across}, {fields[1]}")
    draft.mark(draft.block("*NODE")[0])


@kind("GEO005")
def laid_above_the_seabed(draft: Draft) -> None:
    """50 m added to every X, by a datum of the site below the mudline. Seen at a node or at the block."""
    draft.needs("SEABED P" in draft.text and "*SEABED PROFILE" not in draft.text)
    for row in draft.numbers("*NODE"):
        draft.put(row, 1, plain(draft.value(row, 1) + (50.0 / FOOT if draft.units == "imperial" else 50.0)))
    draft.mark(draft.block("*NODE")[0])


@kind("SBD022", "GEO005")
def depth_positive_downwards(draft: Draft) -> None:
    """X of a riser with the wrong sign: it hangs below the seabed. Seen at a node or the block."""
    draft.needs("SEABED P" in draft.text)
    draft.needs(max(draft.value(row, 1) for row in draft.numbers("*NODE")) > 10.0)
    for row in draft.numbers("*NODE"):
        draft.scale(row, 1, -1.0)
    draft.mark(draft.block("*NODE")[0])
