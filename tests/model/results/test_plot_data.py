"""What is kept of results for a picture: the same from parts as from a whole result, and as numpy computes it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

from mudline.model.contact import ContactResult
from mudline.model.contact.result import ResultPart
from mudline.model.results.plot_data import PlotData
from mudline.model.scene.model import resolve
from mudline.model.scene.positions import read_positions
from tests.helpers.samples import SAMPLES, sample


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


def in_parts(result: ContactResult, size: int) -> Iterator[ResultPart]:
    for start in range(0, len(result.depth), size):
        yield ResultPart(start, result.steps(start, min(start + size, len(result.depth))))


def test_parts_give_what_the_whole_gives(cycle: ContactResult) -> None:
    whole = PlotData.of_result(cycle, [1, 3])
    data = PlotData(cycle.known, cycle.evaluated, len(cycle.depth), cycle.times, elements=[1, 3])
    for part in in_parts(cycle, 13):
        data.take(part)
    assert set(whole.largest) == {"reaction", "pull"}
    assert [data.largest[name].step for name in whole.largest] == [one.step for one in whole.largest.values()]
    assert np.array_equal(data.reaction.largest, whole.reaction.largest, equal_nan=True)
    assert np.array_equal(data.loop(1).force, whole.loop(1).force)
    for extremes, values in ((data.force, cycle.force), (data.depth, cycle.depth)):
        assert np.array_equal(extremes.least.values, np.fmin.reduce(values), equal_nan=True)
        assert np.array_equal(extremes.largest.values, np.fmax.reduce(values), equal_nan=True)


def test_a_long_series_keeps_its_extremes_in_bins(cycle: ContactResult) -> None:
    many = 5000
    short = len(cycle.depth)
    data = PlotData(cycle.known, cycle.evaluated, many, np.arange(many, dtype=np.float64), elements=[1])
    for start in range(0, many - short, short):
        data.take(ResultPart(start, cycle))
    reaction = cycle.normal_force.sum(axis=1)
    assert len(data.bin_times) == 2000
    assert np.nanmax(data.reaction.largest) == reaction.max()
    assert np.nanmin(data.reaction.least) == reaction.min()
    assert len(data.points().ratio) <= 4100


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
