"""Faults of units and magnitudes: a value that is right in another unit, or in another column."""

from __future__ import annotations

from tests.faults.draft import Draft, Row, plain, typed
from tests.faults.kind import Group, put, scale

UNITS = Group("units and magnitudes")
kind = UNITS.kind

FOOT = 0.3048
PSI = 144.0
"""lbf/ft2 in a pound per square inch."""


def per_length(draft: Draft) -> float:
    """Millimetres in a metre; inches in a foot."""
    return 1000.0 if draft.units == "metric" else 12.0


def ocean_row(draft: Draft) -> Row:
    return draft.numbers("*OCEAN")[0]


def only(draft: Draft, *units: str) -> None:
    draft.needs(draft.units in units)


def pipe_row(draft: Draft) -> Row:
    """The section of a steel pipe, the first of the deck."""
    row = draft.sections("RIGID")[0]
    only(draft, "metric", "imperial")
    draft.needs(draft.value(row, 0) > (1.5e11 if draft.units == "metric" else 3e9))
    return row


# --------------------------------------------------------------------------------------------------------------- water


UNITS.row(
    "water-in-tonnes", "UNT004", "Sea water of 1.025, in t/m3 or g/cm3.", put(ocean_row, 1, "1.025"), "metric imperial"
)
UNITS.row(
    "water-in-pounds", "UNT004", "Sea water of 64 lb/ft3 where slug/ft3 belongs.", put(ocean_row, 1, "64.0"), "imperial"
)


@kind("UNT004")
def water_in_kilograms(draft: Draft) -> None:
    """Sea water of 1025 kg/m3 in an imperial deck."""
    only(draft, "imperial")
    draft.put(ocean_row(draft), 1, "1025.0")


UNITS.row(
    "water-in-slugs", "UNT004", "Sea water of 1.99 slug/ft3 in a metric deck.", put(ocean_row, 1, "1.99"), "metric"
)


@kind("UNT004")
def water_as_weight(draft: Draft) -> None:
    """The specific weight of sea water (10 055 N/m3) where its density belongs."""
    only(draft, "metric")
    draft.put(ocean_row(draft), 1, "10055.0")


UNITS.row("water-lost-a-digit", "UNT004", "102.5 for 1025.", put(ocean_row, 1, "102.5"), "metric")


@kind("UNT004")
def depth_and_density_exchanged(draft: Draft) -> None:
    """Density first, then the depth."""
    row = ocean_row(draft)
    depth, density = draft.value(row, 0), draft.value(row, 1)
    draft.needs(not 0.8 < depth / density < 1.25 and draft.units != "user")
    draft.needs(draft.units == "imperial" or not 900 < depth < 1250)
    draft.exchange(row, 0, 1)


@kind("UNT001")
def gravity_of_the_other_system(draft: Draft) -> None:
    """32.2 in a metric deck, 9.81 in an imperial one."""
    only(draft, "metric", "imperial")
    draft.put(ocean_row(draft), 2, "32.2" if draft.units == "metric" else "9.81")


UNITS.row(
    "gravity-without-point", "UNT001", "981 for 9.81, or 3217 for 32.17.", scale(ocean_row, 2, 100.0), "metric imperial"
)


@kind("UNT001", "SBD010")
def gravity_is_negative(draft: Draft) -> None:
    """-9.81, as gravity acts downwards."""
    only(draft, "metric", "imperial")
    draft.scale(ocean_row(draft), 2, -1.0)


@kind("UNT006")
def ocean_depth_lost_a_digit(draft: Draft) -> None:
    """A depth of 100 m where the line reaches up to 1000 m. Seen at the depth, or at the highest node."""
    heights = [draft.value(row, 1) for row in draft.numbers("*NODE")]
    row = ocean_row(draft)
    draft.needs(max(heights) > 0.5 * draft.value(row, 0))
    draft.scale(row, 0, 0.1)
    draft.mark(*(each for each in draft.numbers("*NODE") if draft.value(each, 1) == max(heights)))


@kind("UNT006")
def ocean_depth_in_other_unit(draft: Draft) -> None:
    """The depth in fathoms or km, the nodes in m or ft. Seen at the depth, or at the highest node."""
    heights = [draft.value(row, 1) for row in draft.numbers("*NODE")]
    row = ocean_row(draft)
    draft.needs(max(heights) > 0.5 * draft.value(row, 0))
    draft.scale(row, 0, 1 / 6 if draft.units == "imperial" else 0.001)
    draft.mark(*(each for each in draft.numbers("*NODE") if draft.value(each, 1) == max(heights)))


# --------------------------------------------------------------------------------------------------------------- steel


UNITS.row("steel-in-tonnes", "UNT004", "Steel of 7.85, in t/m3 or g/cm3.", put(pipe_row, 4, "7.85"))
UNITS.row(
    "steel-in-pounds", "UNT004", "Steel of 490 lb/ft3 where slug/ft3 belongs.", put(pipe_row, 4, "490.0"), "imperial"
)
UNITS.row(
    "steel-in-kilograms", "UNT004", "Steel of 7850 kg/m3 in an imperial deck.", put(pipe_row, 4, "7850.0"), "imperial"
)
UNITS.row("steel-in-slugs", "UNT004", "Steel of 15.2 slug/ft3 in a metric deck.", put(pipe_row, 4, "15.2"), "metric")


@kind("UNT004")
def steel_as_weight(draft: Draft) -> None:
    """The specific weight of steel (77 000 N/m3, 490 lbf/ft3 being caught as a density) where its density belongs."""
    only(draft, "metric")
    draft.put(pipe_row(draft), 4, "77000.0")


UNITS.row("steel-gained-a-digit", "UNT004", "78500 for 7850.", scale(pipe_row, 4, 10.0))


@kind("UNT004")
def steel_lost_a_digit(draft: Draft) -> None:
    """785 for 7850: lighter than water, with the modulus of steel."""
    draft.scale(pipe_row(draft), 4, 0.1)


# -------------------------------------------------------------------------------------------------------------- moduli


UNITS.row("young-in-gigapascals", "UNT005", "E of 207.", put(pipe_row, 0, "207.0"), "metric")
UNITS.row("young-in-megapascals", "UNT005", "E of 207 000.", put(pipe_row, 0, "207000.0"), "metric")
UNITS.row("young-in-kilopascals", "UNT005", "E of 207E6, in kN/m2.", put(pipe_row, 0, "207.0E6"), "metric")
UNITS.row("young-in-psi", "UNT005", "E of 30E6 psi, in a metric or an imperial deck.", put(pipe_row, 0, "30.0E6"))
UNITS.row("young-in-ksi", "UNT005", "E of 30 000 ksi.", put(pipe_row, 0, "30000.0"))
UNITS.row("young-in-pascals", "UNT005", "E of 207E9 N/m2 in an imperial deck.", put(pipe_row, 0, "207.0E9"), "imperial")


@kind("UNT005")
def both_moduli_in_other_unit(draft: Draft) -> None:
    """E and G in GPa, or in psi."""
    row = pipe_row(draft)
    factor = 1e-9 if draft.units == "metric" else 1 / PSI
    draft.scale(row, 0, factor)
    draft.scale(row, 1, factor)


UNITS.row("young-lost-a-digit", "UNT005", "20.7E9 for 207E9.", scale(pipe_row, 0, 0.1))


@kind("UNT005")
def shear_in_other_unit(draft: Draft) -> None:
    """G in MPa or psi, E as it should be."""
    draft.scale(pipe_row(draft), 1, 1e-6 if draft.units == "metric" else 1 / PSI)


@kind("UNT005")
def young_and_shear_exchanged(draft: Draft) -> None:
    """G first, then E."""
    draft.exchange(pipe_row(draft), 0, 1)


@kind("UNT005")
def shear_is_young(draft: Draft) -> None:
    """E typed twice."""
    row = pipe_row(draft)
    draft.put(row, 1, draft.field(row, 0))


UNITS.row("poisson-for-shear", "UNT005", "Poisson's ratio where G belongs.", put(pipe_row, 1, "0.3"))


# -------------------------------------------------------------------------------------------------------------- seabed


@kind("UNT002")
def stiffness_in_kilonewtons(draft: Draft) -> None:
    """STIFFNESS= in kN/m/m, or in kip/ft/ft."""
    only(draft, "metric", "imperial")
    draft.swap(*_stiffness(draft))


def _stiffness(draft: Draft) -> tuple[Row, str, str]:
    row = draft.setting("*SEABED PROPERTIES", "STIFFNESS")
    text = row.text.partition("=")[2].strip()
    draft.needs(text[:1].isdigit())
    return row, text, plain(typed(text) / 1000.0)


@kind("UNT002")
def legacy_stiffness_in_kilonewtons(draft: Draft) -> None:
    """The stiffness of `*ELASTIC SURFACE` in kN/m/m, or in kip/ft/ft."""
    only(draft, "metric", "imperial")
    draft.scale(draft.numbers("*ELASTIC SURFACE")[0], 0, 0.001)


@kind("UNT002")
def curve_in_kilonewtons(draft: Draft) -> None:
    """Forces of a curve in kN/m, or in kip/ft. Seen at the curve's first line or at a point."""
    only(draft, "metric", "imperial")
    points = draft.curve()
    draft.mark(draft.keyed_above(points[0]))
    for row in points[1:]:
        draft.scale(row, 1, 0.001)


@kind("UNT006", "CRV010")
def curve_in_millimetres(draft: Draft) -> None:
    """A curve over the penetration in mm (in inches, in an imperial deck). Seen at the curve or a point."""
    points = draft.curve()
    draft.mark(draft.keyed_above(points[0]))
    diameter = draft.value(draft.sections("RIGID")[0], 2)
    draft.needs(diameter < 3.0)
    for row in points[1:]:
        draft.scale(row, 0, diameter * per_length(draft))


@kind("UNT006", "CRV010")
def curve_in_metres(draft: Draft) -> None:
    """A curve over the penetration in m or ft, instead of diameters: all of it within a tenth of the diameter of a
    small pipe. Seen at the curve or a point."""
    points = draft.curve()
    draft.mark(draft.keyed_above(points[0]))
    row = draft.sections("RIGID", "FLEXIBLE")[0]
    diameter = draft.value(row, 2 if len(draft.fields(row)) != 10 else 9)
    draft.needs(diameter < 0.5)
    for row in points[1:]:
        draft.scale(row, 0, diameter)


@kind("CRV010")
def curve_in_per_cent(draft: Draft) -> None:
    """The embedment ratio of a curve in per cent. Seen at the curve or a point."""
    points = draft.curve()
    draft.mark(draft.keyed_above(points[0]))
    for row in points[1:]:
        draft.scale(row, 0, 100.0)


@kind("UNT003")
def friction_in_per_cent(draft: Draft) -> None:
    """A friction coefficient of 35 for 0.35."""
    row = draft.setting("*SEABED PROPERTIES", "FRICTION")
    first = row.text.partition("=")[2].partition(",")[0]
    draft.swap(row, f"={first},", f"={plain(100.0 * typed(first))},")


@kind("UNT003")
def friction_angle(draft: Draft) -> None:
    """The friction angle of a legacy surface, in degrees, where its coefficient belongs."""
    surface = next((each for each in ("*ELASTIC SURFACE", "*RIGID SURFACE") if each in draft.text), "")
    draft.put(draft.numbers(surface)[0], 1, "31.0")


@kind("SBD012")
def slope_without_point(draft: Draft) -> None:
    """SLOPE=65 for 6.5."""
    draft.write(draft.setting("*SEABED PROFILE", "SLOPE"), "SLOPE=65.0")


@kind("UNT002")
def lateral_in_kilonewtons(draft: Draft) -> None:
    """LATERAL= in kN/m/m, or in kip/ft/ft."""
    only(draft, "metric", "imperial")
    row = draft.setting("*SEABED PROPERTIES", "LATERAL")
    text = row.text.partition("=")[2]
    draft.swap(row, text, plain(typed(text) / 1000.0))


@kind("UNT002")
def suction_in_kilonewtons(draft: Draft) -> None:
    """The suction stiffness in kN/m/m, or in kip/ft/ft."""
    only(draft, "metric", "imperial")
    row = draft.setting("*SEABED PROPERTIES", "SUCTION")
    text = row.text.partition("=")[2].partition(",")[0]
    draft.swap(row, text, plain(typed(text) / 1000.0))


# ---------------------------------------------------------------------------------------------------------- user units


def _any_value(draft: Draft) -> None:
    """In user units either side of a contradiction may be the wrong one: any of the values may be named."""
    draft.needs(draft.units == "user")
    draft.mark(ocean_row(draft), *draft.sections())


@kind("UNT004", "UNT005", "UNT006")
def user_water_in_other_mass(draft: Draft) -> None:
    """User units: water in t/m3 in a deck of newtons, in kg/m3 in a deck of kilonewtons; too heavy for a light line."""
    _any_value(draft)
    row = ocean_row(draft)
    draft.scale(row, 1, 0.001 if draft.value(row, 1) > 100.0 else 1000.0)


@kind("UNT004", "UNT005")
def user_steel_in_other_mass(draft: Draft) -> None:
    """User units: steel in t/m3 in a deck of newtons, in kg/m3 in a deck of kilonewtons."""
    _any_value(draft)
    row = draft.sections("RIGID")[0]
    draft.scale(row, 4, 0.001 if draft.value(row, 4) > 100.0 else 1000.0)


@kind("UNT004", "UNT005")
def user_young_in_other_force(draft: Draft) -> None:
    """User units: moduli in kN/m2 in a deck of newtons, in N/m2 in a deck of kilonewtons."""
    _any_value(draft)
    row = draft.sections("RIGID")[0]
    for column in (0, 1):
        draft.scale(row, column, 0.001 if draft.value(row, column) > 1e10 else 1000.0)
