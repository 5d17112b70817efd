"""The work-precision diagram of a deck: the error of each scheme against its run time. Needs matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from mudline.basics.quantities import shown
from mudline.model.results.plots.style import drawing, printable, style_of
from mudline.tools.study.precision import GOALS, WorkCurve
from mudline.tools.study.report import Study

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_LOOKS = {name: style_of(place) for place, name in enumerate(("velocity Verlet", "HHT (-0.3)", "RK4"))}
_LEAST, _LARGEST = 1e-5, 3.0
"""Errors that are drawn."""
_MICRO = 1e6


@drawing()
def study_figure(study: Study) -> Figure:
    """Return the diagram; its curves have to be measured."""
    curves = [] if study.drawn is None else study.drawn.curves
    motions = list(dict.fromkeys(curve.motion for curve in curves))
    figure = Figure(figsize=(1.5 + 4.8 * len(motions), 5.2), layout="constrained", dpi=120)
    panels = figure.subplots(1, len(motions), squeeze=False, sharex=True)[0]
    for axes, motion in zip(panels, motions, strict=True):
        for curve in curves:
            if curve.motion == motion:
                _draw_curve(axes, curve)
        _finish(axes, printable(motion), first=axes is panels[0])
    if study.own is not None and any(curve.own for curve in curves):
        own = study.own.step * (1e3 if study.step_unit else 1.0)
        text = f"the deck's own step, {shown(own)} {study.step_unit}".rstrip()
        _mark(panels[0], [], [], "0.6", f"{text} (line {study.own.deck_line})")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=4 if len(motions) > 1 else 2, frameon=False)
    figure.suptitle(f"Error against run time: {printable(study.deck, 100)}").set_parse_math(False)
    return figure


def _draw_curve(axes: Axes, curve: WorkCurve) -> None:
    """The largest errors up to each step, as far as they can be drawn, and the deck's own step."""
    errors = np.maximum.accumulate(curve.errors)
    drawn, look = errors < _LARGEST, _LOOKS[curve.scheme]
    x, y = np.maximum(errors[drawn], _LEAST), _MICRO * curve.run_times[drawn]
    axes.plot(x, y, label=curve.scheme, markevery=6, markersize=5, linewidth=1.5, color=look.color, marker=look.marker)
    if curve.own is not None:
        _, error, run_time = curve.own
        _mark(axes, [error], [_MICRO * run_time], look.color)


def _mark(axes: Axes, x: list[float], y: list[float], color: str, label: str | None = None) -> None:
    """The star of the deck's own step."""
    axes.plot(x, y, "*", markersize=15, color=color, markeredgecolor="black", zorder=5, label=label)


def _finish(axes: Axes, motion: str, *, first: bool) -> None:
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlim(_LEAST * 8.0, 1.0)
    for goal in GOALS:
        axes.axvline(goal, color="0.4", linewidth=1.0, linestyle=":")
        text = f"{100.0 * goal:g} % "
        axes.annotate(text, (goal, 0.98), xycoords=("data", "axes fraction"), ha="right", va="top", color="0.3")
    axes.grid(visible=True, which="major", color="0.9")
    axes.set_title(motion, fontsize="medium").set_parse_math(False)
    axes.set_xlabel("largest error of speed, duration and force up to a step [-]")
    if first:
        axes.set_ylabel("run time [us per s of motion and element]")
