"""What a scene with history remembers from one step to the next."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from mudline.contact.arrays import FloatArray

if TYPE_CHECKING:
    from mudline.contact.friction.law import FrictionHistory
    from mudline.contact.laws.unloading import UnloadingHistory
    from mudline.contact.suction.states import SuctionHistory


@dataclass(frozen=True, slots=True, eq=False)
class ContactState:
    """The state behind a step. It is never changed: a step gives a new one.

    Attributes:
        positions: (n, 3) of the step, for velocities by backward difference; None before the first step.
        laid: (n, 3) of the first step, along which trenches run; None before it.
        unloading: largest penetrations and trench bottoms of the elements that unload on a line of their own.
        suction: states of the elements with suction.
        friction: anchors of the nodes with friction.
        touchdown: (m, 3) midpoints of elements when they touched down, for lateral springs; NaN out of contact.
    """

    positions: FloatArray | None = None
    laid: FloatArray | None = None
    unloading: UnloadingHistory | None = None
    suction: SuctionHistory | None = None
    friction: FrictionHistory | None = None
    touchdown: FloatArray | None = None
