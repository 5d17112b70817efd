"""Elements that follow each other are worked on as slices; in any other order the results are the same."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.contact import ContactInput, ContactModel, ElementError
from mudline.contact.arrays import as_range
from mudline.curves import ForceCurve
from tests.builders.contact import everything, on


def plain(elements: int, *, curves: int = 1) -> ContactInput:
    """A chain on curves, in stretches."""
    index = np.arange(elements) * curves // elements
    given_curves = tuple(ForceCurve([(0.0, 0.0), (0.2, 1000.0 + number)]) for number in range(curves))
    laws = (on("curve", elements, curve=index),)
    return replace(everything(elements, 1), laws=laws, curves=given_curves, diameter=np.full(elements, 0.3))


def test_the_element_at_fault_is_named_where_all_touch() -> None:
    steep = replace(plain(6), curves=(ForceCurve([(0.0, 0.0), (1.0, 1e300)]),))
    points = steep.coordinates.copy()
    points[:, 0] = -0.1
    points[3:5, 0] = -1e10
    series = np.stack([steep.coordinates, points])
    with pytest.raises(ElementError, match="element 3 at step 1") as caught:
        ContactModel(steep).evaluate(series)
    assert (caught.value.element, caught.value.step) == (3, 1)


@given(st.lists(st.integers(0, 30), max_size=12))
def test_ranges(indices: list[int]) -> None:
    found = as_range(np.array(indices, np.intp))
    assert np.arange(31)[found].tolist() == indices
    assert isinstance(found, slice) == (
        indices == list(range(indices[0], indices[0] + len(indices))) if indices else True
    )
