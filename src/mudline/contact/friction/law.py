"""What the friction of each node is made of."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from mudline.contact.arrays import BoolArray, FloatArray


class FrictionState(IntEnum):
    """What a direction of a node does."""

    NONE = -1
    """There is no friction law."""
    OPEN = 0
    """No normal force, no anchor."""
    STICK = 1
    """Held by a spring to the anchor."""
    SLIP = 2
    """At the limit; the anchor is dragged along."""


@dataclass(frozen=True, slots=True, eq=False)
class FrictionLaw:
    """The friction of nodes (n,), by direction: 0 is along u1 (axial), 1 along u2 (lateral).

    Attributes:
        coefficients: (n, 2) Coulomb coefficients mu, >= 0; the limit is mu N.
        stiffness: (n, 2) constant spring Kt, force per length, > 0; NaN where the mobilisation length holds.
        mobilisation: (n, 2) mobilisation lengths, > 0: the spring is mu N / length; not looked at beside a stiffness.
        ellipse: (n,) whether one elliptic criterion holds for both directions instead of one for each.
        active: (n,) nodes that have a law.
    """

    coefficients: FloatArray
    stiffness: FloatArray
    mobilisation: FloatArray
    ellipse: BoolArray
    active: BoolArray

    @property
    def constant(self) -> BoolArray:
        """Where (n, 2) the spring is constant."""
        return ~np.isnan(self.stiffness)


@dataclass(frozen=True, slots=True, eq=False)
class FrictionHistory:
    """What friction remembers. It is never changed: a step gives a new one.

    Attributes:
        anchors: (n, 3) points that the springs pull to; NaN for nodes that are open.
        states: (n, 2) values of `FrictionState`.
    """

    anchors: FloatArray
    states: NDArray[np.int8]

    @classmethod
    def start(cls, law: FrictionLaw) -> FrictionHistory:
        """Nothing has touched the bed yet."""
        states = np.where(law.active, FrictionState.OPEN, FrictionState.NONE).astype(np.int8)
        return cls(np.full((len(law.active), 3), np.nan), np.repeat(states[:, None], 2, axis=1))
