"""A free beam that falls on springs and bounces: the reference of this benchmark beside Exudyn."""

from __future__ import annotations

import numpy as np

from mudline.model.contact.arrays import FloatArray
from tests.benchmarks.dynamics.beam import Beam, read_beam
from tests.benchmarks.dynamics.lifting import DAMPING, Hoist, Lifting
from tests.benchmarks.dynamics.reference import Path, Reference, Tolerance

DECK = "bouncing-beam.keyxm"
END, EVERY = 2.0, 0.01
"""Seconds: of the run, and between two moments that are compared."""
TIMES = np.linspace(0.0, END, round(END / EVERY) + 1)


def fall(tolerance: Tolerance, times: FloatArray = TIMES) -> tuple[Beam, Path]:
    """The beam, and what it does without a hoist."""
    beam = read_beam(DECK)
    free = Hoist(stiffness=0.0, height=0.0, lift_period=1.0, pull=0.0, pull_period=1.0)
    return beam, Reference(Lifting(beam, free), tolerance).run(times)


def for_exudyn(beam: Beam, steps: int) -> dict[str, object]:
    """What `peer_exudyn` takes."""
    nodes = beam.nodes
    return {
        "heights": beam.start[:, 0].tolist(),
        "mass": beam.mass[:nodes].tolist(),
        "stiffness": beam.stiffness[:nodes, :nodes].tolist(),
        "damping": DAMPING,
        "weight": beam.weight[:nodes].tolist(),
        "contact": float(beam.contact.input.assigned["nodal"].parameters["stiffness"][0]),
        "end": END,
        "steps": steps,
        "every": EVERY,
    }
