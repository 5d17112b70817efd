"""Figures of results: which axes there are, that they share their ranges, and that what is drawn is the result."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("matplotlib")

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.lines import Line2D

import mudline
from mudline.model.contact import ContactInput, ContactModel, ContactResult, LawAssignment
from mudline.model.contact.touchdown import line_summaries
from mudline.model.results.plot_data import PlotData
from mudline.model.results.plots import evaluation_figure, panels_of
from mudline.model.results.plots.along_line import DrawnStretch
from mudline.model.scene.model import resolve
from mudline.model.scene.positions import read_positions
from tests.helpers.samples import SAMPLES


@cache
def result(name: str, positions: str) -> ContactResult:
    scene = resolve(mudline.read(SAMPLES / name))
    given = read_positions(SAMPLES / positions, scene.nodes)
    return scene.contact().evaluate(given.whole, present=given.present, times=given.time)


def heave() -> ContactResult:
    return result("scr-touchdown.keyxm", "positions.csv")


def cycle() -> ContactResult:
    return result("full-cycle.keyxm", "full-cycle.csv")


def raised() -> ContactResult:
    """A line far above the seabed, at two steps."""
    scene = mudline.read(SAMPLES / "scr-touchdown.keyxm").scene()
    high = scene.coordinates + np.array([[[100.0, 0.0, 0.0]], [[101.0, 0.0, 0.0]]])
    return scene.contact().evaluate(high, times=[0.0, 1.0])


def drawn(axes: Axes) -> list[Line2D]:
    """The curves with more than two points."""
    return [line for line in axes.get_lines() if len(np.asarray(line.get_xydata())) > 2]


def labels(figure: Figure) -> list[str]:
    return [axes.get_ylabel().replace("\n", " ") for axes in figure.axes]


def panel(data: PlotData, name: str) -> Axes:
    """One of the panels of some results, by itself."""
    axes = Figure().add_subplot()
    next(one for one in panels_of(data) if one.name == name).draw(axes, DrawnStretch(data))
    return axes


def names(data: PlotData) -> list[str]:
    return [one.name for one in panels_of(data)]


@pytest.mark.parametrize(
    ("data", "wanted"),
    [
        (lambda: PlotData.of_result(heave()), "line force friction curves touchdown reaction"),
        (lambda: PlotData.of_result(heave().step(2)), "line force friction embedment stiffness curves"),
        (lambda: PlotData.of_result(cycle()), "line force suction embedment curves reaction"),
        (lambda: PlotData.of_result(cycle(), [2, 1]), "line force suction loop loop reaction"),
        (lambda: PlotData.of_result(lines(1)), "line force embedment stiffness"),
        (lambda: PlotData.of_result(raised()), "line embedment reaction"),
        (lambda: PlotData.of_result(raised().step(0)), "line embedment"),
    ],
    ids=["series", "state", "suction", "loops", "linear", "above", "one state above"],
)
def test_a_picture_has_the_panels_that_there_is_something_to_show_in(data: Callable[[], PlotData], wanted: str) -> None:
    assert names(data()) == wanted.split()


def test_every_panel_has_a_label_with_a_unit() -> None:
    figure = evaluation_figure(PlotData.of_result(cycle()), "a doubt " * 20)
    assert labels(figure) == [
        "height X [m]",
        "seabed reaction per unit length [N/m]",
        "suction per unit length [N/m]",
        "embedment [m]",
        "seabed reaction per unit length [N/m]",
        "total reaction [N]",
    ]
    title = figure.get_suptitle().splitlines()
    assert title[1].endswith("when the total reaction is largest")
    assert title[2].startswith("a doubt a doubt")
    assert max(map(len, title)) <= 100
    loops = evaluation_figure(PlotData.of_result(cycle(), [2, 1]))
    shown = [axes.get_xlabel() for axes in loops.axes if "penetration" in axes.get_xlabel()]
    assert shown == ["penetration of element 2 [m]", "penetration of element 1 [m]"]


def test_what_is_drawn_is_the_result() -> None:
    state = heave().step(6)
    arcs, data = state.known.lines.element_arc, PlotData.of_result(state)
    for name, values in (("force", state.force), ("embedment", state.depth), ("stiffness", state.stiffness)):
        x, y = drawn(panel(data, name))[0].get_data()
        here = np.searchsorted(arcs, x)
        assert np.array_equal(arcs[here], x)
        assert np.array_equal(values[here], y)
        touching = np.flatnonzero(state.contact & state.evaluated)
        assert set(touching.tolist()) <= set(here.tolist())


def test_the_line_has_its_touchdown_point_and_lies_on_its_nodes() -> None:
    state = heave().step(0)
    axes = panel(PlotData.of_result(state), "line")
    point = line_summaries(state)[0].touchdown[0]
    marks = [line for line in axes.get_lines() if line.get_label() == "touchdown point"]
    assert np.asarray(marks[0].get_xydata()).tolist() == [[point.arc_length, point.x]]
    assert f"TDP {point.arc_length:.5g} m" in [text.get_text() for text in axes.texts]
    assert isinstance(axes.figure, Figure)
    axes.figure.draw_without_rendering()
    (legend,) = (child for child in axes.get_children() if isinstance(child, Legend))
    assert not any(text.get_window_extent().overlaps(legend.get_window_extent()) for text in axes.texts)
    assert state.positions is not None
    pipe = drawn(axes)[1]
    assert set(np.asarray(pipe.get_ydata()).tolist()) <= set(state.positions[state.present, 0].tolist())


def test_extents_and_touchdown_over_time_are_those_of_the_arrays() -> None:
    for found, name in ((heave(), "force"), (cycle(), "embedment")):
        values = found.force if name == "force" else found.depth
        axes = panel(PlotData.of_result(found), name)
        edges = {tuple(point) for point in np.asarray(axes.collections[0].get_paths()[0].vertices).tolist()}
        here = np.searchsorted(found.known.lines.element_arc, drawn(axes)[0].get_xdata())
        arcs = found.known.lines.element_arc[here]
        for side in (values[:, here].max(axis=0), values[:, here].min(axis=0)):
            assert set(zip(arcs.tolist(), side.tolist(), strict=True)) <= edges
    found = heave()
    times, touchdown = drawn(panel(PlotData.of_result(found), "touchdown"))[0].get_data()
    assert found.times is not None
    assert np.array_equal(times, found.times)
    assert np.asarray(touchdown).tolist() == [line.touchdown[0].arc_length for line in line_summaries(found)]


def test_a_loop_has_its_states_and_arrows() -> None:
    axes = panel(PlotData.of_result(cycle(), [2]), "loop")
    states = [line.get_label() for line in axes.get_lines() if not str(line.get_label()).startswith("_")]
    assert states == ["free", "compression", "suction", "hold", "broken"]
    assert axes.get_xlabel() == "penetration of element 2 [m]"
    assert len(axes.texts) >= 6, "arrows"
    places = {tuple(point) for line in axes.get_lines() for point in np.asarray(line.get_xydata()).tolist()}
    path = set(zip(cycle().depth[:, 1].tolist(), cycle().force[:, 1].tolist(), strict=True))
    assert path <= places


def lines(count: int, elements: int = 4) -> ContactResult:
    """Lines beside each other that rise from a linear seabed."""
    nodes = count * (elements + 1)
    coordinates = np.zeros((nodes, 3))
    for line in range(count):
        rows = slice(line * (elements + 1), (line + 1) * (elements + 1))
        coordinates[rows] = [
            [-0.1 + 0.2 * i / elements - 0.01 * line, 5.0 * i, 20.0 * line] for i in range(elements + 1)
        ]
    first = np.concatenate([np.arange(elements) + line * (elements + 1) for line in range(count)])
    size = len(first)
    law = LawAssignment("linear", np.arange(size), {"stiffness": 1e4})
    return ContactModel(
        ContactInput(
            np.arange(1, nodes + 1),
            coordinates,
            np.arange(1, size + 1),
            np.column_stack([first, first + 1]),
            np.full(size, 5.0),
            np.full(size, 0.5),
            (law,),
        )
    ).evaluate()


def test_four_elements_are_marked_and_a_long_line_is_thinned() -> None:
    short = drawn(panel(PlotData.of_result(lines(1)), "force"))[0]
    assert short.get_marker() == "o"
    level = lines(1, 9000)
    waves = np.array(level.known.coordinates)
    waves[:, 0] = 0.1 * np.sin(0.7 * np.arange(len(waves)))  # contact changes everywhere
    long = drawn(panel(PlotData.of_result(ContactModel(level.known).evaluate(waves)), "embedment"))[0]
    assert str(long.get_marker()) in {"", "None"}
    assert len(np.asarray(long.get_xydata())) <= 4002


def test_panels_along_the_line_show_where_contact_changes() -> None:
    flat = np.full(100, -0.1)
    rise = -0.1 + 0.005 * np.arange(1, 60) ** 2
    given = lines(1, 158).known
    positions = np.array(given.coordinates)
    positions[:, 0] = np.concatenate([flat, rise])
    data = PlotData.of_result(ContactModel(given).evaluate(positions))
    stretch = DrawnStretch(data)
    low, high = stretch.limits  # 500 m lie on the seabed; the depth of element 100 is the first that differs
    assert 470.0 < low < 495.0
    assert 515.0 < high < 545.0
    assert stretch.beyond == f"where contact changes: 0 to {low // 5 * 5:.5g} in contact, not drawn"
    figure = evaluation_figure(data)
    assert stretch.beyond in figure.get_suptitle()


@pytest.mark.parametrize("name", ["picture.png", "picture.svg", "picture.pdf"])
def test_a_result_draws_itself_the_same_each_time(tmp_path: Path, name: str) -> None:
    state = raised().step(0)
    state.plot(tmp_path / name)
    first = (tmp_path / name).read_bytes()
    state.plot(tmp_path / name)
    assert (tmp_path / name).read_bytes() == first
    assert b"/Type3" not in first


def test_a_result_refuses_what_it_cannot_draw(tmp_path: Path) -> None:
    state = heave().step(0)
    with pytest.raises(ValueError, match=r"unknown file format: give a name ending in \.png, \.svg or \.pdf"):
        state.plot(tmp_path / "picture.jpg")
    with pytest.raises(ValueError, match="force over penetration needs time steps, and this is one state"):
        state.plot(elements=[1])
    with pytest.raises(ValueError, match="no evaluated element has the number 1000"):
        heave().plot(elements=[1000])
    with pytest.raises(OSError, match="No such file"):
        state.plot(tmp_path / "nowhere" / "picture.png")
    assert not list(tmp_path.iterdir())


# ------------------------------------------------------------------------------------------------------------ scales
