"""Elements that follow each other are worked on as slices; in any other order the results are the same."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.contact import ContactInput, ContactModel, ElementError, LawKind
from mudline.contact.arrays import IndexArray, as_range
from mudline.contact.extras import Extras
from mudline.contact.laws.curve import curve_springs
from mudline.curves import ForceCurve
from tests.contact.scenes import CLAY, everything


def plain(elements: int, *, curves: int = 1) -> ContactInput:
    """A chain on curves, in stretches."""
    index = np.arange(elements) * curves // elements
    given_curves = tuple(ForceCurve([(0.0, 0.0), (0.2, 1000.0 + number)]) for number in range(curves))
    inputs = replace(everything(elements, 1), extras=Extras(), curves=given_curves, curve_index=index)
    return replace(inputs, law=np.full(elements, LawKind.CURVE, np.int8), diameter=np.full(elements, 0.3))


def shuffled(inputs: ContactInput, order: IndexArray) -> ContactInput:
    """The same elements in another order."""
    names = ("element_ids", "element_nodes", "length", "diameter", "law", "curve_index", "linear_stiffness")
    return replace(inputs, **{name: getattr(inputs, name)[order] for name in names})


@pytest.mark.parametrize("curves", [1, 3])
@pytest.mark.parametrize("lift", [0.0, 0.05, 1.0])
def test_order_does_not_matter(curves: int, lift: float) -> None:
    inputs = plain(40, curves=curves)
    order = np.random.default_rng(5).permutation(40)
    points = np.stack([inputs.coordinates + np.array([step * lift, 0.0, 0.0]) for step in range(3)])
    straight = ContactModel(inputs).evaluate(points)
    mixed = ContactModel(shuffled(inputs, order)).evaluate(points)
    for name in ("force", "slope", "stiffness", "contact", "cut"):
        assert np.array_equal(getattr(straight, name)[:, order], getattr(mixed, name)), name
    assert np.array_equal(straight.reaction, mixed.reaction)


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


def test_a_slice_of_springs_has_the_shape_of_its_depths() -> None:
    (group,) = curve_springs(replace(plain(6), curves=(CLAY,)))
    ratio = np.full((2, 3), 0.1)
    spring = group.spring(slice(1, 4), 0.3 * ratio, ratio)
    assert spring.force.shape == spring.stiffness.shape == (2, 3)
