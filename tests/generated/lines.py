"""Strategies for lines and tables, from the declared columns."""

from __future__ import annotations

from typing import Any

from hypothesis import strategies as st

from mudline.keywords.model import ListRow, Row, Slot, layout
from tests.generated.values import BY_KIND

Values = dict[str, Any]


def cell(slot: Slot) -> st.SearchStrategy[Any]:
    """One value of a field: a choice, a value of its kind, or a row."""
    options: list[st.SearchStrategy[Any]] = [st.sampled_from(slot.choices)] if slot.choices else []
    options += [BY_KIND[slot.kind]] if slot.kind else []
    options += [row(slot.row)] if slot.row else []
    value = st.one_of(options)
    return st.lists(value, min_size=1, max_size=4) if slot.many else value


@st.composite
def line(draw: st.DrawFn, columns: list[Slot]) -> Values:
    """Fields of a line, those at its end left out, those that may be empty sometimes None."""
    fewest = max((index + 1 for index, slot in enumerate(columns) if slot.required), default=0)
    count = draw(st.integers(fewest, len(columns)))
    return {
        slot.json: None if not slot.required and draw(st.integers(0, 3)) == 0 else draw(cell(slot))
        for slot in columns[:count]
    }


def row(part: type[Row]) -> st.SearchStrategy[Any]:
    """A row: an object, or a list where the declaration says so."""
    values = line(layout(part).columns)
    return values.map(lambda given: list(given.values())) if issubclass(part, ListRow) else values


def table(slot: Slot, fewest: int) -> st.SearchStrategy[list[list[Any]]]:
    """Rows of a table; the same few of them many times over make a long one."""
    assert slot.row is not None
    cells = line(layout(slot.row).columns).map(lambda given: list(given.values()))
    rows = st.lists(cells, min_size=fewest, max_size=4)
    return st.tuples(rows, st.sampled_from([1, 1, 1, 12])).map(lambda pair: pair[0] * pair[1])
