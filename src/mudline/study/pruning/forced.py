"""Laws on every element or node, whether the deck has them or not, with usual numbers for its pipe."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike

from mudline.contact.input import LawAssignment
from mudline.contact.laws import law_named
from mudline.contact.laws.suction import from_cohesion
from mudline.study.pruning.pipe import Pipe

COHESION = 5000.0


def forced(law: str, pipe: Pipe, nodes: int) -> LawAssignment:
    """A law of this name on a chain of so many nodes."""
    rows = np.arange(nodes if law_named(law).acts_on == "nodes" else nodes - 1)
    parameters = _numbers(pipe)[law]
    if law == "friction":
        parameters = {**parameters, "elliptic": rows % 2 == 0}
    return LawAssignment(law, rows, parameters)


def _numbers(pipe: Pipe) -> dict[str, Mapping[str, ArrayLike]]:
    """Parameters by law; zones of a hundredth of the diameter, a peak of a tenth of the stiffness at each node."""
    size, stiffness = pipe.diameter, pipe.stiffness
    zone = {"stiffness": stiffness, "half_width": 0.01 * size}
    return {
        "curve": {"curve": 0},
        "linear": {"stiffness": stiffness},
        "smoothed": zone,
        "nodal": zone,
        "unloading": {"stiffness": 2.0 * stiffness},
        "suction spring": {"stiffness": 0.1 * stiffness, "extent": 0.2 * size},
        "suction": from_cohesion(np.array(COHESION), np.array(size))._asdict(),
        "friction": {
            "axial_coefficient": 0.35,
            "lateral_coefficient": 0.6,
            "axial_mobilisation": 0.01 * size,
            "lateral_mobilisation": 0.1 * size,
        },
        "lateral": {"stiffness": 0.1 * stiffness},
        "trench peak": {"bottom": 2.0 * size, "upper": 4.0 * size, "peak": 0.1 * stiffness * size / pipe.length},
    }
