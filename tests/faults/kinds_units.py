"""Faults of units and magnitudes: a value that is right in another unit, or in another column."""

from __future__ import annotations

from tests.faults.changes import FACTORS, elements_of, pipe
from tests.faults.draft import Draft, Row, plain

FOOT = 0.3048


def depth_and_density_exchanged(draft: Draft) -> None:
    row = draft.numbers("*OCEAN")[0]
    depth, density = draft.value(row, 0), draft.value(row, 1)
    draft.needs(not 0.8 < depth / density < 1.25 and draft.units != "user")
    draft.needs(draft.units == "imperial" or not 900 < depth < 1250)
    draft.exchange(row, 0, 1)


def gravity_of_the_other_system(draft: Draft) -> None:
    draft.needs(draft.units in ("metric", "imperial"))
    draft.put(draft.numbers("*OCEAN")[0], 2, "32.2" if draft.units == "metric" else "9.81")


def ocean_depth_lost_a_digit(draft: Draft) -> None:
    heights = [draft.value(row, 1) for row in draft.numbers("*NODE")]
    row = draft.numbers("*OCEAN")[0]
    draft.needs(max(heights) > 0.5 * draft.value(row, 0))
    draft.scale(row, 0, 0.1)
    draft.mark(*(each for each in draft.numbers("*NODE") if draft.value(each, 1) == max(heights)))


def ocean_depth_in_other_unit(draft: Draft) -> None:
    heights = [draft.value(row, 1) for row in draft.numbers("*NODE")]
    row = draft.numbers("*OCEAN")[0]
    draft.needs(max(heights) > 0.5 * draft.value(row, 0))
    draft.scale(row, 0, 1 / 6 if draft.units == "imperial" else 0.001)
    draft.mark(*(each for each in draft.numbers("*NODE") if draft.value(each, 1) == max(heights)))


def curve_in_millimetres(draft: Draft) -> None:
    points = draft.curve()
    draft.mark(draft.keyed_above(points[0]))
    diameter = draft.value(draft.sections("RIGID")[0], 2)
    draft.needs(diameter < 3.0)
    for row in points[1:]:
        draft.scale(row, 0, diameter * FACTORS["millimetres"][draft.units != "metric"])


def curve_in_metres(draft: Draft) -> None:
    points = draft.curve()
    draft.mark(draft.keyed_above(points[0]))
    row = draft.sections("RIGID", "FLEXIBLE")[0]
    diameter = draft.value(row, 2 if len(draft.fields(row)) != 10 else 9)
    draft.needs(diameter < 0.5)
    for row in points[1:]:
        draft.scale(row, 0, diameter)


def _any_value(draft: Draft) -> None:
    """In user units either side of a contradiction may be the wrong one: any of the values may be named."""
    draft.needs(draft.units == "user")
    draft.mark(draft.numbers("*OCEAN")[0], *draft.sections())


def user_water_in_other_mass(draft: Draft) -> None:
    _any_value(draft)
    row = draft.numbers("*OCEAN")[0]
    draft.scale(row, 1, 0.001 if draft.value(row, 1) > 100.0 else 1000.0)


def user_steel_in_other_mass(draft: Draft) -> None:
    _any_value(draft)
    row = draft.sections("RIGID")[0]
    draft.scale(row, 4, 0.001 if draft.value(row, 4) > 100.0 else 1000.0)


def user_young_in_other_force(draft: Draft) -> None:
    _any_value(draft)
    row = draft.sections("RIGID")[0]
    for column in (0, 1):
        draft.scale(row, column, 0.001 if draft.value(row, column) > 1e10 else 1000.0)


def diameters_in_inches(draft: Draft) -> None:
    row = pipe(draft)
    draft.needs(draft.units == "metric")
    draft.needs(draft.value(row, 2) < 2.0)
    for column in (2, 3):
        draft.scale(row, column, 1 / 0.0254)


def wall_for_inner_diameter(draft: Draft) -> None:
    row = pipe(draft)
    draft.put(row, 3, plain((draft.value(row, 2) - draft.value(row, 3)) / 2))


def flexible_mass_in_pounds(draft: Draft) -> None:
    draft.needs(
        draft.units == "imperial" or (draft.units == "user" and draft.value(draft.numbers("*OCEAN")[0], 1) < 2.0)
    )
    draft.scale(draft.sections("FLEXIBLE")[0], 4, 32.174 if draft.units == "imperial" else 1000.0)


def coordinates_in_millimetres(draft: Draft) -> None:
    draft.needs(draft.units == "metric")
    for row in draft.numbers("*NODE"):
        for column in range(1, len(draft.fields(row))):
            draft.scale(row, column, 1000.0) if draft.value(row, column) else None
        draft.mark(row)
    draft.mark(*draft.numbers("*ELEMENT"), draft.block("*NODE")[0])


def coordinate_with_a_digit_more(draft: Draft) -> None:
    row, following = _along(draft)
    draft.scale(row, 2, 10.0)
    label = draft.field(row, 0)
    draft.mark(following, *elements_of(draft, label))


def coordinate_without_point(draft: Draft) -> None:
    row, following = _along(draft)
    text = draft.field(row, 2)
    draft.needs(text.endswith(".0") or len(text.partition(".")[2]) > 1)
    draft.put(row, 2, text.replace(".", ""))
    label = draft.field(row, 0)
    draft.mark(following, *elements_of(draft, label))


def _along(draft: Draft) -> tuple[Row, Row]:
    """A node in the part of a line that lies along Y, of a deck that lists all nodes, and the one behind it."""
    rows = draft.numbers("*NODE")
    draft.needs(len(rows) > 12 and draft.value(rows[5], 2) > 0)
    return rows[5], rows[6]


def datum_at_the_surface(draft: Draft) -> None:
    depth = draft.value(draft.numbers("*OCEAN")[0], 0)
    draft.needs("*P-Y" not in draft.text and "SEABED P" in draft.text)
    for row in draft.numbers("*NODE"):
        draft.put(row, 1, plain(draft.value(row, 1) - depth))


def z_is_up(draft: Draft) -> None:
    draft.needs("*P-Y" not in draft.text and "SEABED P" in draft.text and "*SEABED PROFILE" not in draft.text)
    heights = [draft.value(row, 1) for row in draft.numbers("*NODE")]
    draft.needs(max(heights) > 10.0)
    for row in draft.numbers("*NODE"):
        fields = draft.fields(row)
        across = fields[3] if len(fields) > 3 else "0.0"
        draft.write(row, f"{fields[0]}, {fields[2]}, {across}, {fields[1]}")
    draft.mark(draft.block("*NODE")[0])


def laid_above_the_seabed(draft: Draft) -> None:
    draft.needs("SEABED P" in draft.text and "*SEABED PROFILE" not in draft.text)
    for row in draft.numbers("*NODE"):
        draft.put(row, 1, plain(draft.value(row, 1) + (50.0 / FOOT if draft.units == "imperial" else 50.0)))
    draft.mark(draft.block("*NODE")[0])


def depth_positive_downwards(draft: Draft) -> None:
    draft.needs("SEABED P" in draft.text)
    draft.needs(max(draft.value(row, 1) for row in draft.numbers("*NODE")) > 10.0)
    for row in draft.numbers("*NODE"):
        draft.scale(row, 1, -1.0)
    draft.mark(draft.block("*NODE")[0])
