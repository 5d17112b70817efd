"""What is kept of results for a picture: the same from parts as from a whole result, and as numpy computes it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

import mudline
from mudline.contact import ContactResult
from mudline.contact.result import Part
from mudline.contact.touchdown import line_summaries
from mudline.results.panels import PANELS, PanelError, panel_names, require, usual
from mudline.results.plot_data import PlotData
from mudline.scene.model import resolve
from mudline.scene.positions import read_positions
from tests.samples import SAMPLES, sample


def series(name: str, positions: str) -> ContactResult:
    scene = resolve(sample(name))
    given = read_positions(SAMPLES / positions, scene.nodes)
    assert given.time is not None
    return scene.contact().evaluate(given.whole, present=given.present, times=given.time)


@pytest.fixture(scope="module")
def heave() -> ContactResult:
    return series("scr-touchdown.keyxm", "positions.csv")


@pytest.fixture(scope="module")
def cycle() -> ContactResult:
    return series("full-cycle.keyxm", "full-cycle.csv")


def in_parts(result: ContactResult, size: int) -> Iterator[Part]:
    for start in range(0, len(result.depth), size):
        yield Part(start, result.steps(start, min(start + size, len(result.depth))))


def test_parts_give_what_the_whole_gives(cycle: ContactResult) -> None:
    whole = PlotData.of_result(cycle, [1, 3], frames=7)
    data = PlotData(
        cycle.known, cycle.evaluated, cycle.present, len(cycle.depth), cycle.times, elements=[1, 3], frames=7
    )
    for part in in_parts(cycle, 13):
        data.take(part)
    for one, other in ((data.chosen, whole.chosen), (data.pulled, whole.pulled)):
        assert one is not None
        assert other is not None
        assert one.step == other.step
    for name, band in data.traces.items():
        assert np.array_equal(band.most, whole.traces[name].most, equal_nan=True)
    assert np.allclose(data.force.mean, whole.force.mean)
    assert np.array_equal(data.loop.force, whole.loop.force)
    assert [frame.step for frame in data.frames] == [frame.step for frame in whole.frames]
    assert len(data.frames) == 7


def test_envelopes_and_the_steps_are_those_of_the_arrays(cycle: ContactResult) -> None:
    data = PlotData.of_result(cycle)
    assert np.array_equal(data.force.least, cycle.force.min(axis=0))
    assert np.array_equal(data.depth.most, cycle.depth.max(axis=0))
    assert np.allclose(data.depth.mean, cycle.depth.mean(axis=0))
    assert data.chosen is not None
    assert data.pulled is not None
    assert data.chosen.step == cycle.normal_force.sum(axis=1).argmax()
    assert data.pulled.step == cycle.force.min(axis=1).argmin()


def test_loops_have_every_step_of_the_elements(cycle: ContactResult) -> None:
    loop = PlotData.of_result(cycle, [3]).loop
    assert np.array_equal(loop.penetration[:, 0], cycle.depth[:, 2])
    assert loop.state is not None
    assert cycle.state is not None
    assert np.array_equal(loop.state[:, 0], cycle.state[:, 2])


def test_touchdown_is_that_of_the_lines(heave: ContactResult) -> None:
    data = PlotData.of_result(heave)
    wanted = [line.touchdown[0].arc_length for line in line_summaries(heave)]
    assert data.touchdown[0, "first"].most.tolist() == wanted


def test_a_long_series_keeps_its_extremes_in_bins(cycle: ContactResult) -> None:
    many = 5000
    short = len(cycle.depth)
    data = PlotData(cycle.known, cycle.evaluated, cycle.present, many, np.arange(many, dtype=np.float64), elements=[1])
    for start in range(0, many - short, short):
        data.take(Part(start, cycle))
    reaction = cycle.normal_force.sum(axis=1)
    assert len(data.bin_times) == 2000
    assert np.nanmax(data.traces["reaction"].most) == reaction.max()
    assert np.nanmin(data.traces["reaction"].least) == reaction.min()
    assert sum(len(points.ratio) for points in data.points) <= 4100


def test_an_animation_has_steps_at_even_distances(cycle: ContactResult) -> None:
    data = PlotData.of_result(cycle, frames=100)
    steps = [frame.step for frame in data.frames]
    assert (len(steps), steps[0], steps[-1]) == (100, 0, len(cycle.depth) - 1)
    assert set(np.diff(steps).tolist()) <= {2, 3}
    assert data.frames[40].force.tolist() == cycle.force[steps[40]].tolist()


def test_a_state_has_no_panels_over_time(heave: ContactResult) -> None:
    data = PlotData.of_result(heave.step(2))
    assert usual(data) == ("line", "force", "friction", "embedment", "stiffness", "curves")
    for name in ("traces", "touchdown", "envelope", "loop"):
        with pytest.raises(PanelError, match=f"the panel {name} cannot be drawn: it needs time steps, and this is one"):
            require(data, [name])


def test_a_series_has_what_it_has_laws_for(heave: ContactResult, cycle: ContactResult) -> None:
    data = PlotData.of_result(heave)
    assert usual(data) == ("line", "force", "friction", "embedment", "envelope", "curves", "touchdown", "traces")
    with pytest.raises(PanelError, match="suction cannot be drawn: no element has suction or a curve that pulls"):
        require(data, ["line", "suction"])
    data = PlotData.of_result(cycle, [2])
    assert {"suction", "loop"} <= set(usual(data))
    with pytest.raises(PanelError, match="neither friction nor a lateral spring"):
        require(data, ["friction"])
    with pytest.raises(PanelError, match="give --plot-elements"):
        require(PlotData.of_result(cycle), ["loop"])


def test_a_line_above_the_seabed_has_no_empty_panels() -> None:
    scene = mudline.read(SAMPLES / "scr-touchdown.keyxm").scene()
    high = scene.coordinates + np.array([[[100.0, 0.0, 0.0]], [[101.0, 0.0, 0.0]]])
    assert usual(PlotData.of_result(scene.contact().evaluate(high, times=[0.0, 1.0]))) == (
        "line",
        "embedment",
        "traces",
    )


def test_names_of_panels() -> None:
    assert panel_names(["traces", "line", "traces"]) == ("traces", "line")
    with pytest.raises(PanelError, match=f"no panel is called 'lines': the panels are {', '.join(PANELS)}"):
        panel_names(["line", "lines"])


@pytest.mark.parametrize(
    ("elements", "message"),
    [([1, 5, 6], "no evaluated element has the number 5, 6"), ([1, 2, 3, 4, 5, 6, 7], "no evaluated element")],
)
def test_elements_that_are_not_there(cycle: ContactResult, elements: list[int], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        PlotData.of_result(cycle, elements)


def test_more_elements_than_a_picture_holds(heave: ContactResult) -> None:
    every = heave.known.element_ids[heave.evaluated].tolist()
    with pytest.raises(ValueError, match="7 elements are too many to draw: give at most 6"):
        PlotData.of_result(heave, every[:7])
