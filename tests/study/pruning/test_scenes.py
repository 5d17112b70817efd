"""The scenes of the pruning study: tiling, forced laws, seabeds, positions, bare numpy."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mudline.contact import ContactModel
from mudline.contact.seabed import Seabed
from mudline.curves import ForceCurve
from mudline.study import sample_scene
from mudline.study.pruning import scenes
from mudline.study.pruning.plain import Plain
from mudline.study.pruning.scenes import (
    AS_IT_IS,
    CURVE,
    EVERYTHING,
    Pipe,
    Variant,
    copies_for,
    line,
    pipe_of,
    positions,
    repeated,
    series,
    variants,
    with_curve,
)
from tests.builders.contact import CLAY, everything

PIPE = Pipe(CLAY, 6.0e4, 0.3, 2.0)
STAGES = {
    CURVE: {"normal law", "assembly"},
    "linear law": {"normal law", "assembly"},
    "linear law, smoothing": {"normal law", "smoothing", "assembly"},
    "curve, nodal springs": {"normal law", "smoothing", "assembly"},
    "curve, unloading": {"normal law", "unloading", "assembly"},
    "curve, suction springs": {"normal law", "suction", "assembly"},
    "curve, suction": {"normal law", "suction", "assembly"},
    "curve, lateral springs": {"normal law", "lateral", "assembly"},
    "curve, friction": {"normal law", "friction", "assembly"},
    "curve, friction, trench": {"normal law", "friction", "trench", "assembly"},
    "curve, sloping bed": {"normal law", "assembly"},
    "curve, 2 planes": {"normal law", "assembly"},
    "curve, profile": {"normal law", "assembly"},
    "curve, scattered points": {"normal law", "assembly"},
    EVERYTHING: {"normal law", "smoothing", "unloading", "suction", "friction", "lateral", "trench", "assembly"},
}


def found() -> dict[str, Variant]:
    return {variant.name: variant for variant in variants(everything(20, 1), PIPE)}


def test_stages_are_on_as_named() -> None:
    named = found()
    assert list(named) == [AS_IT_IS, *STAGES]
    for name, stages in STAGES.items():
        plan = ContactModel(named[name].make(30)).plan
        assert {stage.stage for stage in plan if stage.active} - {"floor"} == stages, name


@pytest.mark.parametrize("name", STAGES)
def test_every_element_of_an_embedded_scene_touches_and_every_step_is_finite(name: str) -> None:
    variant = found()[name]
    inputs = variant.make(500)
    points = positions(variant, inputs, PIPE)
    model = ContactModel(inputs)
    assert model.evaluate(points).contact.all()
    moved = series(points, PIPE, 4)
    result = model.evaluate(moved, times=np.arange(4.0))
    assert np.isfinite(result.reaction).all()
    assert 0.2 < result.contact[1].mean() < 0.9
    assert np.array_equal(moved[3], points)


@settings(deadline=None, max_examples=20)
@given(st.integers(1, 4), st.integers(1, 12), st.integers(0, 5))
def test_repeated_decks_are_evaluated_as_one(copies: int, own: int, seed: int) -> None:
    inputs = everything(own, seed)
    order = np.random.default_rng(seed).permutation(own + 1)  # nodes in any order, as GEN= leaves them
    shuffled = replace(inputs, element_nodes=np.argsort(order)[inputs.element_nodes])
    made, alone = ContactModel(repeated(shuffled, copies)), ContactModel(shuffled)
    moved = shuffled.coordinates + np.array([0.0, 0.01, -0.02])
    whole = made.evaluate(
        np.stack([np.tile(at, (copies, 1)) for at in (shuffled.coordinates, moved)]), times=[0.0, 1.0]
    )
    single = alone.evaluate(np.stack([shuffled.coordinates, moved]), times=[0.0, 1.0])
    assert np.array_equal(whole.reaction, np.tile(single.reaction, (1, copies, 1)))
    assert np.array_equal(whole.force, np.tile(single.force, (1, copies)))


def test_every_copy_has_the_parameters_of_its_origin() -> None:
    inputs, copies = everything(12, 3), 3
    made = repeated(inputs, copies)
    assert set(made.assigned) == set(inputs.assigned)
    for name, law in made.assigned.items():
        count = 13 if law.law.acts_on == "nodes" else 12
        assert np.array_equal(law.rows % count, np.tile(inputs.assigned[name].rows, copies))
        for parameter, values in law.parameters.items():
            assert np.array_equal(values, np.tile(inputs.assigned[name][parameter], copies), equal_nan=True)
    assert made.weight is not None
    assert inputs.weight is not None
    assert np.array_equal(made.weight, np.tile(inputs.weight, copies))


def test_a_deck_is_repeated_to_about_so_many_nodes() -> None:
    inputs = everything(9, 1)
    assert [copies_for(inputs, nodes) for nodes in (2, 14, 16, 1000)] == [1, 1, 2, 100]


def test_the_pipe_is_that_of_the_deck() -> None:
    inputs = sample_scene().contact_input()
    pipe = pipe_of(inputs, CLAY)
    assert pipe.curve is inputs.curves[0]
    assert (pipe.diameter, pipe.length) == (0.3, 2.0)
    assert pipe.stiffness == pytest.approx(45000.0 / 0.3)
    bare = replace(line(PIPE, 3), laws=(), diameter=np.full(2, np.nan), length=np.zeros(2))
    usual = pipe_of(bare, CLAY)
    assert (usual.curve, usual.diameter, usual.length) == (CLAY, 0.3, 1.0)


def test_a_flat_curve_still_has_a_stiffness() -> None:
    flat = ForceCurve([(0.0, 1.0), (1.0, 1.0)])
    assert pipe_of(replace(line(PIPE, 3), curves=(flat,)), CLAY).stiffness == 1.0


def test_plain_numpy_gives_the_same_bits() -> None:
    deck = with_curve(repeated(sample_scene().contact_input(), 5), PIPE)
    branched = replace(deck, element_nodes=np.column_stack([np.zeros(50, int), np.arange(1, 51)]))
    for inputs in (line(PIPE, 50), deck, branched):
        plain, model = Plain.of(inputs), ContactModel(inputs)
        moved = series(positions(found()[CURVE], inputs, PIPE), PIPE, 4)
        assert plain.evaluate(moved[0]).equals(model.evaluate(moved[0]))
        result = model.evaluate(moved)
        assert not result.contact.all()
        assert plain.evaluate(moved).equals(result)
    assert not plain.unbranched
    assert not plain.evaluate(moved[:1]).equals(result.steps(1, 2))


@pytest.mark.parametrize("seabed", [scenes.planes(5, 100.0), scenes.profile(20, 100.0), scenes.scattered(30, 100.0)])
def test_seabeds_are_there_all_along_the_line(seabed: Seabed) -> None:
    level = seabed.elevation(np.linspace(0.0, 100.0, 50), np.zeros(50))
    assert np.isfinite(level).all()
    assert np.ptp(level) > 0.0


def test_each_plane_of_a_valley_counts_somewhere() -> None:
    level = scenes.planes(4, 90.0).elevation(np.linspace(-30.0, 200.0, 2000), np.zeros(2000))
    assert len(set(np.round(np.diff(level), 9))) >= 2
    assert scenes.planes(1, 10.0).same_normal is not None
