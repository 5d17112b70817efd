"""docs/images/full-cycle.svg: force against penetration in one cycle, as the evaluator gives it for the sample deck."""

from __future__ import annotations

from pathlib import Path
from typing import BinaryIO, NamedTuple

import numpy as np
from matplotlib.axes import Axes

import mudline
from mudline.model.results.plot_data import Cycle
from mudline.model.results.plots.curves import draw_path
from mudline.model.results.plots.style import drawing, finish, legend, new_figure, save
from mudline.model.scene.model import resolve
from mudline.model.scene.positions import read_positions

_ELEMENT = 0


class Note(NamedTuple):
    """A text at a place of the text area, with an arrow to a point of the path."""

    text: str
    point: tuple[float, float]
    at: tuple[float, float]


NOTES = (
    Note("1  penetration along\nthe force-embedment curve", (42.0, 2.87), (3.0, 3.6)),
    Note("2  it turns: unloading\nalong the stiffness ku", (92.5, 1.87), (103.0, 1.3)),
    Note("3  suction: rise,\nplateau, release", (72.0, -0.26), (80.0, -1.2)),
    Note("4  the pipe stops:\nhold, no force", (40.0, 0.0), (14.0, 0.65)),
    Note("5  breakout, at the\nuplift Delta_B above\nthe trench bottom", (-35.3, 0.0), (-51.0, 0.65)),
    Note("6  down again: no force\nabove the trench bottom", (65.0, 0.0), (42.0, 1.4)),
    Note("7  along ku to where\nit turned, then along\nthe curve", (106.0, 3.83), (104.0, 2.7)),
)
_FINER = 5
"""Places evaluated for each step of the file."""


def cycle(samples: Path) -> Cycle:
    """Evaluate the sample, with places between those of its file: penetration in mm, force in kN/m, states."""
    scene = resolve(mudline.read(samples / "full-cycle.keyxm"))
    given = read_positions(samples / "full-cycle.csv", scene.nodes)
    assert given.time is not None
    steps = np.arange(len(given.time))
    fine = np.linspace(0.0, steps[-1], _FINER * steps[-1] + 1)
    times = np.interp(fine, steps, given.time)
    height = np.interp(fine, steps, given.whole[:, 0, 0])  # all nodes move alike
    positions = np.repeat(scene.coordinates[None], len(fine), axis=0)
    positions[:, :, 0] = height[:, None]
    result = scene.contact().evaluate(positions, times=times)
    assert result.state is not None
    return Cycle(1e3 * result.depth[:, _ELEMENT], 1e-3 * result.force[:, _ELEMENT], result.state[:, _ELEMENT])


@drawing()
def draw(path: Cycle, form: str, stream: BinaryIO) -> None:
    """Write the picture as "svg" or "png"."""
    figure = new_figure(5.2)
    figure.suptitle(
        "One cycle of samples/full-cycle.keyxm: a pipe of 0.4064 m on soft clay, pulled out at 10 mm/s",
        fontsize="medium",
    )
    _panel(figure.add_subplot(), path)
    save(figure, form, stream)


def _panel(axes: Axes, path: Cycle) -> None:
    axes.text(-1.0, 4.95, "seabed", rotation=90.0, ha="right", va="top", fontsize="small")
    draw_path(axes, path)
    line = {"arrowstyle": "-", "color": "0.4", "linewidth": 0.7}
    for note in NOTES:
        axes.annotate(note.text, note.point, note.at, arrowprops=line)
    axes.set_xlabel("penetration of the pipe [mm]")
    axes.set_ylabel("seabed reaction per unit length [kN/m]\nabove 0 it pushes the pipe out, below 0 it holds it back")
    axes.set_xlim(-55.0, 140.0)
    axes.set_ylim(-1.6, 5.0)
    finish(axes)
    axes.set_xticks(range(-50, 126, 25))
    legend(axes, title="state", columns=5)
