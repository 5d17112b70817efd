"""What a scene with history remembers from one step to the next."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, TypeVar

from mudline.contact.arrays import FloatArray

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

    from mudline.contact.laws.friction import FrictionHistory
    from mudline.contact.laws.suction import SuctionHistory
    from mudline.contact.laws.unloading import UnloadingHistory

Part = TypeVar("Part", bound="DataclassInstance")


@dataclass(frozen=True, slots=True, eq=False)
class ContactState:
    """The state behind a step. It is never changed: a step gives a new one.

    Attributes:
        positions: (n, 3) of the step, for velocities by backward difference; None before the first step.
        laid: (n, 3) of the first step, along which trenches run; None before it.
        unloading: largest penetrations and trench bottoms of the elements that unload on a line of their own (k,).
        suction: states of the elements with suction (k,).
        friction: stick points of the nodes (n,).
        touchdown: (k, 3) midpoints of the elements with lateral springs when they touched down; NaN out of contact.
    """

    positions: FloatArray | None = None
    laid: FloatArray | None = None
    unloading: UnloadingHistory | None = None
    suction: SuctionHistory | None = None
    friction: FrictionHistory | None = None
    touchdown: FloatArray | None = None

    def copied(self) -> ContactState:
        """Return a state whose arrays may be written; positions stay as they are."""
        return replace(
            self,
            unloading=self.unloading and _copied(self.unloading),
            suction=self.suction and _copied(self.suction),
            friction=self.friction and _copied(self.friction),
            touchdown=None if self.touchdown is None else self.touchdown.copy(order="K"),
        )


def _copied(part: Part) -> Part:
    return type(part)(*(getattr(part, field.name).copy(order="K") for field in fields(part)))
