"""What an input may ask for besides normal laws per unit length: plain arrays, NaN where a node or element has none."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mudline.contact.arrays import BoolArray, FloatArray, IndexArray

if TYPE_CHECKING:  # a scene without them does not load them
    from mudline.contact.friction.law import FrictionLaw
    from mudline.contact.friction.trench import TrenchLaw
    from mudline.contact.suction.law import SuctionLaw

SIGNED = frozenset({"friction.angle", "trench.straight"})
"""Arrays of `Extras.arrays` that may be negative."""


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

    def arrays(self, nodes: int, elements: int) -> Iterator[tuple[str, NDArray[np.generic], tuple[int, ...]]]:
        """Name, array and the shape that it needs, of all arrays that are there."""
        if self.smoothing is not None:
            yield from _fields("smoothing", self.smoothing, ("half_width", "one_sided"), (elements,))
        if self.nodal is not None:
            yield from _fields("nodal", self.nodal, ("stiffness", "half_width", "one_sided"), (nodes,))
        if self.suction_springs is not None:
            yield from _fields("suction_springs", self.suction_springs, ("stiffness", "extent"), (elements,))
        if self.suction is not None:
            held = (len(self.suction.elements),)
            yield "suction.elements", self.suction.elements, held
            yield from _fields("suction.law", self.suction.law, self.suction.law._fields, held)
        if self.friction is not None:
            law = self.friction.law
            yield from _fields("friction.law", law, ("coefficients", "stiffness", "mobilisation"), (nodes, 2))
            yield from _fields("friction.law", law, ("ellipse", "active"), (nodes,))
            yield "friction.angle", self.friction.angle, (nodes,)
        if self.trench is not None:
            yield from _fields("trench.law", self.trench.law, ("bottom", "upper", "peak"), (nodes,))
            yield "trench.straight", self.trench.straight, (nodes, 4)
        for name, array in (("unloading", self.unloading), ("lateral", self.lateral)):
            if array is not None:
                yield name, array, (elements,)


def _fields(
    owner: str, part: object, names: tuple[str, ...], shape: tuple[int, ...]
) -> Iterator[tuple[str, NDArray[np.generic], tuple[int, ...]]]:
    for name in names:
        yield f"{owner}.{name}", getattr(part, name), shape
