"""A normal law of a module of its own is evaluated, stepped and planned like the others.

It is hyperbolic, as the resistance of soft clay is often drawn, with the initial stiffness k:

    F = k z / (1 + z / z0),  dF/dz = k / (1 + z / z0)^2
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.model.contact import ContactInput, ContactModel, LawKind, laws
from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.laws import NormalLaw, Parameter, Value, known_laws, register
from mudline.model.contact.laws.linear import RIGID
from mudline.model.contact.laws.unloading import UNLOADING
from mudline.model.contact.seabed import SlopingSeabed
from tests.helpers.builders.contact import (
    LINEAR,
    NONE,
    at_depths,
    bridge_law,
    chain,
    friction,
    journey,
    law_of,
    on,
    suction,
)
from tests.model.contact.comparison import Scene, Sizes, compare

pytestmark = pytest.mark.slow

K, Z0 = 5e4, 0.04
HELD = {"stiffness": K, "reference": Z0}


def hyperbolic_reaction(z: Value, _diameter: Value, stiffness: Value, reference: Value) -> tuple[Value, Value]:
    """Return F and dF/dz."""
    share = 1.0 / (1.0 + z / reference)
    return stiffness * z * share, stiffness * share * share


def hyperbolic_steepest(_z: Value, _diameter: Value, stiffness: Value, _reference: Value) -> Value:
    """Return k, the stiffness at the mudline."""
    return stiffness


HYPERBOLIC = register(
    NormalLaw(
        name="hyperbolic",
        summary="hyperbolic resistance",
        acts_on="elements",
        parameters=(
            Parameter("stiffness", "F/L2", "initial stiffness k"),
            Parameter("reference", "L", "penetration z0 at which half of the largest force acts", above=True),
        ),
        reaction=hyperbolic_reaction,
        steepest=hyperbolic_steepest,
        equation="F = k z / (1 + z / z0)",
        source="Duncan and Chang (1970), in the form of a p-y curve",
    )
)


@pytest.fixture(autouse=True)
def _laws(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Laws that a test registers are gone behind it."""
    with monkeypatch.context() as patch:
        patch.setattr(laws, "_LAWS", dict(laws._LAWS))
        yield


def force(z: FloatArray | float) -> FloatArray:
    return np.asarray(np.where(np.asarray(z) > 0.0, K * np.asarray(z) / (1.0 + np.asarray(z) / Z0), 0.0))


def test_it_gives_its_force_and_stiffness() -> None:
    contact = ContactModel(chain([NONE, LINEAR], on("hyperbolic", [0], **HELD)))
    assert contact.input.law.tolist() == [LawKind.OTHER, LawKind.LINEAR]
    depths = [-0.01, 0.0, 0.01, 0.04, 0.12, 1e9]
    result = contact.evaluate(at_depths([[depth] * 3 for depth in depths]))
    assert result.force[:, 0] == pytest.approx([0.0, 0.0, 400.0, 1000.0, 1500.0, 2000.0])
    assert result.stiffness[:, 0] == pytest.approx([0.0, 0.0, 32000.0, 12500.0, 3125.0, 0.0], abs=1e-9)
    assert result.slope[:, 0] == pytest.approx(0.3 * result.stiffness[:, 0])
    assert result.normal_force[:, 0] == pytest.approx(result.force[:, 0])
    assert result.contact[:, 0].tolist() == [False, False, *[True] * 4]


def test_it_unloads_on_a_line() -> None:
    """At 0.04 m 1000 N/m; the line is as stiff as the law at the mudline, or as it was told."""
    soft = ContactModel(chain([NONE], on("hyperbolic", 1, **HELD), on("unloading", 1, stiffness=100.0)))
    steep = ContactModel(chain([NONE], on("hyperbolic", 1, **HELD), on("unloading", 1, stiffness=2e5)))
    depths = at_depths([[0.04] * 2, [0.03] * 2, [0.02] * 2, [0.12] * 2, [0.1] * 2])
    assert soft.evaluate(depths).force.ravel() == pytest.approx([1000.0, 500.0, 0.0, 1500.0, 500.0], abs=1e-9)
    assert soft.evaluate(depths).stiffness.ravel() == pytest.approx([12500.0, K, 0.0, 3125.0, K])
    steeper = steep.evaluate(at_depths([[0.04] * 2, [0.0375] * 2, [0.035] * 2]))
    assert steeper.force.ravel() == pytest.approx([1000.0, 500.0, 0.0], abs=1e-9)


def everything_beside(elements: int, seabed: SlopingSeabed | None = None) -> ContactInput:
    """The law on every other element, and unloading, suction and friction beside it."""
    rows, every = np.arange(0, elements, 2), range(elements)
    rng = np.random.default_rng(elements)
    return chain(
        [NONE if row % 2 == 0 else LINEAR for row in every],
        on("hyperbolic", rows, stiffness=rng.uniform(1e4, 9e4, len(rows)), reference=rng.uniform(0.01, 0.1, len(rows))),
        on("unloading", list(every)[::3], stiffness=3e4),
        suction(bridge_law(elements), list(every)),
        friction(elements + 1),
        seabed=seabed,
    )


@given(st.integers(2, 12), st.integers(0, 9999), st.booleans())
def test_both_drivers_give_the_same_bits(elements: int, seed: int, slopes: bool) -> None:
    positions, velocities, _ = journey(elements, 12, seed)
    inputs = everything_beside(elements, SlopingSeabed(0.2, 30.0) if slopes else None)
    scene = Scene(inputs, positions, velocities, None, None, Sizes(8, 5, 2))
    assert compare(scene, plain=True) == []


@pytest.mark.compiled
def test_its_loops_are_compiled() -> None:
    """Alone: with more laws that takes seconds."""
    inputs = chain([NONE, LINEAR, NONE], on("hyperbolic", [0, 2], stiffness=[K, 2e4], reference=Z0))
    assert compare(Scene(inputs, journey(3, 12, 1)[0], None, None, None, Sizes(8, 5, 2))) == []


# ----------------------------------------------------------------------------------------------------- laws that differ


def plain_law(name: str, reaction: object = None, **changes: object) -> NormalLaw:
    """A law F = k z of its own name."""

    def linear(z: Value, _diameter: Value, stiffness: Value) -> tuple[Value, Value]:
        return stiffness * z, stiffness

    def steepest(_z: Value, _diameter: Value, stiffness: Value) -> Value:
        return stiffness

    given_law = NormalLaw(
        name=name, summary="of a test", acts_on="elements", parameters=(Parameter("stiffness", "F/L2", "k"),),
        reaction=reaction or linear, steepest=steepest,  # type: ignore[arg-type]  # any function
    )  # fmt: skip
    return replace(given_law, **changes)  # type: ignore[arg-type]  # fields of any type


def test_a_law_of_nodes() -> None:
    def reaction(z: Value, _diameter: Value, stiffness: Value, hump: Value) -> tuple[Value, Value]:
        return stiffness * (z - hump), stiffness

    register(
        plain_law(
            "shifted spring",
            reaction,
            acts_on="nodes",
            parameters=(Parameter("stiffness", "F/L", "k"), Parameter("hump", "L", "of contact")),
            onset=lambda _stiffness, hump: hump,
            steepest=lambda _z, _diameter, stiffness, _hump: stiffness,
        )
    )
    inputs = chain([NONE] * 2, on("shifted spring", [0, 2], stiffness=[1e4, 2e4], hump=[0.0, 0.01]), friction(3))
    contact = ContactModel(inputs)
    assert contact.plan["normal law"].why.startswith("2 nodes with the law 'shifted spring'")
    result = contact.evaluate(at_depths([[0.02] * 3, [0.01] * 3, [-0.1] * 3]))
    assert result.normal_force == pytest.approx(np.array([[200.0, 0.0, 200.0], [100.0, 0.0, 0.0], [0.0] * 3]))
    assert law_of(contact.stiffest(), "shifted spring").stiffness.tolist() == [1e4, 2e4]
    assert law_of(contact.stiffest(), "shifted spring").per == "node"
    tangent = contact.tangent(at_depths([0.02] * 3), None, contact.initial_state()).by_position.dense()
    assert np.diag(tangent)[::3].tolist() == [-1e4, 0.0, -2e4]
    positions, velocities, _ = journey(2, 10, 3)
    scene = Scene(inputs, positions, velocities, None, None, Sizes(8, 5, 1))
    assert compare(scene, plain=True) == []


def test_a_law_with_many_parameters_runs_with_numpy_and_the_plan_says_so() -> None:
    names = [f"k{number}" for number in range(10)]

    def sum_of(z: Value, _diameter: Value, *springs: Value) -> tuple[Value, Value]:
        return sum(springs) * z, sum(springs)

    def steepest(_z: Value, _diameter: Value, *springs: Value) -> Value:
        return sum(springs)

    parameters = tuple(Parameter(name, "F/L2", "a spring") for name in names)
    register(plain_law("ten springs", sum_of, parameters=parameters, steepest=steepest))
    inputs = chain([NONE], on("ten springs", 1, **dict.fromkeys(names, 1000.0)))
    contact = ContactModel(inputs, backend="fast")
    why = contact.plan["normal law"].why
    assert why.endswith("evaluated with numpy: the law 'ten springs' has more than 9 parameters")
    assert contact._driver(10**9) is None
    assert contact.evaluate(at_depths([0.01, 0.01])).force.tolist() == [100.0]


def with_an_object(_z: Value, _diameter: Value, stiffness: Value) -> tuple[Value, Value]:
    factor = SimpleNamespace(factor=1.0).factor  # numba knows no such objects
    return factor * stiffness * _z, factor * stiffness


@pytest.mark.compiled
def test_a_law_that_cannot_be_compiled_warns_once_and_is_evaluated_with_numpy() -> None:
    register(plain_law("of Python", with_an_object))
    contact = ContactModel(chain([NONE], on("of Python", 1, stiffness=1e4)), backend="fast")
    with pytest.warns(RuntimeWarning, match="the laws cannot be compiled and are evaluated with numpy: ") as told:
        result = contact.evaluate(at_depths([[0.01] * 2, [0.02] * 2]))
    assert len(told) == 1
    assert result.force.ravel() == pytest.approx([100.0, 200.0])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        again = contact.evaluate(at_depths([[0.01] * 2, [0.02] * 2]))
        single, _ = contact.step(at_depths([0.02] * 2), None, contact.initial_state())
    assert again.force.ravel() == pytest.approx([100.0, 200.0])
    assert single.force == pytest.approx([200.0])


@pytest.mark.parametrize(
    "law",
    [
        RIGID,
        UNLOADING,
        NormalLaw(
            name="without a reaction", summary="", acts_on="elements", parameters=(), steepest=hyperbolic_steepest
        ),
        NormalLaw(
            name="without a steepest slope", summary="", acts_on="elements", parameters=(), reaction=hyperbolic_reaction
        ),
        replace(HYPERBOLIC, name="with history", history=True),
        replace(HYPERBOLIC, name="with tables", tables=True),
    ],
    ids=lambda law: law.name,
)
def test_only_normal_laws_without_history_can_be_added(law: NormalLaw) -> None:
    with pytest.raises(TypeError, match="only normal laws without history can be added"):
        register(law)
    assert law.name not in set(known_laws()) - {"rigid", "unloading"}


def test_a_name_is_given_once() -> None:
    with pytest.raises(ValueError, match="contact law 'hyperbolic' is already registered"):
        register(plain_law("hyperbolic"))
    with pytest.raises(ValueError, match="contact law 'linear' is already registered"):
        register(plain_law("linear"))
