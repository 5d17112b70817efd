"""Nodal reactions balance the forces on the elements."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.model.contact import ContactModel
from tests.helpers.builders.contact import at_depths, mixed


@given(st.integers(1, 60), st.integers(0, 2**32 - 1))
def test_reactions_balance_the_forces_on_the_elements(count: int, seed: int) -> None:
    inputs = mixed(count, seed)
    depths = np.random.default_rng(seed).uniform(-0.1, 0.2, (3, count + 1))
    result = ContactModel(inputs).evaluate(at_depths(depths))
    load = result.force * inputs.length
    assert result.reaction[..., 0].sum(axis=1) == pytest.approx(load.sum(axis=1), rel=1e-12, abs=1e-12)
    # The moment about the origin, each element's force acting at its middle.
    lever = np.arange(count + 1)
    assert result.normal_force @ lever == pytest.approx(load @ (lever[:-1] + 0.5), rel=1e-12, abs=1e-12)
    assert np.array_equal(result.reaction, result.normal_force[..., np.newaxis] * result.normal)
    assert np.array_equal(result.normal, np.broadcast_to([1.0, 0.0, 0.0], (3, count + 1, 3)))
