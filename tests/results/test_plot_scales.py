"""Scales of the picture of an evaluation: what is rounding is not magnified."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.figure import Figure

import mudline
from mudline.results.evaluation import evaluate_scene
from mudline.results.plots import trace, widened
from mudline.results.totals import PlotData
from mudline.scene.positions import read_positions
from tests.samples import SAMPLES


@pytest.mark.parametrize(
    ("values", "wanted"),
    [
        ([485.0, 485.001], (482.5755, 487.4255)),
        ([-200.0, -200.0], (-201.0, -199.0)),
        ([100.0, 150.0], (100.0, 150.0)),
        ([0.0, 0.0], (0.0, 0.0)),
        ([-1.7e308, 1.7e308], (-1.7e308, 1.7e308)),
    ],
)
def test_a_scale_spans_a_hundredth_of_its_values(values: list[float], wanted: tuple[float, float]) -> None:
    assert widened(np.array(values)) == pytest.approx(wanted, rel=1e-6)


@pytest.mark.parametrize(
    ("name", "low", "high"), [("reaction", 57_948.0, 58_531.0), ("force", 482.6, 487.5), ("touching", 56.7, 63.3)]
)
def test_a_trace_that_hardly_changes_is_flat(name: str, low: float, high: float) -> None:
    scene = mudline.read(SAMPLES / "slope-friction.keyxm").scene()
    evaluation = evaluate_scene(scene, read_positions(SAMPLES / "slope-friction.csv", scene.nodes), "keep")
    data = PlotData(evaluation)
    for part in evaluation.parts():
        data.take(part)
    axes = Figure().add_subplot()
    trace(axes, data, name, name, last=True)
    assert axes.get_ylim() == pytest.approx((low, high), rel=2e-3)
