"""The resting shape of decks: worked numbers, balance, where lines stand, and what is refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import mudline
from mudline.model.contact.touchdown import line_summaries
from mudline.model.results.evaluation import evaluate_scene
from mudline.model.results.plot_data import PlotData
from mudline.model.scene.model import Scene
from mudline.tools.touchdown_study.rest_shape import RestShape, rest_shape
from tests.helpers.samples import SAMPLES
from tests.tools.touchdown_study.decks import BUOYS, CHAIN, FLEXIBLE, STEEL, Riser

OFFSET = "*OFFSET\n VESSEL=Semi\n OFFSET=0.0, -10.0, 2.0\n"
FLUID = "*INTERNAL FLUID\n SET=ALL\n 600.0, 900.0\n"
PLANES = (
    "*SEABED PLANES\n PLANE=A\n POINT=0.0, 0.0, 0.0\n SLOPE=0.0\n BOUNDS=-100.0, 200.0, -50.0, 50.0\n"
    " PLANE=B\n POINT=0.0, 200.0, 0.0\n SLOPE=3.0\n BOUNDS=200.0, 900.0, -50.0, 50.0\n"
)
SLOPE = "*SEABED PROFILE\n TYPE=SLOPING\n SLOPE={}\n DIRECTION=0.0\n"


def scene_of(text: str, units: str = "metric") -> Scene:
    return mudline.from_keyword(text, units=units).scene()._resolved


def shape_of(riser: Riser, units: str = "metric") -> tuple[Scene, RestShape]:
    scene = scene_of(riser.text(), units)
    return scene, rest_shape(scene)


@pytest.mark.parametrize(
    ("name", "tension", "lying"), [("scr-dynamic.keyxm", 244715.0, 315.692), ("scr-vessel.keyxm", 372236.0, 373.584)]
)
def test_worked_numbers(name: str, tension: float, lying: float) -> None:
    scene = mudline.read(SAMPLES / name).scene()
    (line,) = rest_shape(scene._resolved).lines
    assert line.catenary is not None
    assert line.catenary.tension == pytest.approx(tension, rel=1e-3)
    assert line.catenary.lying[-1][1] == pytest.approx(lying, rel=1e-3)
    positions = scene.rest_shape()
    assert positions.present.all()
    summary = line_summaries(scene.contact().evaluate(positions.whole[0]))[0]
    assert summary.reaction == pytest.approx(line.model.weight_to(lying), rel=0.01)
    assert summary.touchdown[0].arc_length == pytest.approx(lying, abs=2.0)


def test_the_seabed_carries_what_lies() -> None:
    scene, found = shape_of(Riser(section=CHAIN))
    result = scene.contact().evaluate(found.positions.whole[0])
    summary = line_summaries(result)[0]
    assert summary.ratio == pytest.approx(1.0, abs=0.005)


def test_each_element_on_the_seabed_has_the_weight_of_its_own_section() -> None:
    """The wall changes on the seabed, where the bent part of the pipe begins: its middle has the heavy section."""
    light = STEEL.replace("SET=ALL", "SET=Light").replace("0.2827", "0.2890").removeprefix(" OPTION=RIGID\n")
    sets = "*ELEMENT SETS\n SET=Light\n GEN=1, 60\n SET=Heavy\n GEN=61, 250\n"
    scene, found = shape_of(Riser(section=STEEL.replace("SET=ALL", "SET=Heavy") + light, sets=sets))
    result = scene.contact().evaluate(found.positions.whole[0])
    assert result.force[:52] == pytest.approx(scene.submerged_weight[:52], rel=0.01)


def test_the_top_stands_where_the_deck_and_its_vessel_put_it() -> None:
    riser = Riser(along=(0.6, 0.8), loads=OFFSET + Riser().loads)
    _, found = shape_of(riser)
    ends = found.positions.whole[0][[0, -1]]
    assert ends[1] == pytest.approx([500.0, 0.6 * 740.0 - 10.0, 0.8 * 740.0 + 2.0])
    assert ends[0][1:] == pytest.approx([0.0, 0.0])
    across = found.positions.whole[0][:, 1:] @ np.array([ends[1][2], -ends[1][1]])
    assert across == pytest.approx(0.0, abs=1e-6)


def test_contents_weigh() -> None:
    (plain,), (full,) = shape_of(Riser())[1].lines, shape_of(Riser(loads=FLUID + Riser().loads))[1].lines
    assert plain.catenary is not None
    assert full.catenary is not None
    inside = 900.0 * 9.81 * np.pi / 4.0 * 0.2827**2
    assert full.model.weights[0] - plain.model.weights[0] == pytest.approx(inside)
    assert full.catenary.tension / plain.catenary.tension == pytest.approx(
        full.model.weights[0] / plain.model.weights[0]
    )


@pytest.mark.parametrize("slope", [5.0, -3.0])
def test_along_a_slope(slope: float) -> None:
    scene, found = shape_of(Riser(slope=slope, model=SLOPE.format(slope)))
    result = scene.contact().evaluate(found.positions.whole[0])
    lying = result.depth[: len(result.depth) // 8]
    assert (lying[1:] > 0.0).all()
    (line,) = found.lines
    assert line.catenary is not None
    carried = line.model.weight_to(line.catenary.lying[-1][1]) * np.cos(np.radians(slope))
    assert result.normal_force.sum() == pytest.approx(carried, rel=0.02)


def test_a_lazy_wave() -> None:
    riser = Riser(300.0, 760.0, 1000.0, 420.0, section=FLEXIBLE.format(buoyancy=0.78), sets=BUOYS)
    scene, found = shape_of(riser)
    height = found.positions.whole[0][:, 0]
    assert (np.diff(np.sign(np.diff(height[120:]))) != 0).sum() == 2
    assert line_summaries(scene.contact().evaluate(found.positions.whole[0]))[0].ratio == pytest.approx(1.0, abs=0.02)


@pytest.mark.parametrize(
    ("riser", "words"),
    [
        (Riser(held=False), "no held end at the seabed: nothing in \\*BOUNDARY holds node 1, the lower end"),
        (Riser(loads="*OFFSET\n VESSEL=Semi\n OFFSET=0.0, 300.0\n"), "the line is taut"),
        (Riser(loads="*OFFSET\n VESSEL=Semi\n OFFSET=0.0, 115.0\n"), "hangs free of the seabed"),
        (Riser(loads="*OFFSET\n VESSEL=Semi\n OFFSET=0.0, -400.0\n"), "the line is slack"),
        (Riser(section=" OPTION=RIGID\n SET=ALL\n 2.0E11, 8.0E10, 0.9, 0.89, 7850.0\n"), "the pipe floats"),
        (Riser(model=PLANES), "not one plane"),
    ],
)
def test_what_has_no_resting_shape_is_refused(riser: Riser, words: str) -> None:
    with pytest.raises(mudline.DeckError, match=words):
        mudline.from_keyword(riser.text(), units="metric").scene().rest_shape()


@pytest.mark.slow
@pytest.mark.alike
@pytest.mark.parametrize("is_moved", [False, True])
def test_moordyn_with_bending_touches_down_at_the_same_place(tmp_path: Path, *, is_moved: bool) -> None:
    """Also with the top moved by 2.5 m: the touchdown travels as far."""
    pytest.importorskip("moordyn", reason="MoorDyn's Python package is not installed")
    from tests.tools.exporting.at_rest import run  # noqa: PLC0415 - needs MoorDyn
    from tests.tools.exporting.decks import sample  # noqa: PLC0415 - as above

    model = sample("imperial-riser.keyxi")

    def touchdown(seconds: float, moved: float) -> float:
        places = np.array(run(model, tmp_path, 100.0, seconds=seconds, moved=moved)["lines"][0]["places"])
        clearance = places[:, 2] + model.depth
        last = np.flatnonzero(clearance < 0.0)[-1]
        return float(np.interp(0.0, clearance[last : last + 2], places[last : last + 2, 0]))

    shape = rest_shape(model.scene)
    theirs = touchdown(5.0, 0.0)
    result = model.scene.contact().evaluate(shape.positions.whole[0])
    ours = line_summaries(result)[0].touchdown[0].y * model.units.length
    assert ours == pytest.approx(theirs, abs=1.0)
    if is_moved:
        (line,) = shape.lines
        moved = line.moved(2.5 / model.units.length, 0.0)
        assert line.catenary is not None
        travel = (moved.lying[-1][1] - line.catenary.lying[-1][1]) * model.units.length
        assert travel == pytest.approx(touchdown(60.0, 2.5) - theirs, rel=0.15)


def test_the_picture_of_the_model_has_the_shape_that_is_evaluated() -> None:
    plots = pytest.importorskip("mudline.model.results.plots", reason="matplotlib is not installed")
    scene, shape = shape_of(Riser())
    evaluation = evaluate_scene(scene, shape.positions)
    (part,) = evaluation.parts()
    data = PlotData.of_evaluation(evaluation)
    data.take(part)
    line = plots.model_figure(scene, data).axes[0].lines[0].get_xydata()
    drawn = np.unique(line[np.isfinite(line).all(axis=1)], axis=0)
    given = np.asarray(part.result.step(0).positions)
    assert len(drawn) == len(given)
    assert np.allclose(np.sort(drawn[:, 1]), np.sort(given[:, 0]), rtol=0.0, atol=1e-9)
    assert not np.allclose(np.sort(drawn[:, 1]), np.sort(scene.coordinates[:, 0]), rtol=0.0, atol=0.1)
