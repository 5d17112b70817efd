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
from tests.builders.contact import at_depths, everything, mixed, on, rearranged


def plain(elements: int, *, curves: int = 1) -> ContactInput:
    """A chain on curves, in stretches."""
    index = np.arange(elements) * curves // elements
    given_curves = tuple(ForceCurve([(0.0, 0.0), (0.2, 1000.0 + number)]) for number in range(curves))
    laws = (on("curve", elements, curve=index),)
    return replace(everything(elements, 1), laws=laws, curves=given_curves, diameter=np.full(elements, 0.3))


@pytest.mark.parametrize("curves", [1, 3])
@pytest.mark.parametrize("lift", [0.0, 0.05, 1.0])
def test_order_does_not_matter(curves: int, lift: float) -> None:
    inputs = plain(40, curves=curves)
    order = np.random.default_rng(5).permutation(40)
    points = np.stack([inputs.coordinates + np.array([step * lift, 0.0, 0.0]) for step in range(3)])
    straight = ContactModel(inputs).evaluate(points)
    mingled = ContactModel(rearranged(inputs, order, np.zeros(40, np.bool_))).evaluate(points)
    for name in ("force", "slope", "stiffness", "contact", "cut"):
        assert np.array_equal(getattr(straight, name)[:, order], getattr(mingled, name)), name
    assert np.array_equal(straight.reaction, mingled.reaction)


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


def test_steps_and_elements_of_one_law_among_others() -> None:
    """Series in which some elements, not side by side, have one law: each has the force that it has alone."""
    inputs = mixed(12, seed=3)
    depths = np.random.default_rng(4).uniform(-0.05, 0.2, (7, 13))
    whole = ContactModel(inputs).evaluate(at_depths(depths))
    for element in range(12):
        pair = at_depths(depths[:, [element, element + 1]])
        lone = replace(
            inputs,
            node_ids=inputs.node_ids[:2],
            coordinates=inputs.coordinates[:2],
            element_ids=inputs.element_ids[element : element + 1],
            element_nodes=np.array([[0, 1]]),
            length=inputs.length[element : element + 1],
            diameter=inputs.diameter[element : element + 1],
            laws=tuple(
                on(name, 1, **{key: values[law.rows == element] for key, values in law.parameters.items()})
                for name, law in inputs.assigned.items()
                if element in law.rows
            ),
        )
        result = ContactModel(lone).evaluate(pair)
        for name in ("force", "slope", "stiffness", "depth", "ratio", "contact"):
            assert np.array_equal(getattr(result, name)[:, 0], getattr(whole, name)[:, element])
