"""Sheet of a deck: a row for each run of elements with the same section, water, seabed and contents."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mudline.basics.display import DisplayColumn, number, text
from mudline.basics.quantities import finite
from mudline.basics.units import UNITS
from mudline.model.contact.input import LawKind
from mudline.model.scene.numbering import Floats, Indices
from mudline.model.scene.resolved import ResolvedDeck
from mudline.model.scene.weights import NOT_READ, attached, contents, contents_case, left_out, pipe_of

Value = str | int | float | None


class Sheet(NamedTuple):
    """Columns by subject, a value for each in every row (None if the deck gives none), parts left out of the weights.

    The first subject, "", has the columns of the run.
    """

    subjects: Mapping[str, Sequence[DisplayColumn]]
    rows: Sequence[dict[str, Value]]
    left_out: Sequence[str]

    @property
    def columns(self) -> dict[str, DisplayColumn]:
        """All columns by key, in order."""
        return {str(column.value): column for columns in self.subjects.values() for column in columns}


def _columns(units: str, case: int | None) -> dict[str, list[DisplayColumn]]:
    """Return the columns by subject, without those of other load cases; `case` is the last one if these differ.

    Contents are those of the last load case, and are only given with a bore; `stiffness` is that of a linear law.
    Diameters of drag and buoyancy are given only where they differ from the outer one.
    """
    unit, last = UNITS[units].unit, f",\nload case {case}" if case else ""
    none, unknown = ("none", "bold yellow"), ("unknown", "bold yellow")  # gaps of the deck
    return {
        "": [
            number("first\nelement", "first_element"),
            number("last\nelement", "last_element"),
            number("elements", "elements"),
        ],
        "pipe": [
            text("section", "section", missing=none),
            number("length", "length", unit("L")),
            number("outer\ndiameter", "outer_diameter", unit("L")),
            number("inner\ndiameter", "inner_diameter", unit("L")),
            number("D/t", "diameter_over_wall"),
            number("drag\ndiameter", "drag_diameter", unit("L"), optional=True),
            number("buoyancy\ndiameter", "buoyancy_diameter", unit("L"), optional=True),
        ],
        "mass and submerged weight": [
            number("mass,\nempty", "mass", unit("M/L"), missing=unknown),
            number(f"contents{last}", "contents", unit("M/L3")),
            number(f"mass,\nfilled{last}", "filled_mass", unit("M/L"), missing=unknown),
            number("masses\nat nodes", "masses_at_nodes", unit("M"), optional=True),
            number("weight,\nempty", "empty_weight", unit("F/L"), missing=unknown),
            number(f"weight,\nfilled{last}", "filled_weight", unit("F/L"), missing=unknown),
        ],
        "stiffness, water and seabed": [
            number("EI", "bending", unit("FL2")),
            number("EA", "axial", unit("F")),
            number("Cd", "drag", missing=none),
            number("Ca", "added_mass", missing=none),
            text("seabed law", "law", missing=none),
            number("stiffness", "stiffness", unit("F/L2"), optional=True),
            number("friction\nalong", "axial_friction"),
            number("friction\nacross", "lateral_friction"),
        ],
    }


def sheet_of(scene: ResolvedDeck) -> Sheet:
    """Return the sheet of a deck, in its units, in the order of its elements.

    A run ends where a value changes, and where an element is not joined to the one before. Each load case whose
    contents differ from the last one adds two columns, and the headings then name the last case too.
    """
    table = scene.section_table
    with np.errstate(all="ignore"):  # values of a deck may overflow, which is no value
        numbers, others = _numbers(scene)
        masses = attached(scene).mass * scene.length
        kinds = (table.of_element, scene.law, scene.laws.of_element, scene.replacing)
        rows = []
        for first, end in _runs(scene, (*kinds, *numbers.values())):
            section = int(table.of_element[first])
            rows.append(
                {
                    "first_element": int(scene.element_ids[first]),
                    "last_element": int(scene.element_ids[end - 1]),
                    "elements": end - first,
                    "section": table.sections[section].name if section >= 0 else None,
                    "length": finite(float(scene.length[first:end].sum())),
                    "masses_at_nodes": finite(float(masses[first:end].sum())) or None,
                    "law": None if scene.law[first] == LawKind.NONE else scene.law_names[first],
                }
                | {key: finite(float(values[first])) for key, values in numbers.items()}
            )
    subjects = _columns(scene.units, contents_case(scene)) | {"other load cases": others}
    sheet = Sheet(subjects, rows, left_out(scene))
    return sheet._replace(rows=[{key: row[key] for key in sheet.columns} for row in rows])


def _numbers(scene: ResolvedDeck) -> tuple[dict[str, Floats], list[DisplayColumn]]:
    """Return the values (m,) of all elements by column, and the columns of other load cases."""
    table, pipe, filled = scene.section_table, pipe_of(scene), contents(scene)
    outer, inner, drag_diameter, buoyancy = map(table.values, ("do", "di", "dd", "db"))
    inner[inner == 0.0] = np.nan
    friction = friction_coefficients(scene)
    last = filled[-1].density if filled else np.zeros(len(scene.element_ids))
    not_read = (last == 0.0) if set(NOT_READ) & set(left_out(scene)) else np.zeros(len(last), np.bool_)
    values_by_column = {
        "outer_diameter": scene.diameter,
        "inner_diameter": inner,
        "diameter_over_wall": 2.0 * outer / (outer - inner),
        "drag_diameter": np.where(drag_diameter == scene.diameter, np.nan, drag_diameter),
        "buoyancy_diameter": np.where(buoyancy == scene.diameter, np.nan, buoyancy),
        "mass": scene.mass_per_length,
        "empty_weight": scene.submerged_weight,
        "contents": np.where(not_read | ~(inner > 0.0), np.nan, last),
        "filled_mass": np.where(not_read, np.nan, scene.mass_per_length + pipe.contents),
        "filled_weight": np.where(not_read, np.nan, pipe.weight),
        "bending": pipe.bending,
        "axial": pipe.axial,
        "drag": np.where(pipe.has_coefficients, pipe.drag_coefficient, np.nan),
        "added_mass": np.where(pipe.has_coefficients, pipe.added_mass_coefficient, np.nan),
        "stiffness": np.where(scene.law == LawKind.LINEAR, scene.law_arrays().linear_stiffness, np.nan),
        "axial_friction": friction[:, 0],
        "lateral_friction": friction[:, 1],
    }
    others, unit = [], UNITS[scene.units].unit
    for case_contents in filled[:-1]:
        if (case_contents.density != last).any():
            case = f"load case {case_contents.number}"
            density, weight = (f"{what}_load_case_{case_contents.number}" for what in ("contents", "weight"))
            others += [
                number(f"contents,\n{case}", density, unit("M/L3")),
                number(f"weight,\n{case}", weight, unit("F/L")),
            ]
            values_by_column[density] = case_contents.density
            values_by_column[weight] = scene.submerged_weight + case_contents.mass * scene.surroundings.gravity
    no_wall = inner >= outer  # refused: what follows from the wall is no value
    for key in ("diameter_over_wall", "bending", "axial", *(key for key in values_by_column if "weight" in key)):
        values_by_column[key] = np.where(no_wall, np.nan, values_by_column[key])
    return values_by_column, others


def friction_coefficients(scene: ResolvedDeck) -> Floats:
    """Return the coefficients along and across of elements (m, 2), those of `*SEABED FRICTION` first; NaN for none."""
    friction = scene.resistance.column("friction")
    if (extension := scene.extensions.get("SEABED FRICTION")) is not None:
        given = [extension.values(extension.of_element, "coefficients", name) for name in ("first", "second")]
        friction = np.where((extension.of_element >= 0)[:, None], np.column_stack(given), friction)
    return friction


def _runs(scene: ResolvedDeck, columns: Sequence[NDArray[np.generic]]) -> list[tuple[int, int]]:
    """Return first elements and ends of the runs of equal values (m,) that are consecutive along a line."""
    count = len(scene.element_ids)
    if not count:
        return []
    same = np.ones(count - 1, np.bool_)
    for values in columns:  # one after the other: all side by side fill the memory
        same &= (values[1:] == values[:-1]) | (np.isnan(values[1:]) & np.isnan(values[:-1]))
    ends: Indices = scene.element_nodes
    joined = (ends[1:, :, None] == ends[:-1, None, :]).any(axis=(1, 2)) & (np.diff(scene.element_ids) > 0)
    starts = np.flatnonzero(np.append(True, ~(same & joined)))
    return list(zip(starts.tolist(), [*starts.tolist()[1:], count], strict=True))
