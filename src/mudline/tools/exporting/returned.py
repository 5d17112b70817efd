"""Positions of a deck's nodes from results of other programs: MoorDyn's line files, OrcaFlex's tables of nodes.

Both have x and y horizontal, equal to Y and Z of the deck, and z from the sea surface. If the program has other nodes
than the deck, positions are interpolated linearly between nodes, by arc length.
"""

from __future__ import annotations

import re
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from mudline.model.contact.arrays import Positions
from mudline.model.scene.csv_file import data_error, read_numeric_csv
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Floats

if TYPE_CHECKING:
    from mudline.tools.exporting.line_model import ExportLine, LineModel, LineStretch

    PartRead = tuple[LineStretch | ExportLine, Floats, Floats]
    """A line or a part of it, with the arc lengths of the other program's nodes and their places."""

_LINE_FILE = re.compile(r"(.*_Line)(\d+)(\.\w+)", re.IGNORECASE)
_NODE = re.compile(r"node(\d+)p([xyz])")
_PLACE = {"x": "x (m)", "y": "y (m)", "z": "z (m)"}
_OTHERS = {"time": "time (s)", "node": "node", "arc": "arc length (m)"}
_HEAD = 1 << 16


def read_returned(path: Path, scene: Scene) -> Positions | None:
    """Return positions from a file of another program; None for a file with unknown headings.

    The other line files of MoorDyn next to it are read too. Raises OSError, or DeckError for a file with faults and for
    a deck that `export` refuses.
    """
    with path.open("rb") as stream:
        first, *_ = stream.read(_HEAD).decode("utf-8", "replace").lstrip("\ufeff").lower().split("\n")
    headings = {field.strip().strip('"') for field in re.split("[,;\t]", first)}
    of_moordyn = first.split()[:2] == ["time", "node0px"]
    if not of_moordyn and not (set(_PLACE.values()) <= headings and headings & {_OTHERS["node"], _OTHERS["arc"]}):
        return None
    from mudline.tools.exporting.line_model import build  # noqa: PLC0415 - files of our own form do without it

    if of_moordyn:
        return _moordyn(path, build(scene))
    return _orcaflex(path, build(scene), {name: text for name, text in _OTHERS.items() if text in headings})


def _moordyn(path: Path, model: LineModel) -> Positions:
    from mudline.tools.exporting import moordyn  # noqa: PLC0415 - as above

    named = _LINE_FILE.fullmatch(path.name)
    if named is None:
        raise data_error(path.as_posix(), "the name of a file of a line ends in _Line and its number, as run_Line1.out")
    parts = [*chain.from_iterable(moordyn.pieces(model))]
    if int(named[2]) > len(parts):
        raise data_error(path.as_posix(), f"line {named[2]}: the deck is exported as {len(parts)} lines")
    time: Floats | None = None
    parts_read: list[PartRead] = []
    for number, part in enumerate(parts, 1):
        file = path.with_name(f"{named[1]}{number}{named[3]}")
        if not file.exists():
            continue
        times, places = _line_file(file)
        if time is not None and not np.array_equal(time, times):
            raise data_error(file.as_posix(), f"other times than in the file of line {number - 1}")
        time = times
        parts_read.append((part, np.linspace(0.0, part.length, places.shape[1]), places))
    return _positions(model, parts_read, time)


def _line_file(path: Path) -> tuple[Floats, Floats]:
    """Return times (steps,) and places (steps, nodes, 3) of a line of MoorDyn; further columns are ignored."""
    lines = path.read_text(encoding="utf-8", errors="replace").split("\n")
    columns = [_NODE.fullmatch(word) for word in lines[0].lower().split()]
    at = [index for index, match in enumerate(columns) if match]
    rows = []
    for number, line in enumerate(lines[2:], 3):
        if line.strip():
            try:
                rows.append([float(word) for word in line.split()])
            except ValueError:
                raise data_error(path.as_posix(), "a row of numbers was expected here", number) from None
            if len(rows[-1]) != len(columns):
                raise data_error(path.as_posix(), f"{len(rows[-1])} values, the header has {len(columns)}", number)
    if not rows or len(at) % 3:
        raise data_error(path.as_posix(), "no rows, or no x, y and z of each node, below the header")
    table = np.array(rows)
    return table[:, 0], table[:, at].reshape(len(table), -1, 3)


def _orcaflex(path: Path, model: LineModel, headings: dict[str, str]) -> Positions:
    from mudline.tools.exporting import orcaflex  # noqa: PLC0415 - as above

    known = (*headings, *_PLACE)
    table = read_numeric_csv(path, known, known, headings | _PLACE)
    file, columns = path.as_posix(), table.columns
    if len(model.lines) > 1:
        message = f"the deck has {len(model.lines)} lines, and the table does not say whose nodes these are"
        raise data_error(file, f"{message}: give positions by node number with --columns")
    times, step = np.unique(columns.get("time", np.zeros(len(table.lines))), return_inverse=True)
    nodes = len(table.lines) // max(1, len(times))
    if not nodes or (np.bincount(step) != nodes).any():
        raise data_error(file, "each time must have a row for each node")
    order = np.lexsort((columns["arc" if "arc" in columns else "node"], step))
    places = np.column_stack([columns[name] for name in _PLACE])[order].reshape(len(times), nodes, 3)
    parts = orcaflex.pieces(model)[0]
    sizes = [np.full(count := orcaflex.segments(part), part.length / count) for part in parts]
    arcs = columns["arc"][order][:nodes] if "arc" in columns else np.append(0.0, np.cumsum(np.concatenate(sizes)))
    if len(arcs) != nodes:
        message = f"{nodes} nodes, the exported line has {len(arcs)}: give a table with the column Arc length (m)"
        raise data_error(file, message)
    return _positions(model, [(model.lines[0], arcs, places)], times if "time" in columns else None)


def _positions(model: LineModel, parts: list[PartRead], time: Floats | None) -> Positions:
    """Return positions of the deck's nodes, in its axes and units, interpolated by arc length."""
    steps, count = len(parts[0][2]), len(model.places)
    values, present = np.full((steps, count, 3), np.nan), np.zeros(count, dtype=np.bool_)
    for part, arcs, places in parts:
        own = np.append(0.0, np.cumsum(part.lengths))
        present[part.nodes] = True
        for step in range(steps):
            x, y, z = (np.interp(own, arcs, places[step, :, axis]) for axis in range(3))
            values[step, part.nodes] = np.column_stack([z + model.depth, x, y]) / model.units.length
    return Positions(values, present, time)
