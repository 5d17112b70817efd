"""Positions of frames and data sets, evaluated as they are given; curves and results drawn in axes of one's own."""

from __future__ import annotations

from typing import Any

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from matplotlib import pyplot as plt

import mudline
from tests.helpers.samples import SAMPLES

SCENE = mudline.read(SAMPLES / "scr-dynamic.keyxm").scene()
FILE = SAMPLES / "positions.csv"
READ = mudline.read_positions(FILE, SCENE)
FRAME = pd.read_csv(FILE)
ARRAY = xr.DataArray(
    READ.whole[:, READ.present],
    dims=("time", "node", "axis"),
    coords={"time": READ.time, "node": SCENE.node_ids[READ.present]},
)
GIVEN: dict[str, tuple[Any, dict[str, str] | None]] = {
    "frame": (FRAME, None),
    "indexed frame": (FRAME.set_index(["time", "node"]), None),
    "renamed frame": (FRAME.rename(columns={"x": "Z (m)"}), {"x": "Z (m)"}),
    "data array": (ARRAY, None),
    "data set": (xr.Dataset({"positions": ARRAY.transpose("node", "axis", "time")}), None),
}


@pytest.mark.parametrize("name", GIVEN)
def test_frames_and_data_sets_are_read_as_files_are(name: str) -> None:
    given, columns = GIVEN[name]
    found = mudline.read_positions(given, SCENE, columns=columns)
    assert np.array_equal(found.whole, READ.whole, equal_nan=True)
    assert np.array_equal(found.present, READ.present)
    assert found.time is not None
    assert found.timed
    assert READ.time is not None
    assert found.time.tolist() == READ.time.tolist()


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (FRAME.drop(columns="x"), "<DataFrame>.*no column x: it has time, node, y, z"),
        (FRAME.assign(node=99_999), "node 99999 is not defined in the deck"),
        (FRAME.assign(x=np.nan), "x holds nan, expected finite numbers"),
        (FRAME.assign(x="far"), "x holds .*, expected numbers"),
        (FRAME.iloc[:0], "no row"),
        (xr.Dataset({"other": ARRAY}), "no variable named positions, only other"),
        (ARRAY.isel(axis=slice(2)), r"positions has the shape \(8, 61, 2\)"),
    ],
)
def test_what_is_wrong_in_them_is_named(given: object, message: str) -> None:
    with pytest.raises(mudline.DeckError, match=message):
        mudline.read_positions(given, SCENE)


def test_a_heading_for_a_column_that_is_none() -> None:
    with pytest.raises(ValueError, match="columns: no column height; expected some of time, node, x"):
        mudline.read_positions(FRAME, SCENE, columns={"height": "x"})


def test_positions_are_evaluated_with_all_that_they_say() -> None:
    contact = SCENE.contact()
    found = contact.evaluate(READ)
    by_hand = contact.evaluate(READ.values, present=READ.present, times=READ.time)
    assert found.force.tobytes() == by_hand.force.tobytes()
    assert found.times is not None
    places = READ.whole.astype(np.float64)
    assert mudline.contact_warnings(SCENE, found, READ) == mudline.contact_warnings(SCENE, by_hand, places)
    rest = SCENE.rest_shape()
    assert contact.evaluate(rest).force.shape == SCENE.element_ids.shape


def test_curves_and_results_are_drawn_in_axes_that_are_given() -> None:
    _, axes = plt.subplots(1, 2)
    result = SCENE.contact().evaluate(READ)
    assert result.plot(ax=axes[0], panel="touchdown") is axes[0]
    for curve in SCENE.curves.values():
        assert curve.plot(axes[1]) is axes[1]
    assert axes[1].get_legend_handles_labels()[1] == list(SCENE.curves)
    with pytest.raises(ValueError, match="panel must be one of line, force"):
        result.plot(ax=axes[0], panel="loop")
    alone = mudline.ForceCurve([(0, 0), (1, 1)]).plot()
    assert "embedment ratio" in alone.get_xlabel()
    plt.close("all")


def test_notebooks_show_what_there_is() -> None:
    contact = SCENE.contact()
    assert "no element has a suction law" in contact.plan._repr_html_()
    assert "201 nodes, 200 elements" in contact._repr_html_()
    assert "<polyline" in SCENE.curves["Trench Clay"]._repr_html_()
    assert "Trench Clay" in SCENE.curves._repr_html_()
    assert "41, 42, 43" in SCENE.sets._repr_html_()
    assert "Water depth, density" in mudline.read(SAMPLES / "scr-touchdown.keyxm")._repr_html_()
