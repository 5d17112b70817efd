"""The compiled loops do what the stages do: equal states, values equal to rounding, the same refusals."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import fields, replace
from types import FunctionType
from typing import Any

import numba
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from mudline.contact import ContactInput, ContactModel, ContactResult, ElementError, PositionError, Tension
from mudline.contact.arrays import BoolArray, FloatArray
from mudline.contact.compiled import choice, jit, kernel, runner
from mudline.contact.compiled.choice import Backend
from mudline.contact.compiled.walk import walk_for
from mudline.contact.extras import Extras, Smoothing
from mudline.contact.floors import FlatFloor, Floor, PlanesFloor, ProfileFloor, SlopingFloor
from mudline.contact.state import ContactState
from tests.contact.chains import CURVE, LINEAR, NONE, PULLING, at_depths, chain
from tests.contact.joined import friction, model, nodal, suction, trench
from tests.contact.paths import journey, rearranged, renumbered
from tests.contact.scenes import everything
from tests.contact.suction.pulls import bridge_law

FLOORS: list[Floor] = [
    FlatFloor(),
    SlopingFloor(2.0, 30.0),
    PlanesFloor([[0.0, 0.0, 0.0]], [0.5]),
    PlanesFloor([[0.0, 0.0, 0.0], [0.0, 6.0, 0.0]], [1.0, 2.0], bounds=[[-1e9, 1e9, -1e9, 1e9], [6.0, 9.0, -1.0, 1.0]]),
    ProfileFloor([0.0, 5.0, 9.0], [0.0, -0.1, 0.1], "CUBIC SPLINE"),
]
AnyArray = NDArray[Any]
TENSIONS: list[Tension] = ["keep", "cut"]
ROUNDING = 1e-13
_SPRING = 1e5 * 10.0
"""Force of the stiffest spring of friction over the middle of a line: the largest term of friction."""
sizes = st.sampled_from([0.0, 5e-324, 1e-300, 1e-160, 1e-12, 1.0, 1e3, 1e12, 1e150, 1e300, 1.7e308])


def agree(one: AnyArray, other: AnyArray, largest: float) -> bool:
    """Whether they are the same but for rounding of the largest value, and missing in the same places."""
    absent = np.isnan(one)
    with np.errstate(over="ignore"):
        close = np.abs(one - other) <= ROUNDING * largest
    return np.array_equal(absent, np.isnan(other)) and bool((absent | close).all())


def same(one: ContactResult, other: ContactResult) -> bool:
    """Whether two results agree: flags and states exactly, values to rounding of the largest of their kind."""
    for field in fields(ContactResult):
        left, right = getattr(one, field.name), getattr(other, field.name)
        if left is None or left.dtype.kind != "f":
            alike = np.array_equal(left, right) if left is not None else right is None
        else:
            # a spring's force is the difference of those to its ends
            term = _SPRING if field.name in {"friction", "reaction"} else 0.0
            alike = agree(left, right, max(term, float(np.nanmax(np.abs(left), initial=0.0))))
        if not alike:
            return False
    return True


def remembered(state: ContactState) -> list[AnyArray]:
    """All arrays of a state."""
    found = []
    for part in (state.unloading, state.suction, state.friction):
        if part is not None:
            found += [getattr(part, field.name) for field in fields(part)]
    return found + [array for array in (state.touchdown, state.positions, state.laid) if array is not None]


def both(
    inputs: ContactInput,
    positions: FloatArray,
    present: BoolArray | None = None,
    *,
    velocities: FloatArray | None = None,
    times: FloatArray | None = None,
) -> list[ContactResult | str]:
    """What the two backends give: results or errors."""
    found: list[ContactResult | str] = []
    backends: tuple[Backend, ...] = ("numpy", "fast")
    for backend in backends:
        contact = ContactModel(inputs, backend=backend)
        try:
            found.append(contact.evaluate(positions, present=present, velocities=velocities, times=times))
        except (ElementError, PositionError) as error:
            found.append(str(error))
    return found


def expect_same(found: list[ContactResult | str]) -> None:
    one, other = found
    if isinstance(one, str) or isinstance(other, str):
        assert one == other
    else:
        assert same(one, other)


@settings(max_examples=80, deadline=None)
@given(st.integers(1, 9), st.integers(0, 9999), st.sampled_from(FLOORS), st.booleans(), st.booleans())
def test_everything_at_once(elements: int, seed: int, floor: Floor, told: bool, gaps: bool) -> None:
    inputs = everything(elements, seed, floor)
    positions, velocities, times = journey(elements, 20, seed)
    present = np.random.default_rng(seed).random(elements + 1) < (0.8 if gaps else 2.0)
    expect_same(both(inputs, positions, present, velocities=velocities if told else None, times=times))


@settings(max_examples=40, deadline=None)
@given(st.integers(2, 8), st.integers(0, 9999))
def test_elements_and_nodes_in_any_order(elements: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    inputs = rearranged(everything(elements, seed), rng.permutation(elements), rng.random(elements) < 0.5)
    order = rng.permutation(elements + 1)
    positions, velocities, _ = journey(elements, 12, seed)
    expect_same(both(renumbered(inputs, order), positions[:, order], velocities=velocities[:, order]))


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 9999), st.data(), st.sampled_from(TENSIONS))
def test_any_choice_of_stages(seed: int, data: st.DataObject, tension: Tension) -> None:
    inputs = everything(5, seed)
    names = data.draw(st.sets(st.sampled_from([field.name for field in fields(Extras)]), min_size=1))
    extras = Extras(**{name: getattr(inputs.extras, name) for name in names})
    inputs = replace(inputs, extras=extras, curves=(PULLING,), tension=tension)
    positions, _, times = journey(5, 12, seed)
    expect_same(both(inputs, positions, times=times))


@settings(max_examples=60, deadline=None)
@given(st.integers(1, 4), st.integers(0, 999), st.tuples(sizes, sizes, sizes), sizes, st.sampled_from(FLOORS[:4]))
def test_sizes_beyond_reason_are_refused_alike(
    elements: int, seed: int, scale: tuple[float, float, float], speed: float, floor: Floor
) -> None:
    positions, velocities, _ = journey(elements, 4, seed)
    with np.errstate(over="ignore"):
        path, rates = np.clip(positions * scale, -1.7e308, 1.7e308), np.clip(velocities * speed, -1.7e308, 1.7e308)
    one, other = both(everything(elements, seed, floor), path, velocities=rates)
    assert isinstance(one, str) == isinstance(other, str)
    if isinstance(one, str):
        assert one == other


@given(st.integers(0, 9999))
@settings(max_examples=20, deadline=None)
def test_states_go_from_one_backend_to_the_other(seed: int) -> None:
    inputs = everything(6, seed)
    positions, velocities, _ = journey(6, 10, seed)
    models = [ContactModel(inputs, backend=backend) for backend in ("numpy", "fast")]
    state = models[0].initial_state()
    for number, (place, rate) in enumerate(zip(positions, velocities, strict=True)):
        (one, after), (other, second) = (contact.step(place, rate, state) for contact in models)
        assert same(one, other)
        for left, right in zip(remembered(after), remembered(second), strict=True):
            if left.dtype.kind == "f":
                assert agree(left, right, float(np.nanmax(np.abs(left), initial=0.0)))
            else:
                assert np.array_equal(left, right)
        state = (after, second)[number % 2]


def test_a_state_is_never_written_to() -> None:
    inputs = everything(6, 3)
    contact = ContactModel(inputs, backend="fast")
    positions, velocities, _ = journey(6, 8, 3)
    state = contact.initial_state()
    kept = []
    for place, rate in zip(positions, velocities, strict=True):
        _, state = contact.step(place, rate, state)
        kept.append((remembered(state), [array.copy() for array in remembered(state)]))
    for arrays, copies in kept:
        assert all(
            np.array_equal(now, then, equal_nan=now.dtype.kind == "f") for now, then in zip(arrays, copies, strict=True)
        )


def test_the_curve_law_to_the_last_bit() -> None:
    elements = 400
    inputs = everything(elements, 8)
    inputs = replace(inputs, law=np.full(elements, CURVE, np.int8), curve_index=np.zeros(elements, np.intp))
    inputs = replace(inputs, extras=Extras(lateral=inputs.extras.lateral))
    positions, _, _ = journey(elements, 20, 8)
    one, other = both(inputs, positions)
    assert isinstance(one, ContactResult)
    assert isinstance(other, ContactResult)
    for name in ("depth", "ratio", "force", "slope", "stiffness"):
        assert getattr(one, name).tobytes() == getattr(other, name).tobytes()


def test_a_force_that_overflows_only_on_the_way_is_mended() -> None:
    from mudline.curves import ForceCurve  # noqa: PLC0415 - of this test alone

    curve = ForceCurve([(0.0, -1.7e308), (2.5, 1.7e308)])
    inputs = replace(chain([CURVE], curves=(curve,), diameter=1.0), length=np.full(1, 1e-3))
    inputs = replace(inputs, extras=Extras(lateral=np.ones(1)))
    found = both(inputs, at_depths([[2.0, 2.0], [2.1, 2.1]]))
    expect_same(found)
    assert not isinstance(found[1], str)


def test_series_in_chunks(monkeypatch: pytest.MonkeyPatch) -> None:
    inputs = everything(7, 4)
    positions, _, times = journey(7, 30, 4)
    contact = ContactModel(inputs, backend="fast")
    whole = contact.evaluate(positions, times=times)
    monkeypatch.setattr("mudline.contact.model._CHUNK", 24)
    parts = list(contact.stream(positions, times=times))
    assert len(parts) == 10
    for start, part in parts:
        assert np.array_equal(part.reaction, whole.reaction[start : start + 3], equal_nan=True)
        assert np.array_equal(part.force, whole.force[start : start + 3], equal_nan=True)


@pytest.fixture
def plain(monkeypatch: pytest.MonkeyPatch) -> None:
    """The functions as they are before they are compiled."""
    for name, module in list(sys.modules.items()):
        if name.startswith("mudline.contact.compiled."):
            for key, value in list(vars(module).items()):
                if isinstance(getattr(value, "py_func", None), FunctionType):
                    monkeypatch.setattr(module, key, value.py_func)
    monkeypatch.setattr(runner, "walk", walk_for(1))


@pytest.mark.usefixtures("plain")
@pytest.mark.parametrize("seed", range(10))
def test_the_loops_mean_the_same_before_they_are_compiled(seed: int) -> None:
    inputs = everything(6, seed, FLOORS[seed % len(FLOORS)])
    positions, velocities, times = journey(6, 25, seed)
    given_rates = velocities if seed % 2 else None
    expect_same(both(inputs, positions, velocities=given_rates, times=times))
    present = np.arange(7) != seed % 7
    expect_same(
        both(replace(inputs, tension="cut", curves=(PULLING,)), positions, present, velocities=given_rates, times=times)
    )


@pytest.mark.usefixtures("plain")
def test_odd_lines_before_they_are_compiled() -> None:
    upright = np.zeros((3, 3, 3))
    upright[:, :, 0] = [-0.1, -0.2, -0.3]
    upright[1:, :, 2] = 0.2
    crowd = upright.copy()
    crowd[:, 1] = crowd[:, 0]
    rubbing = Extras(
        friction=friction(3, (0.0, 0.8), ellipse=True), lateral=np.full(2, 900.0), trench=trench(3, 0.1, 0.5, 1e3)
    )
    for positions in (upright, crowd):
        for floor in (None, PlanesFloor([[0.0, 0.0, 0.0]], [89.99999999999])):
            expect_same(both(replace(chain([LINEAR, NONE]), extras=rubbing, floor=floor), positions))
    wide = Smoothing(np.array([1.7e308, 5e-324]), np.array([False, True]))
    inputs = replace(chain([LINEAR, LINEAR]), extras=replace(rubbing, smoothing=wide))
    expect_same(both(inputs, upright))
    expect_same(both(replace(chain([LINEAR]), extras=Extras(suction=suction(bridge_law()))), at_depths([[0.1, 0.1]])))
    overflows = both(
        replace(chain([LINEAR]), extras=Extras(nodal=nodal([1e300, 1.0]), lateral=np.ones(1))),
        np.full((1, 2, 3), -1e10),
    )
    expect_same(overflows)
    assert "overflows" in str(overflows[1])


def test_tangents_are_those_of_numpy() -> None:
    inputs = everything(5, 2)
    positions, velocities, _ = journey(5, 2, 2)
    one, other = (
        contact.tangent(positions[0], velocities[0], contact.initial_state())
        for contact in (ContactModel(inputs, backend="numpy"), ContactModel(inputs, backend="fast"))
    )
    assert one.by_position.values.tobytes() == other.by_position.values.tobytes()


def test_the_backend_that_a_series_gets(monkeypatch: pytest.MonkeyPatch) -> None:
    assert choice.compiles("fast", 1)
    assert not choice.compiles("numpy", 10**9)
    assert not choice.compiles("auto", 10**7)
    assert choice.compiles("auto", 10**8)
    choice._loads.cache_clear()
    monkeypatch.setitem(sys.modules, "numba", None)
    try:
        assert not choice.compiles("auto", 10**8)
        with pytest.raises(ImportError):
            ContactModel(chain([LINEAR]), backend="fast")
    finally:
        choice._loads.cache_clear()


def test_a_backend_of_another_name() -> None:
    wrong: Backend = "cuda"  # type: ignore[assignment]  # on purpose
    with pytest.raises(ValueError, match="backend must be auto, numpy or fast, not 'cuda'"):
        ContactModel(chain([LINEAR]), backend=wrong)


def test_numpy_alone_does_not_load_numba() -> None:
    program = """if True:
        import sys, numpy as np
        from tests.contact.paths import journey
        from tests.contact.scenes import everything
        from mudline.contact import ContactModel
        positions, velocities, _ = journey(3, 4, 1)
        ContactModel(everything(3, 1)).evaluate(positions, velocities=velocities)
        print("numba" in sys.modules)"""
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "False"


def test_a_place_without_a_cache_compiles_anyway(monkeypatch: pytest.MonkeyPatch) -> None:
    options: list[bool] = []

    def njit(signatures: object, *, cache: bool = False, **_: object) -> object:
        options.append(cache)
        if cache:
            raise RuntimeError("cannot cache function: no locator available")
        return lambda function: (function, signatures)

    monkeypatch.setattr(numba, "njit", njit)
    found: object = jit.compiled(abs, (1.0,))
    assert options == [True, False]
    assert found == (abs, [(numba.float64,)])


def test_what_is_kept_of_an_edition() -> None:
    assert jit.edition() == jit.edition() > 0
    assert callable(kernel.walk)


def test_rows_of_smoothing_do_not_matter_to_curves() -> None:
    inputs = replace(
        chain([CURVE, LINEAR]),
        extras=Extras(smoothing=Smoothing(np.full(2, 0.01), np.zeros(2, np.bool_)), lateral=np.ones(2)),
    )
    expect_same(both(inputs, at_depths([[0.005, 0.005, -0.005], [-0.001, 0.002, 0.1]])))
    assert model(inputs, inputs.extras).plan.history
