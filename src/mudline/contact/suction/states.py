"""Where an element is between contact and breakout, and what it remembers."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from mudline.contact.arrays import BoolArray, FloatArray, IndexArray


class SuctionState(IntEnum):
    """State of an element with a suction law."""

    FREE = 0
    """No contact, and no suction to come: not touched yet, or broken out and come down again."""
    COMPRESSION = 1
    """The reaction of the bed is compressive."""
    SUCTION = 2
    """Moving up, between the loss of the reaction and breakout."""
    HOLD = 3
    """Lifted off and not moving up: no suction, and no breakout either."""
    BROKEN = 4
    """Broken out, and still as far above as breakout was."""


@dataclass(frozen=True, slots=True, eq=False)
class SuctionHistory:
    """What the elements (m,) remember. A step gives a new one and leaves the old one as it is.

    Attributes:
        armed: there was compression since the last breakout.
        v_max: the largest pull-out velocity of the uplift episode, which begins when an armed element loses its
            compressive reaction and ends with the next compression or with breakout. A broken element keeps that of
            its breakout. 0 in all other states.
        state: values of `SuctionState`.
    """

    armed: BoolArray
    v_max: FloatArray
    state: NDArray[np.int8]

    @classmethod
    def initial(cls, elements: int) -> SuctionHistory:
        """Return the history of elements that never touched the bed."""
        return cls(np.zeros(elements, np.bool_), np.zeros(elements), np.full(elements, SuctionState.FREE, np.int8))

    def rows(self, rows: slice | IndexArray) -> SuctionHistory:
        """Return some elements, as views of a slice."""
        return SuctionHistory(self.armed[rows], self.v_max[rows], self.state[rows])
