"""Inputs and positions that cannot be evaluated, each named."""

from __future__ import annotations

import pickle
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import ArrayLike

from mudline.contact import ContactModel, ElementError, PositionError
from mudline.curves import ForceCurve
from tests.contact.chains import CURVE, LINEAR, NONE, at_depths, chain

GOOD = chain([CURVE, LINEAR, NONE])


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_a_position_that_is_not_finite_is_named(value: float, axis: int) -> None:
    positions = np.zeros((9000, 4, 3))
    positions[8000, 2, axis] = positions[8500, 0, 0] = value
    with pytest.raises(PositionError, match="node 103 at step 8000: its position") as caught:
        ContactModel(GOOD).evaluate(positions)
    assert (caught.value.node, caught.value.step) == (103, 8000)
    assert isinstance(caught.value, ValueError)


def test_a_present_node_needs_a_position() -> None:
    positions = np.zeros((4, 3))
    positions[[1, 3]] = np.nan
    with pytest.raises(PositionError, match="node 104 at step 0"):
        ContactModel(GOOD).evaluate(positions, present=[True, False, True, True])


@pytest.mark.parametrize("shape", [(3,), (4, 2), (5, 3), (2, 5, 3), (2, 4, 2), (1, 2, 4, 3), ()])
def test_positions_of_another_shape(shape: tuple[int, ...]) -> None:
    with pytest.raises(ValueError, match=r"the shape \(4, 3\) or \(steps, 4, 3\), not \("):
        ContactModel(GOOD).evaluate(np.zeros(shape))


def test_positions_of_another_kind() -> None:
    with pytest.raises(ValueError, match="positions must be real numbers, not complex128"):
        ContactModel(GOOD).evaluate(np.zeros((4, 3), complex))


@pytest.mark.parametrize("present", [[True] * 3, [1, 1, 1, 1], True])
def test_a_mask_that_does_not_fit(present: ArrayLike) -> None:
    with pytest.raises(ValueError, match=r"present must be booleans of shape \(4,\)"):
        ContactModel(GOOD).evaluate(np.zeros((4, 3)), present=present)


STEEP = ForceCurve([(0.0, 0.0), (1.0, 1e308)])


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"diameter": np.full(3, 1e-300)}, "its embedment ratio overflows"),
        ({"curves": (STEEP,)}, "no force at ratio .*: the force there overflows"),
        ({"curves": (STEEP,), "diameter": np.full(3, 1e-4)}, "no force at ratio"),
        ({"length": np.full(3, 1e308)}, "the reaction at its nodes overflows"),
    ],
)
def test_an_overflow_names_element_and_step(changes: dict[str, Any], message: str) -> None:
    contact = ContactModel(replace(GOOD, **changes))
    positions = np.zeros((9000, 4, 3))
    positions[8123, :2, 0] = -1e9
    with pytest.raises(ElementError, match=f"element 11 at step 8123: .*{message}") as caught:
        contact.evaluate(positions)
    assert (caught.value.element, caught.value.step) == (11, 8123)


def test_a_stiffness_that_overflows() -> None:
    inputs = replace(chain([CURVE]), curves=(ForceCurve([(0.0, 0.0), (1e-3, 1e300)]),), diameter=np.array([1e-10]))
    with pytest.raises(ElementError, match="element 11 at step 0: its stiffness overflows"):
        ContactModel(inputs).evaluate(at_depths([1e-20, 1e-20]))


@pytest.mark.parametrize(("stiffness", "diameter", "what"), [(1e308, 0.3, "force"), (1e200, 1e200, "slope")])
def test_a_linear_law_that_overflows(stiffness: float, diameter: float, what: str) -> None:
    inputs = replace(chain([NONE, LINEAR], diameter=diameter), linear_stiffness=np.array([np.nan, stiffness]))
    with pytest.raises(ElementError, match=f"element 12 at step 0: its {what} overflows"):
        ContactModel(inputs).evaluate(at_depths([10.0, 10.0, 10.0]))


def test_a_sum_that_overflows() -> None:
    inputs = replace(chain([LINEAR] * 3), linear_stiffness=np.full(3, 1e308))
    contact = ContactModel(replace(inputs, element_nodes=np.array([[0, 1], [0, 2], [0, 3]], np.intp)))
    with pytest.raises(ElementError, match="the reaction at its nodes overflows"):
        contact.evaluate(at_depths(np.ones(4)))


def test_what_would_overflow_above_the_bed_is_not_evaluated() -> None:
    result = ContactModel(replace(GOOD, curves=(STEEP,), diameter=np.full(3, 1e-4))).evaluate(
        at_depths(np.full(4, -1e9))
    )
    assert not result.force.any()


def test_depths_near_the_largest_number() -> None:
    result = ContactModel(chain([NONE], diameter=1.0)).evaluate(at_depths([1.7e308, 1.7e308]))
    assert result.depth.tolist() == [1.7e308]


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"element_nodes": np.array([[0, 1], [1, 4], [2, 3]])}, "element 12 has a node that is not there"),
        ({"element_nodes": np.array([[0, 1], [1, 2], [-1, 3]])}, "element 13 has a node that is not there"),
        ({"length": np.array([1.0, np.nan, 1.0])}, "element 12 has no usable length"),
        ({"length": np.array([-1.0, 1.0, 1.0])}, "element 11 has no usable length"),
        ({"diameter": np.array([1.0, 1.0, 0.0])}, "element 13 has a diameter that is not positive"),
        ({"diameter": np.array([1.0, np.inf, 1.0])}, "element 12 has a diameter that is not positive"),
        ({"diameter": np.array([np.nan, 1.0, 1.0])}, "element 11 has a curve and no diameter"),
        ({"law": np.array([1, 2, 5])}, "element 13 has a law that is not evaluated here"),
        ({"law": np.array([1, 2, 4])}, "element 13 has a nodal law and a node without a stiffness"),
        ({"law": np.array([1, 2, -1])}, "element 13 has a law that is not evaluated here"),
        ({"curve_index": np.array([1, -1, -1])}, "element 11 has a curve that is not there"),
        ({"curve_index": np.array([-1, -1, -1])}, "element 11 has a curve that is not there"),
        ({"linear_stiffness": np.full(3, np.nan)}, "element 12 has a linear law and no finite stiffness"),
    ],
)
def test_an_element_that_cannot_be_evaluated_is_named(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(ElementError, match=message) as caught:
        replace(GOOD, **changes)
    assert f"element {caught.value.element} " in message
    assert caught.value.step is None


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"coordinates": np.zeros((3, 3))}, r"coordinates must be floats of shape \(4, 3\)"),
        ({"coordinates": np.zeros((4, 3), int)}, r"coordinates must be floats of shape \(4, 3\), not int64"),
        ({"node_ids": np.zeros(4)}, "node_ids must be integers"),
        ({"element_nodes": np.zeros((3, 3), int)}, r"element_nodes must be integers of shape \(3, 2\)"),
        ({"law": np.zeros(2, np.int8)}, r"law must be integers of shape \(3,\)"),
        ({"diameter": np.ones(4)}, r"diameter must be floats of shape \(3,\)"),
        ({"tension": "pull"}, "tension must be 'keep' or 'cut', not 'pull'"),
    ],
)
def test_arrays_that_do_not_fit(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        replace(GOOD, **changes)


def test_errors_survive_a_process_boundary() -> None:
    position = pickle.loads(pickle.dumps(PositionError("node 7", 7, 3)))  # noqa: S301 - our own bytes
    assert (position.node, position.step, str(position)) == (7, 3, "node 7")
    element = pickle.loads(pickle.dumps(ElementError("element 7", 7)))  # noqa: S301 - our own bytes
    assert (element.element, element.step, str(element)) == (7, None, "element 7")
