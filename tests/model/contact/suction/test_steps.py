"""What holds for the suction of an element on any path, under any law."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from mudline.model.contact import ContactModel
from mudline.model.contact.laws.suction import SuctionLaw, SuctionState
from tests.helpers.builders.contact import NONE, chain, floats, heave, suction
from tests.model.contact.single import largest

fractions = st.floats(0.01, 0.98)
laws = st.builds(
    lambda first, width, force, depth, exponents: SuctionLaw(
        *map(floats, (force, exponents[0], depth, exponents[1])),
        *map(floats, (first, first + width * (0.99 - first), 1.0, 1e-3, np.nan)),
    ),
    fractions,
    st.floats(0.0, 1.0),
    st.floats(0.0, 1e5),
    st.floats(1e-3, 2.0),
    st.tuples(st.floats(0.0, 2.5), st.floats(0.0, 1.5)),
)


@given(laws, st.lists(st.floats(-0.3, 0.6, allow_subnormal=False), min_size=2, max_size=30), st.floats(1e-3, 10.0))
def test_it_never_pushes_and_pulls_less_than_the_largest_force_between_compression_and_breakout(
    law: SuctionLaw, uplifts: list[float], dt: float
) -> None:
    rates = [0.0, *((here - last) / dt for last, here in pairwise(uplifts))]
    positions, velocities = heave([0.0 - uplift for uplift in uplifts], rates)
    result = ContactModel(chain([NONE], suction(law))).evaluate(positions, velocities=velocities)
    assert result.state is not None
    armed = False
    for uplift, rate, force, state in zip(uplifts, rates, result.force[:, 0], result.state[:, 0], strict=True):
        limit = largest(law, floats(max(rate, 0.0)))[0].item()
        assert -limit * (1.0 + 1e-15) <= force <= 0.0
        assert not (force == 0.0 and np.signbit(force))
        assert force == 0.0 or (armed and state == SuctionState.SUCTION)
        assert (state == SuctionState.COMPRESSION) == (uplift < 0.0)
        armed = (armed or state == SuctionState.COMPRESSION) and state != SuctionState.BROKEN
        assert armed == (state in {SuctionState.COMPRESSION, SuctionState.SUCTION, SuctionState.HOLD})
