"""`ContactResult.plot`: the picture of a whole result."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

import matplotlib as mpl
from matplotlib.figure import Figure

from mudline.contact import ContactResult
from mudline.files import replacement
from mudline.results.panels import PICTURES
from mudline.results.plot_data import PlotData
from mudline.results.plots.figure import figure_of
from mudline.results.plots.style import SETTINGS, write


def plot_result(
    result: ContactResult,
    path: str | os.PathLike[str] | None = None,
    *,
    panels: Sequence[str] | None = None,
    elements: Sequence[int] = (),
) -> Figure:
    """Return the figure of a result, and write it to a file if a path is given; see `ContactResult.plot`."""
    form = "" if path is None else Path(path).suffix.lower().removeprefix(".")
    if path is not None and form not in PICTURES:
        raise ValueError(f"{path}: a plot is a .{', .'.join(PICTURES[:-1])} or .{PICTURES[-1]}")
    data = PlotData.of_result(result, elements)
    with mpl.rc_context(SETTINGS):
        figure = figure_of(data, str, "", panels)
        if path is not None:
            with replacement(Path(path)) as stream:
                write(lambda: figure, form, stream)
    return figure
