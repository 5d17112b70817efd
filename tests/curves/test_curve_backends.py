"""Numpy alone and the compiled loops evaluate curves alike, bit for bit."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable

import numba
import numpy as np
import pytest
from hypothesis import given, reject
from hypothesis import strategies as st

from mudline.curves import Backend, CurveError, ForceCurve, Law, NumpyLaw, _loads, compiled, law_for
from mudline.curves.points import FloatArray
from mudline.curves.search import BLOCK, BucketTable, Workspace
from tests.curves.plain import POINTS, near, plain_values, steps

BACKENDS: tuple[Backend, ...] = ("numpy", "fast")
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
def test_both_backends_follow_the_law_to_the_last_bit(curve: ForceCurve, more: list[float]) -> None:
    query = near(curve.ratios, more)
    with np.errstate(all="ignore"):
        force, slope = plain_values(curve, query)
    good = np.isfinite(force)
    # Long enough to be worth a table.
    query, force, slope = (np.resize(values[good], 2000) for values in (query, force, slope))
    for backend in BACKENDS:
        found = curve.evaluate(query, backend=backend)
        assert found[0].tobytes() == force.tobytes()
        assert found[1].tobytes() == slope.tobytes()


@given(curves(), st.floats(allow_nan=True, allow_infinity=True), st.integers(0, 1999))
def test_both_backends_recompute_and_refuse_the_same(curve: ForceCurve, odd: float, where: int) -> None:
    query = np.full(2000, curve.ratios[1])
    query[where] = odd
    answers: list[object] = []
    for backend in BACKENDS:
        try:
            force, slope = curve.evaluate(query, backend=backend)
            answers.append((force.tobytes(), slope.tobytes()))
        except ValueError as error:
            answers.append(str(error))
    assert answers[0] == answers[1]


@pytest.mark.parametrize("count", [2, 9, 10, 21, 22, 33, 34, 10_000, 70_000])
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
    for backend in BACKENDS:
        found = curve.evaluate(query, backend=backend)
        assert found[0].tobytes() == force.tobytes()
        assert found[1].tobytes() == slope.tobytes()
    assert np.array_equal(
        curve.segment(query), np.clip(np.searchsorted(ratios, query, "right") - 1, 0, len(ratios) - 2)
    )


@pytest.mark.parametrize("count", [2, 5, 40])
@pytest.mark.parametrize("backend", BACKENDS)
def test_any_layout_and_results_in_the_memory_of_the_query(count: int, backend: Backend) -> None:
    rng = np.random.default_rng(count)
    curve = ForceCurve(np.column_stack((np.sort(rng.random(count)), rng.random(count))))
    memory = rng.uniform(-1.0, 2.0, (300, 2, 200))
    for view in (memory[:, 0], memory[::-1, 1, ::3], memory[..., 5].T, memory.T, memory[:, 1, :40].reshape(-1, 8)):
        force, slope = plain_values(curve, view)
        found = curve.evaluate(view, backend=backend)
        assert np.array_equal(found[0], force)
        assert np.array_equal(found[1], slope)
        both = np.stack((view, view))
        for place in (0, 1):
            out = (both[place].copy(), both[place].copy())
            curve.evaluate(out[place], out=out, backend=backend)
            assert np.array_equal(out[0], force)
            assert np.array_equal(out[1], slope)


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("place", [0, 1])
def test_a_refusal_names_the_ratio_even_where_results_replace_it(backend: Backend, place: int) -> None:
    curve = ForceCurve([(0.0, -1.7e308), (2.5, 1.7e308)])
    query = np.full(40_000, 2.0)
    out = (np.empty(40_000), np.empty(40_000))
    out[place][...] = query
    curve.evaluate(out[place], out=out, backend=backend)
    # The product overflows, the force does not.
    assert out[0].tolist() == curve.evaluate(query)[0].tolist()
    out[place][...] = query
    out[place][30_000] = 1e10
    with pytest.raises(ValueError, match=r"ratio 10000000000\.0 \(index 30000\)"):
        curve.evaluate(out[place], out=out, backend=backend)


def test_the_loops_mean_the_same_before_they_are_compiled() -> None:
    curve = ForceCurve([(0.0, 1.0), (0.5, 2.0), (0.75, -1.0), (math.nextafter(0.75, 1.0), -1.0), (1.0, 3.0)])
    query = np.resize(near(curve.ratios, [-2.0, 7.0]), 1100)
    knots = curve._knots
    points = (knots.ratios, knots.forces, knots.tails)
    tables: tuple[BucketTable | None, ...] = (None, knots.prepare())
    for table in tables:
        force, slope = np.empty(1100), np.empty(1100)
        if table is None:
            assert compiled._fill_counting(points, query, force, slope)
        else:
            assert compiled._fill_bucketing(points, table, query, force, slope)
        assert force.tobytes() == plain_values(curve, query)[0].tobytes()
        assert slope.tobytes() == plain_values(curve, query)[1].tobytes()
    for value in query.tolist():
        assert compiled._passed(knots.prepare().knots, value) == np.searchsorted(curve.ratios[1:], value, side="right")


def test_a_place_without_a_cache_compiles_anyway(monkeypatch: pytest.MonkeyPatch) -> None:
    options: list[bool] = []
    more: list[object] = []

    def njit(*, cache: bool = False, **others: object) -> Callable[[object], object]:
        options.append(cache)
        more.append(others.get("no_cfunc_wrapper"))
        if cache:
            raise RuntimeError("cannot cache function: no locator available")
        return lambda function: (function, "made")

    monkeypatch.setattr(numba, "njit", njit)
    found: object = compiled.compiled(abs, no_cfunc_wrapper=True)
    assert options == [True, False]
    assert more == [True, True]
    assert found == (abs, "made")


def compiles(law: Law, compiled_function: object) -> bool:
    return isinstance(law, compiled.CompiledLaw) and law.compiled is compiled_function


def test_the_backend_that_a_query_gets(monkeypatch: pytest.MonkeyPatch) -> None:
    knots = ForceCurve([(0.0, 0.0), (1.0, 1.0), (2.0, 5.0)])._knots
    work = Workspace()
    assert isinstance(law_for(knots, 10**7, work, "numpy"), NumpyLaw)
    assert compiles(law_for(knots, 1, work, "fast"), compiled.fill_counting)
    # Once loaded, from some thousands on; not yet loaded, from some millions on.
    assert isinstance(law_for(knots, 100, work), NumpyLaw)
    assert compiles(law_for(knots, 10_000, work), compiled.fill_counting)
    monkeypatch.delitem(sys.modules, "mudline.curves.compiled")
    _loads.cache_clear()
    assert isinstance(law_for(knots, 10_000, work), NumpyLaw)
    assert not isinstance(law_for(knots, 10**7, work), NumpyLaw)


def test_without_the_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    curve = ForceCurve([(0.0, 0.0), (1.0, 1.0)])
    monkeypatch.delitem(sys.modules, "mudline.curves.compiled")
    monkeypatch.setitem(sys.modules, "numba", None)
    _loads.cache_clear()
    try:
        assert isinstance(law_for(curve._knots, 10**7, Workspace()), NumpyLaw)
        with pytest.raises(ImportError):
            curve.evaluate(0.5, backend="fast")
    finally:
        _loads.cache_clear()


def test_a_backend_of_another_name() -> None:
    with pytest.raises(ValueError, match="backend must be auto, numpy or fast, not 'cuda'"):
        ForceCurve([(0.0, 0.0), (1.0, 1.0)]).evaluate(0.5, backend="cuda")  # type: ignore[arg-type]  # on purpose
