"""Sheet of a deck: a row for each run of elements with the same section, water, seabed and contents."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mudline.basics.quantities import finite
from mudline.language.keywords.format import unit_text
from mudline.model.contact.input import LawKind
from mudline.model.scene.numbering import Floats, Indices, picked
from mudline.model.scene.resolved import ResolvedDeck
from mudline.model.scene.sections import stiffnesses
from mudline.model.scene.weights import NOT_READ, attached, contents, contents_case, left_out, pipe_of

Value = str | int | float | None


class SheetColumn(NamedTuple):
    """Column: its key, its heading for people, and the dimension of its values as that of a field, "" for none."""

    key: str
    heading: str
    dimension: str = ""

    def unit(self, units: str) -> str:
        """Return the unit in a deck's units; "" for user units, and if there is none."""
        return unit_text(self.dimension, units) if self.dimension and units != "user" else ""


class Sheet(NamedTuple):
    """Columns, a value for each in every row (None if the deck gives none), and parts left out of the weights."""

    columns: Sequence[SheetColumn]
    rows: Sequence[dict[str, Value]]
    left_out: Sequence[str]


PIPE = (
    SheetColumn("section", "section"),
    SheetColumn("length", "length", "L"),
    SheetColumn("outer_diameter", "outer\ndiameter", "L"),
    SheetColumn("inner_diameter", "inner\ndiameter", "L"),
    SheetColumn("diameter_over_wall", "D/t"),
    SheetColumn("drag_diameter", "drag\ndiameter", "L"),
    SheetColumn("buoyancy_diameter", "buoyancy\ndiameter", "L"),
)
"""Columns of the sheet about the pipe; diameters of drag and buoyancy only where they differ from the outer one."""
WEIGHTS = (
    SheetColumn("mass", "mass,\nempty", "M/L"),
    SheetColumn("contents", "contents", "M/L3"),
    SheetColumn("filled_mass", "mass,\nfilled", "M/L"),
    SheetColumn("masses_at_nodes", "masses\nat nodes", "M"),
    SheetColumn("empty_weight", "weight,\nempty", "F/L"),
    SheetColumn("filled_weight", "weight,\nfilled", "F/L"),
)
"""Columns about mass and submerged weight; contents are those of the last load case, and are only given with a bore."""
AROUND = (
    SheetColumn("bending", "EI", "FL2"),
    SheetColumn("axial", "EA", "F"),
    SheetColumn("drag", "Cd"),
    SheetColumn("added_mass", "Ca"),
    SheetColumn("law", "seabed law"),
    SheetColumn("stiffness", "stiffness", "F/L2"),
    SheetColumn("axial_friction", "friction\nalong"),
    SheetColumn("lateral_friction", "friction\nacross"),
)
"""Columns about stiffness, water and seabed; `stiffness` is that of a linear law."""
RUN = (
    SheetColumn("first_element", "first\nelement"),
    SheetColumn("last_element", "last\nelement"),
    SheetColumn("elements", "elements"),
)
"""Columns of each run: the elements at its ends, and their number."""


_OF_CASE = {"contents", "filled_mass", "filled_weight"}


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
    case = contents_case(scene)
    weights = [
        column._replace(heading=f"{column.heading},\nload case {case}") if case and column.key in _OF_CASE else column
        for column in WEIGHTS
    ]
    columns = [*RUN, *PIPE, *weights, *AROUND, *others]
    ordered = [{column.key: row[column.key] for column in columns} for row in rows]
    return Sheet(columns, ordered, left_out(scene))


def _numbers(scene: ResolvedDeck) -> tuple[dict[str, Floats], list[SheetColumn]]:
    """Return the values (m,) of all elements by column, and the columns of other load cases."""
    table, pipe, filled = scene.section_table, pipe_of(scene), contents(scene)
    outer, inner, drag_diameter, buoyancy = map(table.values, ("do", "di", "dd", "db"))
    inner[inner == 0.0] = np.nan
    own = [stiffnesses(scene.deck, section) for section in table.sections]
    friction = scene.resistance.column("friction")
    if (extension := scene.extensions.get("SEABED FRICTION")) is not None:
        given = [extension.values(extension.of_element, "coefficients", name) for name in ("first", "second")]
        friction = np.where((extension.of_element >= 0)[:, None], np.column_stack(given), friction)
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
        "bending": picked((each.bending for each in own), table.of_element),
        "axial": picked((each.axial for each in own), table.of_element),
        "drag": np.where(pipe.has_coefficients, pipe.drag_coefficient, np.nan),
        "added_mass": np.where(pipe.has_coefficients, pipe.added_mass_coefficient, np.nan),
        "stiffness": np.where(scene.law == LawKind.LINEAR, scene.law_arrays().linear_stiffness, np.nan),
        "axial_friction": friction[:, 0],
        "lateral_friction": friction[:, 1],
    }
    others = []
    for case_contents in filled[:-1]:
        if (case_contents.density != last).any():
            case = f"load case {case_contents.number}"
            dense = SheetColumn(f"contents_load_case_{case_contents.number}", f"contents,\n{case}", "M/L3")
            heavy = SheetColumn(f"weight_load_case_{case_contents.number}", f"weight,\n{case}", "F/L")
            others += [dense, heavy]
            values_by_column[dense.key] = case_contents.density
            values_by_column[heavy.key] = scene.submerged_weight + case_contents.mass * scene.surroundings.gravity
    return values_by_column, others


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
