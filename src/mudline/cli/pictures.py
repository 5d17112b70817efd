"""Pictures and animations of results that a command draws: the options, what is refused of them, and the files."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path

import click

from mudline.cli.options import Command
from mudline.cli.streams import notify, notify_missing, writing
from mudline.cli.view import View
from mudline.files import suffix_of
from mudline.linting.output import visible
from mudline.results.panels import ANIMATIONS, MOST_FRAMES, PANELS, PICTURES, panel_names, require
from mudline.results.plot_data import PlotData

_PLOTS = "mudline.results.plots"


def options(command: Command) -> Command:
    """`--panels` and `--plot-elements`."""
    for option in (
        click.option(
            "--plot-elements",
            metavar="N,M",
            help="Draw the force over penetration of these elements, by number.",
        ),
        click.option(
            "--panels",
            metavar="NAMES",
            shell_complete=_complete,
            help=f"Show these panels, in this order: {', '.join(PANELS)}.",
        ),
    ):
        command = option(command)
    return command


def _complete(_context: click.Context, _parameter: click.Parameter, incomplete: str) -> list[str]:
    """Names of panels, also behind others and a comma."""
    before, comma, word = incomplete.rpartition(",")
    return [f"{before}{comma}{name}" for name in PANELS if name.startswith(word.lower())]


@dataclass(frozen=True)
class Pictures:
    """What is to be drawn: a picture, an animation, both or nothing; panels (None: the usual ones), element numbers."""

    picture: Path | None
    animation: Path | None
    panels: tuple[str, ...] | None
    elements: tuple[int, ...]

    @classmethod
    def asked_for(
        cls, picture: str | None, animation: str | None, panels: str | None, elements: str | None, *, option: str
    ) -> Pictures:
        """Return what options ask for; raises click.UsageError. `option` is the one that asks for a picture."""
        for path, forms in ((picture, PICTURES), (animation, ANIMATIONS)):
            if path is not None and suffix_of(path) not in forms:
                *others, last = (f".{form}" for form in forms)
                raise click.UsageError(
                    f"{path}: unknown file format: give a name ending in {', '.join(others)} or {last}"
                )
        for given, name in ((panels, "--panels"), (elements, "--plot-elements")):
            if given is not None and picture is None:
                raise click.UsageError(f"{name} is for a plot: give {option}")
        with _refused("--panels"):
            names = None if panels is None else panel_names([name.strip().lower() for name in panels.split(",")])
        return cls(
            None if picture is None else Path(picture),
            None if animation is None else Path(animation),
            names,
            _numbers(elements),
        )

    def __bool__(self) -> bool:
        return self.picture is not None or self.animation is not None

    def has_library(self) -> bool:
        """Whether matplotlib is installed, if it is needed; reports it if not."""
        first = self.picture or self.animation
        if first is None:
            return True
        try:
            import_module(_PLOTS)
        except ImportError:
            notify_missing(f".{suffix_of(first)}", "matplotlib", "plot")
            return False
        return True

    def data(self, make: Callable[[Sequence[int], int], PlotData]) -> PlotData | None:
        """Make what collects the data, from the numbers of elements and of frames; None if nothing is to be drawn.

        Raises click.UsageError for elements that are not there, for panels without data, and for one that has no steps
        to be animated.
        """
        if not self:
            return None
        with _refused("--plot-elements"):
            data = make(self.elements, MOST_FRAMES if self.animation else 0)
        if self.animation is not None and data.steps == 1:
            raise click.UsageError(f"{self.animation}: an animation needs time steps, and this is one state")
        if self.animation is not None and not data.elements.size:
            raise click.UsageError(f"{self.animation}: no element has positions of both its nodes")
        with _refused("--panels"):
            require(data, self.panels or ())
        return data

    def draw(self, data: PlotData, doubt: str, view: View) -> None:
        """Write the files; `doubt` is what is doubtful in the results."""
        plots = import_module(_PLOTS)
        if self.picture is not None:
            with writing(self.picture) as stream:
                plots.draw_evaluation(data, suffix_of(self.picture), stream, visible, doubt, self.panels)
            _notify(self.picture, "plot", view)
        if self.animation is not None:
            with writing(self.animation) as stream:
                plots.draw_animation(data, suffix_of(self.animation), stream, visible)
            _notify(self.animation, "animation", view)


def _notify(path: Path, what: str, view: View) -> None:
    if not view.quiet:
        notify(f"{what} -> {path.as_posix()}")


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


@contextmanager
def _refused(option: str) -> Iterator[None]:
    """Wrong usage of an option for what is refused in it."""
    try:
        yield
    except ValueError as error:
        raise click.UsageError(f"{option}: {error}") from error
