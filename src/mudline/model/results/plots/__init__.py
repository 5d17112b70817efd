"""Plots in one style: curves, models, and results in panels. Needs matplotlib (extra `plot`)."""

from __future__ import annotations

from mudline.model.results.plots.curves import curves_figure
from mudline.model.results.plots.figure import evaluation_figure, plot_panel, plot_result
from mudline.model.results.plots.model import can_draw, model_figure
from mudline.model.results.plots.style import save

__all__ = ["can_draw", "curves_figure", "evaluation_figure", "model_figure", "plot_panel", "plot_result", "save"]
