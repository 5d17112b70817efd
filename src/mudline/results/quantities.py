"""How values are written for people and for files: names of units, headings, numbers, lines of CSV."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterable, Iterator
from typing import NamedTuple


class UnitNames(NamedTuple):
    """Names of units; empty where the deck's units are the user's own."""

    length: str
    force: str
    line_force: str
    """Force per length of pipe."""
    stiffness: str
    """Force per length of pipe and length of penetration."""


_METRIC = UnitNames("m", "N", "N/m", "N/m2")
_IMPERIAL = UnitNames("ft", "lbf", "lbf/ft", "lbf/ft2")
_NONE = UnitNames("", "", "", "")


def unit_names(units: str) -> UnitNames:
    """The names of "metric", "imperial" or "user" units."""
    return {"metric": _METRIC, "imperial": _IMPERIAL}.get(units, _NONE)


def headed(name: str, unit: str) -> str:
    """A heading: the name, and below it the unit in brackets if it has one."""
    return f"{name}\n[{unit}]" if unit else name


def shown(value: float | None, digits: int = 6) -> str:
    """A number in the shortest common form; "" for None and NaN."""
    if value is None or math.isnan(value):
        return ""
    return f"{value:.{digits}g}"


def finite(value: float | None) -> float | None:
    """A number that JSON can hold; None for what overflowed or is none."""
    return value if value is not None and math.isfinite(value) else None


def csv_lines(rows: Iterable[Iterable[object]]) -> Iterator[str]:
    """The lines with their ends (LF); None is an empty field, numbers read back to the same double."""
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    for row in rows:
        writer.writerow([csv_value(value) for value in row])
        yield buffer.getvalue()
        buffer.seek(0)
        buffer.truncate()


def csv_value(value: object) -> str:
    """The text of a field."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return "true" if value else "false"
    return repr(value) if isinstance(value, float) else str(value)
