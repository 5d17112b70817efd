"""Option `--plot` of every command that draws, and the file that it writes."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any

import click

from mudline.basics.files import PLOT_FORMS, suffix_of
from mudline.cli.options import OUTPUT_FILE, OWN, Command, form_of_file, option
from mudline.cli.streams import require, writing
from mudline.cli.view import View


def plot_option(what: str, group: str = OWN) -> Callable[[Command], Command]:
    """Return `--plot`, which reaches the command as the path of the file or None; `what` is drawn."""
    return option(
        "--plot",
        group=group,
        type=OUTPUT_FILE,
        metavar=f"FILE.{'|'.join(PLOT_FORMS)}",
        callback=_plot,
        help=f"Draw {what} (needs the extra mudline[plot]).",
    )


Plot = Path | None
"""File of a plot; None without a plot."""


def write_plot(path: Plot, draw: Callable[[Any], Any], view: View | None = None) -> None:
    """Write the figure that `draw` makes with the module of plots, if a plot is asked for, and report its file."""
    if path is not None:
        plots = import_module("mudline.model.results.plots")
        figure = draw(plots)
        with writing(path) as stream:
            plots.style.save(figure, suffix_of(path), stream)
        if view is not None:
            view.note(f"plot -> {path.as_posix()}")


def _plot(_context: click.Context, _option: click.Parameter, path: str | None) -> Plot:
    """Return the file; raises click.UsageError for an unknown form, ends the command without matplotlib."""
    if path is None:
        return None
    form_of_file(path, PLOT_FORMS)
    require("--plot", "plot", "matplotlib")
    return Path(path)
