"""The scenes of the pruning study: tiling, forced laws, seabeds, positions, bare numpy."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mudline.contact import ContactInput, ContactModel
from mudline.contact.seabed import Seabed
from mudline.curves import ForceCurve
from mudline.study import sample_scene
from mudline.study.pruning import scenes
from mudline.study.pruning.cost import bare_evaluation
from mudline.study.pruning.scenes import (
    AS_IT_IS,
    CURVE,
    EVERYTHING,
    Pipe,
    Variant,
    line,
    pipe_of,
    positions,
    series,
    tiled,
    variants,
)
from tests.builders.contact import CLAY, everything, only

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


@settings(deadline=None, max_examples=30)
@given(st.integers(2, 60), st.integers(1, 12), st.integers(0, 5))
def test_tiled_elements_keep_their_laws(nodes: int, own: int, seed: int) -> None:
    inputs = everything(own, seed)
    made = tiled(inputs, nodes)
    assert len(made.node_ids) == nodes
    result, before = ContactModel(made).evaluate(), ContactModel(inputs).evaluate()
    if nodes - 1 == own:
        assert np.array_equal(result.reaction, before.reaction)
    elif nodes - 1 > own:
        # the last element of a copy ends at the beginning of the next one
        inner = np.arange(nodes - 1) % own != own - 1
        assert np.array_equal(result.force[inner], before.force[np.arange(nodes - 1) % own][inner])
    assert set(made.length) <= set(inputs.length)


def test_every_copy_has_the_parameters_of_its_origin() -> None:
    inputs, copies = everything(12, 3), 3
    made = tiled(inputs, 12 * copies + 1)
    assert set(made.assigned) == set(inputs.assigned)
    for name, law in made.assigned.items():
        last = 12 * copies if law.law.acts_on == "nodes" else -1
        origin = np.where(law.rows == last, 12, law.rows % 12)
        for parameter, values in law.parameters.items():
            own = inputs.assigned[name].spread(parameter, 13)
            assert np.array_equal(values, own[origin], equal_nan=True)
    assert made.weight is not None
    assert inputs.weight is not None
    assert np.array_equal(made.weight, np.tile(inputs.weight, copies))


def test_tiling_needs_a_line() -> None:
    inputs = everything(3, 1)
    with pytest.raises(ValueError, match="two nodes"):
        tiled(inputs, 1)
    none = line(PIPE, 1)
    with pytest.raises(ValueError, match="an element"):
        tiled(none, 10)


def test_tiling_of_a_scene_without_history() -> None:
    model = ContactModel(tiled(only(everything(5, 2), "curve", "linear", "smoothed"), 17))
    assert not model.plan.history
    assert model.evaluate().contact.any()


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


def test_bare_numpy_gives_what_the_evaluator_gives() -> None:
    inputs: ContactInput = line(PIPE, 50)
    points = positions(found()[CURVE], inputs, PIPE)
    result = ContactModel(inputs).evaluate(points)
    names = ("gap", "depth", "ratio", "contact", "force", "slope", "stiffness", "normal_force", "reaction")
    for name, mine in zip(names, bare_evaluation(inputs, points), strict=True):
        assert mine == pytest.approx(getattr(result, name), rel=1e-13)


@pytest.mark.parametrize("seabed", [scenes.planes(5, 100.0), scenes.profile(20, 100.0), scenes.scattered(30, 100.0)])
def test_seabeds_are_there_all_along_the_line(seabed: Seabed) -> None:
    level = seabed.elevation(np.linspace(0.0, 100.0, 50), np.zeros(50))
    assert np.isfinite(level).all()
    assert np.ptp(level) > 0.0


def test_each_plane_of_a_valley_counts_somewhere() -> None:
    level = scenes.planes(4, 90.0).elevation(np.linspace(-30.0, 200.0, 2000), np.zeros(2000))
    assert len(set(np.round(np.diff(level), 9))) >= 2
    assert scenes.planes(1, 10.0).same_normal is not None
