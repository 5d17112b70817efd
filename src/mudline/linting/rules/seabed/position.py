"""Lengths against the diameter of the pipe."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mudline.diagnostics import Code, Problem, Severity
from mudline.linting.context import LintContext
from mudline.linting.registry import rule

SBD019 = Code("SBD019", "short-mobilisation", Severity.WARNING)

_SHORTEST = 1e-4


@rule(SBD019)
def short_mobilisation(context: LintContext) -> Iterator[Problem]:
    """A mobilisation length is under a ten-thousandth of the diameter.

    Friction then builds up almost at once: its spring is so stiff that the solution jumps between stick and slip and
    hardly converges. Soil mobilises friction over some thousandths of a diameter at least. Give a longer one.

    Example:
         $MODEL
         *NODE
          1, -0.05, 0.0
          5, -0.05, 40.0
          GEN=1, 5
         *ELEMENT
          1, 1, 2
          GEN=1, 4
         *GEOMETRIC SETS
          OPTION=RIGID
          SET=ALL
          207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=50000.0
        - FRICTION=0.3, 0.6, 0.00001, 0.05
        + FRICTION=0.3, 0.6, 0.03, 0.05

    Finds: 17:21
    """
    scene = context.scene
    bed = scene.resistance
    if not any(length > 0.0 for given in bed.values for length in given.mobilisation):
        return
    lengths, friction = bed.column("mobilisation"), bed.column("friction")
    friction[bed.column("lateral") > 0.0, 1] = 0.0  # a lateral spring takes its place
    if replacing := scene.extensions.get("SEABED FRICTION"):
        friction[replacing.of_element >= 0] = 0.0
    for side, name in enumerate(("longitudinal_mobilisation", "transverse_mobilisation")):
        length = lengths[:, side]
        short = (length > 0.0) & (friction[:, side] > 0.0) & (length < _SHORTEST * scene.diameter)
        for index in np.unique(bed.of_element[short]).tolist():
            where = bed.places[index]
            path = (name,) if where.path[0] == "properties" else ("friction", name)
            value = bed.values[index].mobilisation[side]
            message = f"mobilisation length {value!r} is under 1e-4 diameters of the pipe: give a longer one"
            yield Problem(SBD019, message, where=where._replace(path=(*where.path, *path)))
