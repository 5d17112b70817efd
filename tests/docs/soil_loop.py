"""docs/images/soil-loop.svg: force against penetration of one element of the sample deck with a hysteretic soil."""

from __future__ import annotations

from pathlib import Path
from typing import BinaryIO, NamedTuple

import numpy as np

import mudline
from mudline.model.contact.arrays import FloatArray
from mudline.model.results.plots.style import COLORS, drawing, finish, new_figure, save, zero_line
from mudline.model.scene.model import resolve
from mudline.model.scene.positions import read_positions

ELEMENT = 14
_FINER = 20
"""Places evaluated for each step of the file, on a straight way: the force at a step of the file is the same."""


class Loop(NamedTuple):
    """Penetration in mm and force in kN/m of an element."""

    penetration: FloatArray
    force: FloatArray


def loop(samples: Path) -> Loop:
    """Evaluate the sample, with places between those of its file."""
    scene = resolve(mudline.read(samples / "scr-soil.keyxm"))
    given = read_positions(samples / "scr-soil.csv", scene.nodes)
    count = len(given.whole)
    fine = np.linspace(0.0, count - 1.0, _FINER * (count - 1) + 1)
    low = np.minimum(fine.astype(np.intp), count - 2)
    share = (fine - low)[:, None, None]
    result = scene.contact().evaluate((1.0 - share) * given.whole[low] + share * given.whole[low + 1])
    column = int(np.flatnonzero(scene.element_ids == ELEMENT)[0])
    return Loop(1e3 * result.depth[:, column], 1e-3 * result.force[:, column])


@drawing()
def draw(found: Loop, form: str, stream: BinaryIO) -> None:
    """Write the picture as "svg" or "png"."""
    figure = new_figure(4.8)
    axes = figure.add_subplot()
    zero_line(axes)
    axes.plot(found.penetration, found.force, color=COLORS[0], linewidth=1.3)
    axes.set_xlim(-15.0, None)
    axes.set_xlabel("penetration of the pipe [mm]")
    axes.set_ylabel("seabed reaction per unit length [kN/m]")
    axes.set_title(
        f"Element {ELEMENT} of samples/scr-soil.keyxm over two and a half periods of heave", fontsize="medium"
    )
    finish(axes)
    save(figure, form, stream)
