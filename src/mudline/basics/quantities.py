"""Quantities of results: names, units and meaning, and the formatting of their values."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

from mudline.basics.display import Cell, DisplayColumn, Value
from mudline.basics.units import UNITS

RESULT_FORMAT = "mudline-result/2"
"""Name and version of the format of result files."""

Names = tuple[str | None, ...]

STATES: Names = ("free", "compression", "suction", "hold", "broken", None)
"""States of an element with suction, by index; the last stands for -1."""
SLIDING: Names = ("open", "stick", "slip", None)
"""States of a direction of a node with friction, by index; the last stands for -1."""


class Quantity(NamedTuple):
    """A column of results, or a figure of a step.

    Attributes:
        name: name of the column, the array and the key.
        meaning: text for the documentation, in Markdown.
        unit: dimension of the unit, as in `mudline.basics.units`; "" for none.
        heading: heading in a table for people; the name where it is "".
        label: label of a plot axis; the name where it is "".
        names: texts of a column whose values are indices; the last, None, stands for -1.
        vector: True if a value has three components.
        over_steps: True if a step may change the value, even if nothing changes it in a given scene.
    """

    name: str
    meaning: str
    unit: str = ""
    heading: str = ""
    label: str = ""
    names: Names = ()
    vector: bool = False
    over_steps: bool = True

    def unit_name(self, units: str) -> str:
        """Return the name of the unit in a system of units; "" for none."""
        return UNITS[units].unit(self.unit)

    def column(
        self,
        units: str,
        value: Value | None = None,
        *,
        left: bool = False,
        optional: bool = False,
        missing: Cell = None,
    ) -> DisplayColumn:
        """Return the column of a table for people, with the cells of `value`; without it those of its name."""
        source = self.name if value is None else value
        unit = self.unit_name(units)
        return DisplayColumn(self.heading or self.name, source, unit, left=left, optional=optional, missing=missing)

    def axis(self, units: str) -> str:
        """Return the label of an axis with the unit in brackets."""
        return labelled(self.label or self.name, self.unit_name(units))


def _by_name(*quantities: Quantity) -> dict[str, Quantity]:
    return {quantity.name: quantity for quantity in quantities}


ELEMENTS = _by_name(
    Quantity("element", "its number", over_steps=False),
    Quantity("set", "the set that gave it its law, or `null`", over_steps=False),
    Quantity("arc_length", "of its middle, from the first end of its line", "L", over_steps=False),
    Quantity("x", "coordinates of its middle; X is up", "L", label="height X"),
    Quantity("y", "coordinates of its middle; X is up", "L"),
    Quantity("z", "coordinates of its middle; X is up", "L"),
    Quantity("diameter", "external diameter, or `null`", "L", over_steps=False),
    Quantity("length", "length", "L", over_steps=False),
    Quantity(
        "depth",
        "mean distance of its two nodes below the seabed; `null` where there is no seabed",
        "L",
        label="embedment",
    ),
    Quantity("ratio", "depth / diameter, or `null`", label="embedment ratio, depth / diameter"),
    Quantity("contact", "depth > 0"),
    Quantity(
        "force",
        "seabed reaction per unit length, positive upwards",
        "F/L",
        label="seabed reaction\nper unit length",
    ),
    Quantity("slope", "d force / d ratio, or `null`", "F/L"),
    Quantity("stiffness", "d force / d depth, per unit length", "F/L2", label="seabed stiffness\nper unit length"),
    Quantity("law", "`curve:NAME`, `curve-cut`, or the name of [another law](numerics.md#which-law-an-element-has)"),
    Quantity(
        "state",
        "of suction: `free`, `compression`, `suction`, `hold` or `broken`; `null` without a suction law",
        names=STATES,
    ),
    Quantity(
        "line",
        "number of its line, from 1: elements one behind the other, up to an end or a junction",
        over_steps=False,
    ),
    Quantity("node1", "nodes at its ends", over_steps=False),
    Quantity("node2", "nodes at its ends", over_steps=False),
)
"""Columns of elements, in order."""

NODES = _by_name(
    Quantity("node", "its number", over_steps=False),
    Quantity("arc_length", "from the first end of its line; `null` without elements", "L", over_steps=False),
    Quantity("x", "coordinates; X is up", "L", label="height X"),
    Quantity("y", "coordinates; X is up", "L"),
    Quantity("z", "coordinates; X is up", "L"),
    Quantity("gap", "height above the seabed, along its normal; `null` where there is no seabed", "L"),
    Quantity("normal", "normal of the seabed: x, y, z; `[null, null, null]` where there is no seabed", vector=True),
    Quantity("reaction", "total force of the seabed on the node: x, y, z", "F", vector=True),
    Quantity("normal_force", "the part along the normal, negative where it pulls", "F"),
    Quantity(
        "axial_force",
        "seabed reaction on the pipe along the line: friction; 0.0 without it",
        "F",
        "axial\nforce",
    ),
    Quantity(
        "lateral_force",
        "seabed reaction on the pipe across the line: friction and lateral springs; 0.0 without them",
        "F",
        "lateral\nforce",
    ),
    Quantity("axial_state", "`open`, `stick` or `slip`; `null` without a friction law", "", "axial", names=SLIDING),
    Quantity("lateral_state", "`open`, `stick` or `slip`; `null` without a friction law", "", "lateral", names=SLIDING),
    Quantity(
        "line",
        "the number of its line; of the first one at a junction; 0 without elements",
        over_steps=False,
    ),
)
"""Columns of nodes, in order."""

LINES = _by_name(
    Quantity("line", "its number, from 1", over_steps=False),
    Quantity("first_element", "elements at its ends", over_steps=False),
    Quantity("last_element", "elements at its ends", over_steps=False),
    Quantity("length", "all of it", "L", over_steps=False),
    Quantity("touchdown_points", "how often it comes down on the seabed or leaves it"),
    Quantity("first_touchdown", "arc length of the first of these points", "L", "touchdown\nat", "touchdown point"),
    Quantity("first_touchdown_x", "its coordinates; X is up", "L"),
    Quantity("first_touchdown_y", "its coordinates; X is up", "L"),
    Quantity("first_touchdown_z", "its coordinates; X is up", "L"),
    Quantity("last_touchdown", "arc length of the last of these points", "L", label="last touchdown point"),
    Quantity("last_touchdown_x", "its coordinates; X is up", "L"),
    Quantity("last_touchdown_y", "its coordinates; X is up", "L"),
    Quantity("last_touchdown_z", "its coordinates; X is up", "L"),
    Quantity("contact_length", "length below the seabed", "L", "length in\ncontact", "length in contact"),
    Quantity(
        "largest_force",
        "largest push of the seabed on an element, per unit length",
        "F/L",
        "largest\nforce",
        "largest force",
    ),
    Quantity("largest_force_element", "the element", "", "element"),
    Quantity("largest_force_arc_length", "arc length of its middle", "L"),
    Quantity(
        "largest_uplift",
        "largest pull, negative, by suction or a curve",
        "F/L",
        "largest\nuplift",
        "uplift, negative",
    ),
    Quantity("largest_uplift_element", "the element", "", "element"),
    Quantity("largest_uplift_arc_length", "arc length of its middle", "L"),
    Quantity(
        "reaction",
        "total normal force on its nodes; `null` on a rigid seabed",
        "F",
        "total\nreaction",
        "total reaction",
    ),
    Quantity(
        "submerged_weight",
        "of its elements in contact, with contents and masses at nodes",
        "F",
        "submerged\nweight",
    ),
    Quantity("empty_weight", "the same without contents", "F", "weight,\nempty"),
    Quantity("ratio", "reaction / submerged weight"),
)
"""Columns of lines, in order; a value that does not exist is `null`."""

STEPS = _by_name(
    Quantity(
        "reaction",
        "total normal force on all nodes; `null` on a rigid seabed",
        "F",
        "total\nreaction",
        "total reaction",
    ),
    Quantity(
        "force",
        "largest magnitude of an element's force per unit length, with its sign",
        "F/L",
        label="largest force\nper length",
    ),
    Quantity(
        "pull",
        "largest force per unit length that holds an element down, 0 where none does",
        "F/L",
        label="largest suction\nper length",
    ),
    Quantity("touching", "number of elements in contact", "", "in\ncontact", "elements\nin contact"),
    Quantity("deepest", "largest depth of an element", "L", "largest\ndepth", "deepest\nembedment"),
)
"""Figures of a step, as plotted over time."""


def labelled(text: str, unit: str) -> str:
    """Return a label, followed by its unit in brackets if it has one."""
    return f"{text} [{unit}]" if unit else text


def shown(value: float | None, digits: int = 6) -> str:
    """Return a number in its shortest common form; "" for None and NaN."""
    if value is None or math.isnan(value):
        return ""
    return f"{value:.{digits}g}"


def finite(value: float | None) -> float | None:
    """Return a number that JSON can hold; None for infinity, NaN and None."""
    return value if value is not None and math.isfinite(value) else None


def as_json(value: Any) -> Any:  # noqa: ANN401 - values of several kinds
    """Return a value that JSON can hold: named tuples as objects, tuples as lists, numbers that overflowed as None."""
    if isinstance(value, dict):
        return {name: as_json(each) for name, each in value.items()}
    if hasattr(value, "_asdict"):
        return as_json(value._asdict())
    if isinstance(value, list | tuple):
        return [as_json(each) for each in value]
    return finite(value) if isinstance(value, float) else value


def csv_lines(rows: Iterable[Iterable[object]]) -> Iterator[str]:
    """Yield the lines of a CSV, each ended by LF; None is an empty field, numbers read back to the same double."""
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    for row in rows:
        writer.writerow([str(value).lower() if isinstance(value, bool) else value for value in row])
        yield buffer.getvalue()
        buffer.seek(0)
        buffer.truncate()
