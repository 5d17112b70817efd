"""A free beam that falls on springs and bounces: the reference of this benchmark beside Exudyn."""

from __future__ import annotations

import numpy as np

from mudline.contact.arrays import FloatArray
from tests.benchmarks.dynamics.beam import Beam, differences, lumped, read_beam
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


def for_exudyn(beam: Beam, model: str, steps: int, refined: int = 1) -> dict[str, object]:
    """What `peer_exudyn` takes; `refined`: into how many parts each element is cut. The springs stay where they are."""
    coarse = beam.nodes
    nodes = (coarse - 1) * refined + 1
    long = float(beam.contact.input.length[0])
    length = long / refined
    share = lumped(nodes, length)
    at = np.arange(nodes) / refined
    bending = float(beam.stiffness[0, 0]) * long**3
    return {
        "model": model,
        "refined": refined,
        "heights": np.interp(at, np.arange(coarse), beam.start[:, 0]).tolist(),
        "along": np.interp(at, np.arange(coarse), beam.start[:, 1]).tolist(),
        "mass": (beam.mass[1] / long * share).tolist(),
        "stiffness": (bending / length**3 * differences(nodes, 2)).tolist(),
        "damping": DAMPING,
        "weight": (beam.weight[1] / long * share).tolist(),
        "contact": float(beam.contact.input.assigned["nodal"].parameters["stiffness"][0]),
        "mass_per_length": float(beam.mass[1]) / long,
        "bending": bending,
        "axial": float(-beam.stiffness[coarse, coarse + 1]) * long,
        "end": END,
        "steps": steps,
        "every": EVERY,
    }
