"""Suction: what holds a pipe back that is lifted off the bed.

    law = SuctionLaw(*from_cohesion(cohesion, diameter), first, second, cyclic, regularisation).checked()
    history = SuctionHistory.initial(elements)
    suction, history = step(law, history, uplift, velocity, compressed)

`step` is the law of `*SEABED SUCTION` after Bridge et al. (2004), with a history for each element; `suction_spring` is
SUCTION= of `*SEABED PROPERTIES`, which has none.
"""

from __future__ import annotations

from mudline.contact.suction.law import SuctionFactors, SuctionLaw, from_cohesion, maximum_force, suction_depth
from mudline.contact.suction.simple import suction_spring
from mudline.contact.suction.states import SuctionHistory, SuctionState
from mudline.contact.suction.stepping import Suction, step
from mudline.contact.suction.trapezoid import trapezoid

__all__ = [
    "Suction",
    "SuctionFactors",
    "SuctionHistory",
    "SuctionLaw",
    "SuctionState",
    "from_cohesion",
    "maximum_force",
    "step",
    "suction_depth",
    "suction_spring",
    "trapezoid",
]
