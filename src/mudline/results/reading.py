"""Results from the files that `mudline evaluate -o` writes, without their deck."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import cast

import numpy as np

from mudline.contact.arrays import FloatArray, IndexArray, StateArray
from mudline.contact.columns import CUT, Values
from mudline.contact.input import ContactInput, ElementError
from mudline.contact.lines import lines_in_part
from mudline.contact.result import ContactResult
from mudline.files import suffix_of
from mudline.quantities import SLIDING, STATES, Names
from mudline.results.forms import form_module, form_names
from mudline.results.stored import TABLES, Key, Stored, StoredTable
from mudline.scene.csv_file import data_error
from mudline.short_repr import listed_numbers, short_repr

_MOST_LINES = 1_000_000
"""A file whose lines have larger numbers is damaged."""
_NEAR = 1e-9
"""How far the middle of an element may be from that of its nodes, as a part of the largest coordinate."""


def read_result(path: str | os.PathLike[str]) -> ContactResult:
    """Return the result in a file that `mudline evaluate -o` wrote, by its suffix.

    CSV and Parquet have the nodes in a file beside that of the elements. `given` has elements, nodes, names of laws and
    sets, and units, and no laws to evaluate again; submerged weights and regularised suction are in no file. A row is
    an element or a node that has a position. Of a line that lacks elements in its middle, the pieces behind the first
    are lines of their own.

    Args:
        path: CSV, JSON, NPZ, Parquet or XLSX; for CSV and Parquet the file of the elements.

    Raises:
        OSError: the file cannot be read.
        DeckError: it is not a file of results, one of another version, damaged, or the files do not belong together.
        ImportError: the library for its form is not installed.
        ValueError: results have no form of this suffix.
    """
    file = Path(path)
    form = suffix_of(file)
    if form not in form_names():
        known = ", ".join(f".{name}" for name in form_names())
        raise ValueError(f"{file.as_posix()}: results are in files {known}, not {file.suffix or 'without a suffix'}")
    return result_of(cast("Stored", form_module(form).read(file)), file.as_posix())


@dataclass(frozen=True, slots=True)
class StoredNames:
    """What a file says about laws, sets and units; `source` is the file."""

    units: str
    source: str
    law_names: Sequence[str]
    law_sets: Sequence[str | None]

    __repr__ = short_repr


class _Steps:
    """The columns of a table as (steps, rows)."""

    def __init__(self, table: StoredTable, key: Key) -> None:
        self.table = table
        ids = table.whole(key)
        again = np.flatnonzero(ids[1:] == ids[:1])
        self.rows = int(again[0]) + 1 if again.size else len(ids)
        self.count, left = divmod(len(ids), self.rows) if self.rows else (0, 0)
        if left:
            raise table.fault(f"the last step has {left} of {self.rows} rows: the file is cut off")
        by_step = ids.reshape(self.count, self.rows)
        self.ids = by_step[0] if self.count else ids
        if (by_step != self.ids).any():
            step = int(np.argmax((by_step != self.ids).any(axis=1)))
            raise table.fault(f"the {key}s of step {step} are not those of step 0: the file is damaged or edited")
        numbers, counts = np.unique(self.ids, return_counts=True)
        if (counts > 1).any():
            raise table.fault(f"{key} {numbers[counts > 1][0]} is given twice in a step")
        self.times = self._times(key)

    def _times(self, key: Key) -> FloatArray | None:
        times = self.table.times
        if times is None:
            if self.count > 1:
                raise self.table.fault(f"{key} {self.ids[0]} is given {self.count} times: expected a column time")
            return None
        by_step = times.reshape(self.count, self.rows) if self.rows else times.reshape(0, 0)
        first = by_step[:, 0] if self.rows else times
        if not np.isfinite(first).all() or (by_step != first[:, np.newaxis]).any():
            raise self.table.fault("time: expected one finite time for all rows of a step")
        falls = np.flatnonzero(np.diff(first) <= 0.0)
        if falls.size:
            before, after = first[falls[0] : falls[0] + 2].tolist()
            raise self.table.fault(f"times must rise: {after!r} follows {before!r}")
        return np.ascontiguousarray(first)

    def numbers(self, name: str) -> FloatArray:
        """Numbers (steps, rows)."""
        return self._shaped(self.table.numbers(name))

    def vectors(self, name: str, suffixes: Sequence[str]) -> FloatArray:
        """Vectors (steps, rows, k)."""
        return np.stack([self.numbers(name + suffix) for suffix in suffixes], axis=-1)

    def states(self, name: str, names: Names) -> StateArray:
        """States (steps, rows) by their number; -1 is none."""
        codes, found = self.table.texts(name)
        known = [each for each in names if each is not None]
        if unknown := [each for each in found if each not in known]:
            raise self.table.fault(f"{name}: expected one of {', '.join(known)}, found {unknown[0]!r}")
        numbers = np.array([*map(known.index, found), -1], np.int8)
        return self._shaped(numbers[codes])

    def texts(self, name: str) -> tuple[Values, tuple[str, ...]]:
        """Texts as codes (steps, rows), -1 for none, and the names of the codes."""
        codes, names = self.table.texts(name)
        return self._shaped(codes), names

    def flags(self, name: str) -> Values:
        """Flags (steps, rows)."""
        return self._shaped(self.table.flags(name))

    def once(self, values: Values, name: str) -> Values:
        """The row of values (steps, rows) that no step may change."""
        if not self.count:
            return values.reshape(0)
        changed = (values != values[0]) & ~((values != values) & (values[0] != values[0]))  # noqa: PLR0124 - NaN
        if changed.any():
            raise self.table.fault(f"{name} changes from step to step: the file is damaged or edited")
        found: Values = values[0]
        return found

    def fixed_numbers(self, name: str) -> FloatArray:
        """Numbers (rows,) that no step changes."""
        return self.once(self.numbers(name), name)

    def fixed_whole(self, name: str) -> Values:
        """Whole numbers (rows,) that no step changes."""
        return self.once(self._shaped(self.table.whole(name)), name)

    def _shaped(self, values: Values) -> Values:
        return values.reshape(self.count, self.rows)


def result_of(stored: Stored, file: str) -> ContactResult:
    """Put the tables of a file together; raises DeckError where they do not fit."""
    elements, nodes = (_Steps(getattr(stored, table), key) for table, key in TABLES.items())
    if not nodes.rows:
        raise nodes.table.fault("no node: the file holds no result")
    _require_same_steps(elements, nodes)
    steps, timed = nodes.count, nodes.times is not None
    codes, laws = elements.texts("law")
    if (codes < 0).any():
        raise elements.table.fault("law: a name is missing")
    cut = _named(codes, laws, CUT)
    positions = nodes.vectors("", ("x", "y", "z"))
    given = _given(stored, (elements, nodes), positions[0], file)
    _require_middles(elements, given, positions)
    state = elements.states("state", STATES)
    friction = nodes.vectors("", ("axial_force", "lateral_force"))
    friction_state = np.stack([nodes.states(f"{side}_state", SLIDING) for side in ("axial", "lateral")], axis=-1)
    slides = bool((friction_state >= 0).any())
    rigid = np.zeros(nodes.rows, np.bool_)
    rigid[given.element_nodes[[name == "rigid" for name in given.law_names]]] = True

    def of_elements(values: Values) -> Values:
        return values if elements.rows else np.zeros((steps, 0), values.dtype)

    series = ContactResult(
        **{name: of_elements(elements.numbers(name)) for name in ("depth", "ratio", "force", "slope", "stiffness")},
        contact=of_elements(elements.flags("contact")),
        cut=of_elements(cut),
        gap=nodes.numbers("gap"),
        normal=nodes.vectors("normal", ("_x", "_y", "_z")),
        reaction=nodes.vectors("reaction", ("_x", "_y", "_z")),
        normal_force=nodes.numbers("normal_force"),
        evaluated=np.ones(elements.rows, np.bool_),
        present=np.ones(nodes.rows, np.bool_),
        state=of_elements(state) if (state >= 0).any() else None,
        friction=friction if slides or friction.view(np.uint64).any() else None,
        friction_state=friction_state if slides else None,
        rigid=rigid if rigid.any() else None,
        given=given,
        positions=positions,
        times=nodes.times,
    )
    return series if timed else series.step(0)


def _require_same_steps(elements: _Steps, nodes: _Steps) -> None:
    """Elements and nodes must be of the same steps; no element may have a position at all."""
    if not elements.rows:
        return
    table = elements.table
    what = f"its steps are not those of {nodes.table.file}: the two are of different runs; write them again"
    if (elements.times is None) != (nodes.times is None) or elements.count != nodes.count:
        raise table.fault(what)
    if elements.times is not None and nodes.times is not None and (elements.times != nodes.times).any():
        raise table.fault(what)


def _given(stored: Stored, steps: tuple[_Steps, _Steps], coordinates: FloatArray, file: str) -> ContactInput:
    """Elements, nodes and names; no laws."""
    elements, nodes = steps
    ends = np.stack([_indices(elements, name, nodes) for name in ("node1", "node2")], axis=-1)
    try:
        given = ContactInput(
            node_ids=nodes.ids,
            coordinates=coordinates,
            element_ids=elements.ids,
            element_nodes=ends,
            length=elements.fixed_numbers("length"),
            diameter=elements.fixed_numbers("diameter"),
            tension="cut" if CUT in elements.texts("law")[1] else "keep",
            names=StoredNames(stored.units, file, _law_names(elements), _law_sets(elements)),
        )
    except ElementError as error:
        raise elements.table.fault(str(error)) from error
    _number_lines(given, elements, nodes)
    return given


def _indices(elements: _Steps, name: str, nodes: _Steps) -> IndexArray:
    """The nodes at an end of the elements, as indices."""
    ids = elements.fixed_whole(name)
    order = np.argsort(nodes.ids)
    at: IndexArray = order[np.searchsorted(nodes.ids, ids, sorter=order).clip(max=nodes.rows - 1)]
    if (lost := nodes.ids[at] != ids).any():
        numbers = listed_numbers(np.unique(ids[lost]).tolist())
        what = f"no row for node {numbers}, where elements end: it does not belong to {elements.table.file}"
        raise nodes.table.fault(what)
    return at


def _law_names(elements: _Steps) -> list[str]:
    """The law of each element, as far as some step shows it: where it is always cut, that it is."""
    codes, names = elements.texts("law")
    if not elements.count:
        return []
    whole = ~_named(codes, names, CUT)
    first = np.where(whole.any(axis=0), whole.argmax(axis=0), 0)
    kept = codes[first, np.arange(elements.rows)]
    if (whole & (codes != kept)).any():
        raise elements.table.fault("law changes from step to step: the file is damaged or edited")
    return [names[code] for code in kept.tolist()]


def _law_sets(elements: _Steps) -> list[str | None]:
    codes, names = elements.texts("set")
    listed = (*names, None)
    return [listed[code] for code in elements.once(codes, "set").tolist()]


def _named(codes: Values, names: tuple[str, ...], name: str) -> Values:
    """Where codes stand for a name."""
    found: Values = codes == (names.index(name) if name in names else -2)
    return found


def _number_lines(given: ContactInput, elements: _Steps, nodes: _Steps) -> None:
    """Keep the lines and arc lengths of the file, where a part of the elements does not give the same ones."""
    numbers = (elements.fixed_whole("line") - 1, nodes.fixed_whole("line") - 1)
    arcs = (elements.fixed_numbers("arc_length"), nodes.fixed_numbers("arc_length"))
    for steps, found, least in ((elements, numbers[0], 0), (nodes, numbers[1], -1)):
        if ((found < least) | (found > _MOST_LINES)).any():
            wrong = int(found[(found < least) | (found > _MOST_LINES)][0]) + 1
            raise steps.table.fault(f"line: {wrong} is not the number of a line")
    own = given.lines
    same = np.array_equal(own.of_element, numbers[0]) and np.array_equal(own.of_node, numbers[1])
    if same and np.array_equal(own.element_arc, arcs[0]) and np.array_equal(own.node_arc, arcs[1], equal_nan=True):
        return
    given.keep_lines(lines_in_part(given.element_nodes, given.length, numbers, arcs))


def _require_middles(elements: _Steps, given: ContactInput, positions: FloatArray) -> None:
    """The middle of each element must be that of its nodes: else the two tables are not of the same run."""
    if not elements.rows:
        return
    middles = elements.vectors("", ("x", "y", "z"))
    ends = positions[:, given.element_nodes]
    apart = np.abs(0.5 * (ends[:, :, 0] + ends[:, :, 1]) - middles)
    wrong = ~(apart <= _NEAR * max(1.0, float(np.abs(middles).max()))).all(axis=-1)
    if wrong.any():
        element = int(given.element_ids[np.argwhere(wrong)[0, 1]])
        what = f"element {element} is not where its nodes are, by {elements.table.file}: write both tables again"
        raise data_error(given.names.source if given.names else "", what)
