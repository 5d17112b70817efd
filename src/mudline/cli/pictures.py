"""The picture of results that a command draws: its options, what is refused of them, and its file."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from pathlib import Path

import click

from mudline.cli.options import OUTPUT, OUTPUT_FILE, Command, form_of_file, option
from mudline.cli.streams import notify, notify_missing, writing
from mudline.cli.view import View
from mudline.files import suffix_of
from mudline.linting.output import visible
from mudline.results.evaluation import Evaluation
from mudline.results.plot_data import PICTURES, PlotData

_PLOTS = "mudline.results.plots"


def options(command: Command) -> Command:
    """`--plot` and `--plot-elements`."""
    for add in (
        option(
            "--plot-elements",
            group=OUTPUT,
            metavar="N,M",
            help="Draw the force over penetration of these elements of a series, by number.",
        ),
        option(
            "--plot",
            "picture",
            type=OUTPUT_FILE,
            group=OUTPUT,
            metavar=f"FILE.{'|'.join(PICTURES)}",
            help="Draw the results (needs the extra mudline[plot]).",
        ),
    ):
        command = add(command)
    return command


@dataclass(frozen=True)
class Picture:
    """The file to be drawn, None for none, and the numbers of elements whose force over penetration is wanted."""

    path: Path | None
    elements: tuple[int, ...]

    @classmethod
    def asked_for(cls, picture: str | None, elements: str | None) -> Picture:
        """Return what options ask for; raises click.UsageError."""
        if picture is not None:
            form_of_file(picture, PICTURES)
        if elements is not None and picture is None:
            raise click.UsageError("--plot-elements is for a plot: give --plot")
        return cls(None if picture is None else Path(picture), _numbers(elements))

    def has_library(self) -> bool:
        """Whether matplotlib is installed, if it is needed; reports it if not."""
        if self.path is None:
            return True
        try:
            import_module(_PLOTS)
        except ImportError:
            notify_missing(f".{suffix_of(self.path)}", "matplotlib", "plot")
            return False
        return True

    def data(self, evaluation: Evaluation) -> PlotData | None:
        """Return what collects the data of an evaluation; None if nothing is to be drawn.

        Raises click.UsageError for elements that are not there.
        """
        if self.path is None:
            return None
        try:
            return PlotData.of_evaluation(evaluation, self.elements)
        except ValueError as error:
            raise click.UsageError(f"--plot-elements: {error}") from error

    def draw(self, data: PlotData, doubt: str, view: View) -> None:
        """Write the file; `doubt` is what is doubtful in the results."""
        if self.path is None:
            return
        with writing(self.path) as stream:
            import_module(_PLOTS).draw_evaluation(data, suffix_of(self.path), stream, visible, doubt)
        if not view.quiet:
            notify(f"plot -> {self.path.as_posix()}")


def _numbers(text: str | None) -> tuple[int, ...]:
    """Numbers of elements, separated by commas."""
    found = []
    for part in () if text is None else text.split(","):
        try:
            found.append(int(part))
        except ValueError as error:
            message = f"--plot-elements: {part.strip()!r} is not a number of an element; give numbers as 12,13"
            raise click.UsageError(message) from error
    return tuple(found)
