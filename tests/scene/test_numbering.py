"""Numbers to indices, whatever the order and the amount of definitions."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from mudline.diagnostics import Where
from mudline.scene.numbering import Batch, Definitions, whole_numbers

_BATCHES = st.lists(st.lists(st.integers(-5, 40), max_size=12), max_size=8)


def gathered(batches: list[list[int]]) -> Definitions:
    """Definitions whose value is their row among all of them."""
    found = Definitions()
    row = 0
    for index, ids in enumerate(batches):
        values = np.arange(row, row + len(ids), dtype=np.float64)[:, np.newaxis]
        found.add(Batch(np.array(ids, dtype=np.int64), values, Where(0, index), "rows"))
        row += len(ids)
    return found


@given(_BATCHES)
def test_settled_definitions_are_those_of_a_dictionary(batches: list[list[int]]) -> None:
    flat = [number for ids in batches for number in ids]
    held = {number: row for row, number in enumerate(flat)}
    settled = gathered(batches).resolve(1)
    assert settled.ids.tolist() == list(dict.fromkeys(flat))
    assert settled.values[:, 0].tolist() == [held[number] for number in settled.ids.tolist()]
    assert settled.rows.tolist() == [held[number] for number in settled.ids.tolist()]
    assert settled.firsts.tolist() == [flat.index(number) for number in settled.ids.tolist()]
    assert settled.repeats.tolist() == [row for row, number in enumerate(flat) if number in flat[:row]]
    assert settled.ids_of(settled.repeats).tolist() == [flat[row] for row in settled.repeats.tolist()]
    places = [Where(0, index, ("rows", row)) for index, ids in enumerate(batches) for row in range(len(ids))]
    assert [settled.where_row(row) for row in range(len(flat))] == places
    assert [settled.where(index) for index in range(len(settled))] == [places[held[n]] for n in settled.ids.tolist()]


@given(_BATCHES, st.lists(st.integers(-7, 45)))
def test_indices_are_positions_or_minus_one(batches: list[list[int]], wanted: list[int]) -> None:
    settled = gathered(batches).resolve(1)
    ids = settled.ids.tolist()
    expected = [ids.index(number) if number in ids else -1 for number in wanted]
    assert settled.indices(np.array(wanted, dtype=np.int64)).tolist() == expected


@given(_BATCHES, st.integers(-7, 45), st.integers(0, 50), st.integers(1, 9))
def test_a_range_holds_the_indices_of_its_numbers(batches: list[list[int]], start: int, span: int, step: int) -> None:
    settled = gathered(batches).resolve(1)
    wanted = set(range(start, start + span + 1, step))
    expected = [index for index, number in enumerate(settled.ids.tolist()) if number in wanted]
    assert settled.between(start, start + span, step).tolist() == expected


def test_large_and_small_batches_are_found_alike() -> None:
    """More rows than a dictionary takes go into a sorted table, which later ones override."""
    found = Definitions()
    found.add(Batch(np.arange(20_000), np.arange(20_000.0)[:, np.newaxis], Where()))
    assert found.find(19_999) == [19_999.0]
    assert found.find(20_000) is None
    assert found.find(-1) is None
    found.add(Batch(np.array([7, 30_000]), np.array([[-7.0], [-8.0]]), Where()))
    assert found.find(7) == [-7.0]
    assert found.find(30_000) == [-8.0]
    assert found.find(8) == [8.0]
    found.add(Batch(np.arange(40_000)[::-1], np.arange(40_000.0)[:, np.newaxis], Where()))
    assert found.find(7) == [39_992.0]
    assert found.find(39_999) == [0.0]


def test_whole_numbers_of_a_column() -> None:
    column = np.array([1.0, 1.5, np.nan, -3.0, 2.0**53, 2.0**53 + 2, 1e300, np.inf])
    numbers, known = whole_numbers(column)
    assert known.tolist() == [True, False, False, True, True, False, False, False]
    assert numbers.tolist() == [1, 0, 0, -3, 2**53, 0, 0, 0]
