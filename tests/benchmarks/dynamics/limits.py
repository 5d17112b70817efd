"""What limits an explicit step: the line, and each law on it.

The limit of a law is that of a line whose nodes all move together, so that each node has the whole stiffness or damping
of its length. Where one element alone is damped, its two nodes share the damping, and the rate is half of that.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mudline.model.contact.arrays import FloatArray
from tests.benchmarks.dynamics.beam import Beam, read_beam
from tests.benchmarks.dynamics.lifting import DAMPING
from tests.benchmarks.dynamics.schemes import DECK
from tests.benchmarks.studies.limits import CRITICAL_OMEGA_DT, critical_step
from tests.benchmarks.tables import Cell

EXPLICIT = tuple(CRITICAL_OMEGA_DT)
"""The schemes that have a limit."""
LIMITS = ("what", "value", "unit", "omega [rad/s]", "rate [1/s]", *(f"{name} [s]" for name in EXPLICIT))


def line_limit(scheme: str, frequencies: FloatArray, damping: float = DAMPING) -> float:
    """The largest step of a scheme on a line with these frequencies (k,), damped by a share of its stiffness (s)."""
    return min(critical_step(scheme, omega, damping * omega**2) for omega in frequencies.tolist())


def frequencies(beam: Beam, part: slice) -> FloatArray:
    """The circular frequencies (k,) of some displacements of a line that nothing holds, from the lowest, rad/s."""
    root = np.sqrt(beam.mass)
    squares = (beam.stiffness / root[:, None] / root)[part, part]
    found: FloatArray = np.sqrt(np.maximum(np.linalg.eigvalsh(squares), 0.0))
    return found


def limits() -> Iterator[tuple[Cell, ...]]:
    """The rows of `LIMITS`: of the line with its own damping, and of the largest stiffness and damping of each law.

    What acts on a node acts on those at the ends too, which have half the mass of the others.
    """
    beam = read_beam(DECK)
    for what, part in (("EA of the line", slice(beam.nodes, None)), ("EI of the line", slice(beam.nodes))):
        omegas = frequencies(beam, part)
        fastest = float(omegas[-1])
        steps = (line_limit(scheme, omegas) for scheme in EXPLICIT)
        yield what, None, "", fastest, DAMPING * fastest**2, *steps
    length = float(beam.contact.input.length[0])
    mass = float(beam.mass[1]) / length
    for law in beam.contact.stiffest().laws:
        over = float(beam.mass.min()) if law.per == "node" else mass
        stiffness, damping = float(np.nanmax(law.stiffness)), float(np.nanmax(law.damping))
        omega, rate = float(np.sqrt(stiffness / over)), damping / over
        unit = "N/m" if law.per == "node" else "N/m2"
        yield f"{law.law}, stiffness", stiffness, unit, omega, None, *(critical_step(name, omega) for name in EXPLICIT)
        if damping:
            steps = (critical_step(name, 0.0, rate) for name in EXPLICIT)
            yield f"{law.law}, damping", damping, unit.replace("N", "N s"), None, rate, *steps
