"""What an evaluation gives."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mudline.contact.arrays import BoolArray, FloatArray, StateArray
from mudline.contact.tables import Tables
from mudline.short_repr import outline


@dataclass(frozen=True, slots=True, eq=False)
class ContactResult:
    """Arrays over elements (m) and nodes (n); over (steps, m) and (steps, n) for a series of positions.

    NaN stands for "none": `ratio` and `slope` of an element without diameter, and everything of elements and nodes
    without a position.

    Attributes:
        depth: mean distance of the element's two nodes below the seabed; negative above it.
        ratio: embedment ratio, depth / diameter.
        contact: depth > 0, or > -h in a centred zone.
        force: normal force per unit length, positive pushing out of the seabed.
        slope: d force / d ratio, per unit length.
        stiffness: d force / d penetration, per unit length and length of penetration.
        cut: where a pulling curve was cut; such an element is in contact with force, slope and stiffness 0.
        gap: distance of the node above the seabed, along its normal.
        normal: (..., n, 3) unit normal of the seabed at the node, out of the soil; may be a read-only view.
        reaction: (..., n, 3) total force of the seabed on the node.
        normal_force: the reaction along the normal, positive pushing out of the seabed.
        state: (..., m) `SuctionState` of the elements, -1 without suction; None where no element has it.
        regularised: (..., m) suction at a velocity below v_r, where the force is less than the power law gives; None
            without suction.
        friction: (..., n, 2) force of friction and lateral springs on the pipe along u1 and u2; None without any.
        friction_state: (..., n, 2) `FrictionState` of the nodes; None without friction.
        evaluated: (m,) elements whose two nodes have positions.
        present: (n,) nodes that have a position.
        rigid: (n,) nodes of elements on a rigid seabed, a constraint and no force; None where there are none.
    """

    depth: FloatArray
    ratio: FloatArray
    contact: BoolArray
    force: FloatArray
    slope: FloatArray
    stiffness: FloatArray
    cut: BoolArray
    gap: FloatArray
    normal: FloatArray
    reaction: FloatArray
    normal_force: FloatArray
    evaluated: BoolArray
    present: BoolArray
    state: StateArray | None = None
    regularised: BoolArray | None = None
    friction: FloatArray | None = None
    friction_state: StateArray | None = None
    rigid: BoolArray | None = None

    def __repr__(self) -> str:
        optional = ("state", "regularised", "friction", "friction_state", "rigid")
        present = ", ".join(name for name in optional if getattr(self, name) is not None)
        shapes = f"elements {self.depth.shape}, nodes {self.gap.shape}"
        return outline("ContactResult", shapes, f"with {present}" if present else "")

    @property
    def restrained(self) -> BoolArray | None:
        """Nodes (..., n) that a rigid seabed restrains along their `normal`: its own, at the seabed or below it."""
        return None if self.rigid is None else self.rigid & (self.gap <= 0.0)

    def friction_state_of(self, side: int) -> StateArray:
        """Return the states (..., n) along u1 (0) or u2 (1); -1 without friction."""
        if self.friction_state is None:
            return np.full(self.gap.shape, -1, np.int8)
        return self.friction_state[..., side]

    def step(self, index: int) -> ContactResult:
        """Return one step of a series, as views."""
        return self._cut(index)

    def steps(self, start: int, stop: int) -> ContactResult:
        """Return the steps start <= step < stop of a series, as views."""
        return self._cut(slice(start, stop))

    def _cut(self, key: int | slice) -> ContactResult:
        arrays = ((name, getattr(self, name)) for name in _BY_STEP)
        of_steps: dict[str, Any] = {name: None if values is None else values[key] for name, values in arrays}
        return ContactResult(**of_steps, evaluated=self.evaluated, present=self.present, rigid=self.rigid)


_BY_STEP = tuple(each.name for each in fields(ContactResult) if each.name not in {"evaluated", "present", "rigid"})


def blank_result(
    steps: int, evaluated: BoolArray, present: BoolArray, tables: Tables, same_normal: FloatArray | None
) -> ContactResult:
    """Return a series of results to be filled in.

    Arrays for laws that are not there are left out. Where all points of the seabed share a normal, it is a view, and so
    is `cut` where nothing is ever cut.
    """
    on_elements, on_nodes = (steps, len(evaluated)), (steps, len(present))
    slides = tables.friction is not None or tables.lateral is not None
    cuts = tables.cuts and any(rows.curve >= 0 for rows in tables.normal)
    return ContactResult(
        depth=np.empty(on_elements),
        ratio=np.empty(on_elements),
        contact=np.empty(on_elements, np.bool_),
        force=np.empty(on_elements),
        slope=np.empty(on_elements),
        stiffness=np.empty(on_elements),
        cut=np.zeros(on_elements, np.bool_) if cuts else _repeated(np.zeros((), np.bool_), on_elements),
        gap=np.empty(on_nodes),
        normal=np.empty((*on_nodes, 3)) if same_normal is None else _repeated(same_normal, on_nodes),
        reaction=np.empty((*on_nodes, 3)),
        normal_force=np.empty(on_nodes),
        evaluated=evaluated,
        present=present,
        state=None if tables.suction is None else np.full(on_elements, -1, np.int8),
        regularised=None if tables.suction is None else np.zeros(on_elements, np.bool_),
        friction=np.empty((*on_nodes, 2)) if slides else None,
        friction_state=None if tables.friction is None else np.empty((*on_nodes, 2), np.int8),
        rigid=tables.rigid,
    )


def _repeated(values: NDArray[Any], shape: tuple[int, int]) -> NDArray[Any]:
    """The same values everywhere, as a view that may not be written; what np.broadcast_to does, sooner."""
    found: NDArray[Any] = np.ndarray((*shape, *values.shape), values.dtype, values.data, 0, (0, 0, *values.strides))
    found.setflags(write=False)
    return found
