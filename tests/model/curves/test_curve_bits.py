"""Curves are evaluated as the law says, bit for bit, whatever the search, the layout and the memory of the results."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, reject
from hypothesis import strategies as st

from mudline.model.curves import BLOCK, CurveError, ForceCurve
from mudline.model.curves.points import FloatArray
from tests.model.curves.plain import POINTS, near, plain_values, steps

FORCES: list[Callable[[FloatArray], FloatArray]] = [
    lambda ratios: 3.7 * ratios,
    lambda ratios: np.sin(np.arange(len(ratios))) * ratios,
    lambda ratios: np.where(np.arange(len(ratios)) % 3 == 0, ratios, -0.3 * ratios),
    lambda ratios: np.cos(np.arange(len(ratios))),
    lambda ratios: np.full(len(ratios), -2.5),
]


@st.composite
def curves(draw: st.DrawFn) -> ForceCurve:
    ratios = draw(POINTS)
    forces = draw(st.sampled_from(FORCES))(ratios)
    try:
        return ForceCurve(np.column_stack((ratios, forces)))
    except CurveError:
        reject()


@given(curves(), st.lists(st.floats(-1e300, 1e300), max_size=20))
def test_the_law_to_the_last_bit(curve: ForceCurve, more: list[float]) -> None:
    query = near(curve.ratios, more)
    with np.errstate(all="ignore"):
        force, slope = plain_values(curve, query)
    good = np.isfinite(force)
    # Long enough for a search of either kind.
    query, force, slope = (np.resize(values[good], 3000) for values in (query, force, slope))
    found = curve.evaluate(query)
    assert found[0].tobytes() == force.tobytes()
    assert found[1].tobytes() == slope.tobytes()


@pytest.mark.parametrize("count", [2, 9, 10, 61, 62, 70_000])
@pytest.mark.parametrize("spacing", ["even", "random", "geometric", "crowded"])
def test_random_ratios_in_several_blocks(count: int, spacing: str) -> None:
    rng = np.random.default_rng(count)
    ratios = {
        "even": np.linspace(-0.3, 1.0, count),
        "random": np.sort(rng.normal(size=count)),
        "geometric": np.geomspace(1e-8, 1.0, count),
        "crowded": np.unique([*rng.random(count // 2), *steps(0.5, (count + 1) // 2)]),
    }[spacing]
    curve = ForceCurve(np.column_stack((ratios, rng.normal(size=len(ratios)))))
    query = np.concatenate([rng.uniform(-1.0, 2.0, 2 * BLOCK), rng.choice(ratios, BLOCK // 2), [1e200, -1e200]])
    force, slope = plain_values(curve, query)
    found = curve.evaluate(query)
    assert found[0].tobytes() == force.tobytes()
    assert found[1].tobytes() == slope.tobytes()
    assert np.array_equal(
        curve.segment(query), np.clip(np.searchsorted(ratios, query, "right") - 1, 0, len(ratios) - 2)
    )


@pytest.mark.parametrize("count", [2, 5, 40])
def test_any_layout_and_results_in_the_memory_of_the_query(count: int) -> None:
    rng = np.random.default_rng(count)
    curve = ForceCurve(np.column_stack((np.sort(rng.random(count)), rng.random(count))))
    memory = rng.uniform(-1.0, 2.0, (300, 2, 200))
    for view in (memory[:, 0], memory[::-1, 1, ::3], memory[..., 5].T, memory.T, memory[:, 1, :40].reshape(-1, 8)):
        force, slope = plain_values(curve, view)
        found = curve.evaluate(view)
        assert np.array_equal(found[0], force)
        assert np.array_equal(found[1], slope)
        both = np.stack((view, view))
        for place in (0, 1):
            out = (both[place].copy(), both[place].copy())
            curve.evaluate(out[place], out=out)
            assert np.array_equal(out[0], force)
            assert np.array_equal(out[1], slope)


@pytest.mark.parametrize("place", [0, 1])
def test_a_refusal_names_the_ratio_even_where_results_replace_it(place: int) -> None:
    curve = ForceCurve([(0.0, -1.7e308), (2.5, 1.7e308)])
    query = np.full(40_000, 2.0)
    out = (np.empty(40_000), np.empty(40_000))
    out[place][...] = query
    curve.evaluate(out[place], out=out)
    # The product overflows, the force does not.
    assert out[0].tolist() == curve.evaluate(query)[0].tolist()
    out[place][...] = query
    out[place][30_000] = 1e10
    with pytest.raises(ValueError, match=r"ratio 10000000000\.0 \(index 30000\)"):
        curve.evaluate(out[place], out=out)
