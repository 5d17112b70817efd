"""The style of all plots: curves that differ without colours, axes with quantity and unit, safe names."""

from __future__ import annotations

from typing import Any

import pytest

pytest.importorskip("matplotlib")


from mudline.model.results.curve_rows import curve_rows
from mudline.model.results.plots.curves import curves_figure
from mudline.model.results.plots.style import finish, new_figure, style_of
from mudline.model.scene.curves import OF_SEABED
from mudline.model.scene.model import resolve
from tests.helpers.samples import sample


def row(name: str, *points: tuple[float, float], **more: Any) -> dict[str, Any]:  # noqa: ANN401 - as in rows
    return {"name": name, "kind": OF_SEABED, "points": points, **more}


def test_many_curves_differ_in_colour_and_marker() -> None:
    assert len({(style.color, style.marker) for style in map(style_of, range(64))}) == 64
    axes = curves_figure([row(str(n), (0.0, 0.0), (1.0, n)) for n in range(20)], "metric").axes[0]
    drawn = [line for line in axes.get_lines() if str(line.get_label()).isdigit()]
    assert len({(line.get_color(), line.get_marker()) for line in drawn}) == 20


def test_axes_of_every_kind_have_their_units() -> None:
    scene = resolve(sample("scr-vessel.keyxm"))
    figure = curves_figure(curve_rows(scene, (), None), scene.units)
    assert [(axes.get_xlabel(), axes.get_ylabel().replace("\n", " ")) for axes in figure.axes] == [
        ("embedment ratio, depth / diameter [-]", "seabed reaction per unit length [N/m]"),
        ("velocity [m/s]", "elevation [m]"),
        ("ratio [-]", "coefficient [-]"),
        ("strain [-]", "force [N]"),
        ("curvature [1/m]", "moment [N m]"),
        ("twist [1/m]", "torque [N m]"),
    ]


def test_axes_of_a_caller_keep_what_was_set_on_them() -> None:
    figure = new_figure(3.0)
    named, scaled, polar = figure.add_subplot(131), figure.add_subplot(132), figure.add_subplot(133, projection="polar")
    named.set_xticks([0.0, 1.0], ["mudline", "depth"])
    scaled.set_xscale("log")
    ticks = scaled.xaxis.get_major_locator()
    for axes in (named, scaled, polar):
        finish(axes)
    assert [text.get_text() for text in named.get_xticklabels()] == ["mudline", "depth"]
    assert scaled.xaxis.get_major_locator() is ticks
