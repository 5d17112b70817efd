"""Damping of inward motion in contact, `DAMPING=` of `*SEABED CONTACT`.

    f = c v_n for an inward velocity v_n > 0 of what lies below the mudline, 0 outward.

It is added to the reaction, of which friction has a share, and never pulls.
"""

from __future__ import annotations

import numpy as np

from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.laws import Law, Moving, Parameter, Reached, Value, where


def damping_force(z: Value, v: Value, damping: Value) -> Value:
    """Return the force at a depth and a pull-out velocity."""
    return where((z > 0.0) & (v < 0.0), 0.0 - damping * v, 0.0)


def _largest(_reached: Reached, given: dict[str, FloatArray]) -> tuple[FloatArray, FloatArray]:
    damping = np.where(given["damping"] > 0.0, given["damping"], np.nan)
    return 0.0 * damping, damping


def _at(step: Moving, given: dict[str, FloatArray]) -> FloatArray:
    return np.where((step.z > 0.0) & (step.v < 0.0), given["damping"], 0.0)


def _damping(name: str, summary: str, acts_on: str, parameter: Parameter) -> Law:
    return Law(
        name=name,
        summary=summary,
        acts_on="nodes" if acts_on == "nodes" else "elements",
        parameters=(parameter,),
        velocities=True,
        largest=_largest,
        damping=_at,
        equation="f = c v_n, inward and in contact only",
        source="definition of DAMPING=",
    )


DAMPING = _damping(
    "damping", "damping of inward motion", "elements", Parameter("damping", "FT/L2", "c, per unit length")
)
NODAL_DAMPING = _damping(
    "nodal damping", "damping of inward motion of a node", "nodes", Parameter("damping", "FT/L", "c, of the node")
)
