"""What an input may ask for besides normal laws per unit length: plain arrays, NaN where a node or element has none."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from mudline.contact.arrays import BoolArray, FloatArray, IndexArray

if TYPE_CHECKING:  # a scene without them does not load them
    from mudline.contact.friction.law import FrictionLaw
    from mudline.contact.friction.trench import TrenchLaw
    from mudline.contact.suction.law import SuctionLaw


@dataclass(frozen=True, slots=True, eq=False)
class Smoothing:
    """Quadratic zones of linear laws of elements (m,).

    Attributes:
        half_width: h >= 0, length; 0 for a kinked law.
        one_sided: whether the zone is 0 < z < 2 h instead of -h < z < h.
    """

    half_width: FloatArray
    one_sided: BoolArray


@dataclass(frozen=True, slots=True, eq=False)
class NodalSprings:
    """Linear springs of single nodes (n,), with their quadratic zones.

    Attributes:
        stiffness: force per length of penetration of the node; NaN without.
        half_width: h >= 0 of the zone.
        one_sided: as in `Smoothing`.
    """

    stiffness: FloatArray
    half_width: FloatArray
    one_sided: BoolArray


@dataclass(frozen=True, slots=True, eq=False)
class SuctionSprings:
    """Springs against uplift without history (m,): force per unit length and length of uplift, and its extent."""

    stiffness: FloatArray
    extent: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class ElementSuction:
    """Suction with history: the elements (k,) that have it, and their laws (k,)."""

    elements: IndexArray
    law: SuctionLaw


@dataclass(frozen=True, slots=True, eq=False)
class NodeFriction:
    """Friction of nodes (n,): their laws, and the angle of u1 to +Y, degrees; NaN for u1 along the line."""

    law: FrictionLaw
    angle: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class NodeTrench:
    """Trenches of nodes (n,), and the straight centrelines (start and end, Y and Z) of nodes that have one.

    Attributes:
        law: widths and peak forces, NaN without a trench.
        straight: (n, 4) start and end of the centreline; NaN where it is the line as it was laid.
    """

    law: TrenchLaw
    straight: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class Extras:
    """All of them; None for what no node or element has.

    Attributes:
        lateral: (m,) lateral springs, force per unit length and length; NaN without.
        unloading: (m,) unloading stiffness, force per unit length and length; NaN without.
    """

    smoothing: Smoothing | None = None
    nodal: NodalSprings | None = None
    unloading: FloatArray | None = None
    suction_springs: SuctionSprings | None = None
    suction: ElementSuction | None = None
    friction: NodeFriction | None = None
    lateral: FloatArray | None = None
    trench: NodeTrench | None = None

    @property
    def history(self) -> bool:
        """Whether a step's result depends on the steps before it."""
        return any(part is not None for part in (self.unloading, self.suction, self.friction, self.lateral))
