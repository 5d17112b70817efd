"""Elements from a file, for decks whose elements come from `*LINES`, which has no model here."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from mudline.scene.csv_file import CsvTable, data_error, read_csv
from mudline.scene.numbering import Floats, Ids


@dataclass(frozen=True, slots=True)
class ExternalElements:
    """Elements (m): numbers, node numbers (m, 2), external diameters, lengths (NaN where not given), sets by name."""

    file: str
    ids: Ids
    nodes: Ids
    diameter: Floats
    length: Floats
    sets: dict[str, Ids]


def read_external(path: Path) -> ExternalElements:
    """`element,node1,node2,diameter[,length][,sets]`, sets separated by semicolons; a diameter or length may be empty.

    Raises OSError, or DeckError for a file with faults.
    """
    needed = ("element", "node1", "node2", "diameter")
    table = read_csv(path, needed, (*needed, "length", "sets"))
    if not table.lines:
        raise data_error(table.file, "no row below the header", 2)
    ids, first, second = map(table.whole, ("element", "node1", "node2"))
    _unique(ids, table)
    diameter = _positive("diameter", table)
    length = _positive("length", table) if "length" in table.columns else np.full(len(ids), np.nan)
    return ExternalElements(table.file, ids, np.column_stack([first, second]), diameter, length, _sets(ids, table))


def _sets(ids: Ids, table: CsvTable) -> dict[str, Ids]:
    members: dict[str, list[int]] = {}
    for number, text in zip(ids.tolist(), table.columns.get("sets", [""] * len(ids)), strict=True):
        for name in text.split(";"):
            if name.strip():
                members.setdefault(name.strip(), []).append(number)
    return {name: np.array(numbers, dtype=np.int64) for name, numbers in members.items()}


def _positive(name: str, table: CsvTable) -> Floats:
    values = table.numbers(name, optional=True)
    for row in np.flatnonzero(values <= 0)[:1].tolist():
        value = float(values[row])
        raise data_error(table.file, f"{name} is {value!r}: it must be greater than 0", table.lines[row])
    return values


def _unique(ids: Ids, table: CsvTable) -> None:
    seen: set[int] = set()
    for number, line in zip(ids.tolist(), table.lines, strict=True):
        if number in seen:
            raise data_error(table.file, f"element {number} is given twice", line)
        seen.add(number)
