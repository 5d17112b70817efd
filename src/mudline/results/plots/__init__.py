"""The pictures: force-embedment curves, and results in panels. Needs matplotlib (extra `plot`)."""

from __future__ import annotations

from mudline.results.plots.curves import draw_curves
from mudline.results.plots.figure import draw_evaluation, figure_of, plot_result

__all__ = ["draw_curves", "draw_evaluation", "figure_of", "plot_result"]
