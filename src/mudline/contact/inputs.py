"""What the evaluator is given: nodes, elements and the law of each element, as plain arrays."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import IntEnum
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from mudline.contact.arrays import BoolArray, FloatArray, IdArray, IndexArray
from mudline.contact.errors import ElementError
from mudline.contact.extras import SIGNED, Extras

if TYPE_CHECKING:  # a scene without curves does not load them, nor does a flat bed load the others
    from mudline.contact.floors.base import Floor
    from mudline.curves import ForceCurve

Tension = Literal["keep", "cut"]


class LawKind(IntEnum):
    """The normal law of an element."""

    NONE = 0
    """No restraint."""
    CURVE = 1
    """Force per unit length over embedment ratio."""
    LINEAR = 2
    """Force per unit length proportional to penetration."""
    RIGID = 3
    """A constraint, not a spring."""
    NODAL = 4
    """Springs of its nodes, which `extras.nodal` has; no force per unit length of its own."""


@dataclass(frozen=True, slots=True, eq=False)
class ContactInput:
    """Nodes (n), elements (m) and their laws. The arrays are not copied; do not change them.

    Attributes:
        node_ids: (n,) numbers of the nodes, for messages.
        coordinates: (n, 3) positions evaluated when no others are given, X up.
        element_ids: (m,) numbers of the elements, for messages.
        element_nodes: (m, 2) indices of each element's nodes in `node_ids`.
        length: (m,) unstretched lengths, >= 0.
        diameter: (m,) external diameters, > 0, or NaN where there is none.
        law: (m,) values of `LawKind`.
        curve_index: (m,) index in `curves` of elements with a curve; -1 for the others.
        curves: the curves that `curve_index` points to.
        linear_stiffness: (m,) force per unit length and penetration of elements with a linear law; NaN for the others.
        tension: what happens where a curve pulls: "keep" its negative force, or "cut" force and stiffness to 0.
        floor: the bed; None for a flat one at X = 0.
        extras: smoothing, nodal springs, unloading, suction, friction, lateral springs, trenches.
        left_out: reasons, by stage of the plan, why something the scene asks for is not evaluated.

    Raises:
        ValueError: an array has the wrong shape or kind, or an index points nowhere.
        ElementError: an element's law lacks what it needs.
    """

    node_ids: IdArray
    coordinates: FloatArray
    element_ids: IdArray
    element_nodes: IndexArray
    length: FloatArray
    diameter: FloatArray
    law: NDArray[np.int8]
    curve_index: IndexArray
    curves: tuple[ForceCurve, ...]
    linear_stiffness: FloatArray
    tension: Tension = "keep"
    floor: Floor | None = None
    extras: Extras = field(default_factory=Extras)
    left_out: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        nodes, elements = len(self.node_ids), len(self.element_ids)
        _expect(self.node_ids, "node_ids", "iu", (nodes,))
        _expect(self.coordinates, "coordinates", "f", (nodes, 3))
        _expect(self.element_ids, "element_ids", "iu", (elements,))
        _expect(self.element_nodes, "element_nodes", "iu", (elements, 2))
        _expect(self.law, "law", "iu", (elements,))
        _expect(self.curve_index, "curve_index", "iu", (elements,))
        for name in ("length", "diameter", "linear_stiffness"):
            _expect(getattr(self, name), name, "f", (elements,))
        if self.tension not in {"keep", "cut"}:
            raise ValueError(f"tension must be 'keep' or 'cut', not {self.tension!r}")
        self._check_elements(nodes)
        for name, array, shape in self.extras.arrays(nodes, elements):
            kind = array.dtype.kind if array.dtype.kind in "bi" else "f"
            _expect(array, name, kind, shape)
            least = -np.inf if name in SIGNED else 0.0
            if kind == "f" and (np.isinf(array) | np.less(array, least)).any():
                raise ValueError(f"{name} must be finite{'' if name in SIGNED else ' and not negative'}")
        self._check_nodal()
        if self.extras.suction is not None:
            self._check_suction(self.extras.suction.elements)

    def with_law(self, kind: LawKind) -> IndexArray:
        """Return the indices of the elements with this law."""
        return np.flatnonzero(self.law == kind)

    def _check_elements(self, nodes: int) -> None:
        inside = (self.element_nodes >= 0) & (self.element_nodes < nodes)
        self._require(inside[:, 0] & inside[:, 1], "has a node that is not there")
        self._require(np.isfinite(self.length) & (self.length >= 0.0), "has no usable length")
        usable = np.isfinite(self.diameter) & (self.diameter > 0.0)
        self._require(usable | np.isnan(self.diameter), "has a diameter that is not positive and finite")
        self._require((self.law >= LawKind.NONE) & (self.law <= LawKind.NODAL), "has a law that is not evaluated here")
        on_curve = self.law == LawKind.CURVE
        known = (self.curve_index >= 0) & (self.curve_index < len(self.curves))
        self._require(known | ~on_curve, "has a curve that is not there")
        self._require(usable | ~on_curve, "has a curve and no diameter")
        linear = self.law == LawKind.LINEAR
        self._require(np.isfinite(self.linear_stiffness) | ~linear, "has a linear law and no finite stiffness")

    def _check_nodal(self) -> None:
        nodal = self.law == LawKind.NODAL
        if nodal.any():
            springs = self.extras.nodal
            sprung = np.zeros(len(self.node_ids), np.bool_) if springs is None else ~np.isnan(springs.stiffness)
            held = sprung[self.element_nodes].all(axis=1)
            self._require(held | ~nodal, "has a nodal law and a node without a stiffness")

    def _check_suction(self, held: IndexArray) -> None:
        if held.dtype.kind not in "iu" or not ((held >= 0) & (held < len(self.element_ids))).all():
            raise ValueError("suction.elements must be indices of elements")
        times = np.bincount(held, minlength=len(self.element_ids))
        self._require(times < 2, "has two suction laws")

    def _require(self, holds: BoolArray, otherwise: str) -> None:
        broken = np.flatnonzero(~holds)
        if broken.size:
            element = int(self.element_ids[broken[0]])
            raise ElementError(f"element {element} {otherwise}", element)


def _expect(array: NDArray[np.generic], name: str, kinds: str, shape: tuple[int, ...]) -> None:
    if array.shape != shape or array.dtype.kind not in kinds:
        what = {"f": "floats", "b": "booleans"}.get(kinds, "integers")
        raise ValueError(f"{name} must be {what} of shape {shape}, not {array.dtype} of shape {array.shape}")
