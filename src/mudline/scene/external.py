"""Elements from a file, for decks whose elements come from `*LINES`, which has no model here."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from mudline.scene.csv_file import data_error, read_csv
from mudline.scene.numbering import Floats, Ids


@dataclass(frozen=True, slots=True)
class ExternalElements:
    """Elements (m): numbers, node numbers (m, 2), external diameters, lengths (NaN where not given), sets by name."""

    file: str
    ids: Ids
    nodes: NDArray[np.int64]
    diameter: Floats
    length: Floats
    sets: dict[str, Ids]


def read_external(path: Path) -> ExternalElements:
    """`element,node1,node2,diameter[,length][,sets]`, sets parted by semicolons.

    Raises OSError, or DeckError for a file with faults.
    """
    needed = ("element", "node1", "node2", "diameter")
    table = read_csv(path, needed, (*needed, "length", "sets"))
    ids, first, second = (table.numbers(name, whole=True).astype(np.int64) for name in needed[:3])
    _unique(table.file, ids, table.lines)
    diameter = table.numbers("diameter", optional=True)
    length = table.numbers("length", optional=True) if "length" in table.columns else np.full(len(ids), np.nan)
    for name, values in (("diameter", diameter), ("length", length)):
        for row in np.flatnonzero(values <= 0)[:1].tolist():
            raise data_error(table.file, f"{name} is {values[row]!r}: it must be greater than 0", table.lines[row])
    members: dict[str, list[int]] = {}
    for number, text in zip(ids.tolist(), table.columns.get("sets", []), strict=False):
        for name in text.split(";"):
            if name.strip():
                members.setdefault(name.strip(), []).append(number)
    sets = {name: np.array(numbers, dtype=np.int64) for name, numbers in members.items()}
    return ExternalElements(table.file, ids, np.column_stack([first, second]), diameter, length, sets)


def _unique(file: str, ids: Ids, lines: list[int]) -> None:
    seen: set[int] = set()
    for number, line in zip(ids.tolist(), lines, strict=True):
        if number in seen:
            raise data_error(file, f"element {number} is given twice", line)
        seen.add(number)
