"""Puts the laws together that a scene gives its elements and nodes; what it does not need is not imported."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mudline.contact.input import LawAssignment, LawKind
from mudline.scene.floor import FloorKind
from mudline.scene.numbering import Indices

if TYPE_CHECKING:
    from mudline.contact.seabed.base import Seabed
    from mudline.scene.model import LawArrays, Scene


def seabed_of(scene: Scene) -> Seabed | None:
    """The shape of the seabed; None for a flat one. Raises RefusedError."""
    if scene.floor.kind is FloorKind.FLAT:
        return None
    from mudline.scene.contact_parts.floor import contact_seabed  # noqa: PLC0415 - only now is it needed

    return contact_seabed(scene.floor)


def laws_of(scene: Scene, arrays: LawArrays) -> list[LawAssignment]:
    """Everything that the deck gives elements and nodes."""
    laws = [*_normal(scene, arrays), *_suction(scene), *_sideways(scene)]
    return [law for law in laws if len(law.rows)]


def table_of(scene: Scene) -> list[np.ndarray[tuple[int, ...], np.dtype[np.float64]]]:
    """The tables that trenches point to."""
    if "SEABED TRENCH" not in scene.extensions:
        return []
    from mudline.scene.contact_parts.trench import resistance_tables  # noqa: PLC0415 - only now is it needed

    return resistance_tables(scene)


def _normal(scene: Scene, arrays: LawArrays) -> list[LawAssignment]:
    """Curves, linear laws, nodal laws, unloading."""
    (on_curve,), (linear,) = (np.nonzero(scene.law == kind) for kind in (LawKind.CURVE, LawKind.LINEAR))
    laws = [
        LawAssignment("rigid", np.flatnonzero(scene.law == LawKind.RIGID)),
        LawAssignment("curve", on_curve, {"curve": arrays.curve_index[on_curve]}),
    ]
    smoothed = np.zeros(len(scene.element_ids), dtype=np.bool_)
    if "SEABED CONTACT" in scene.extensions:
        from mudline.scene.contact_parts.smoothing import element_smoothing  # noqa: PLC0415 - only now is it needed

        smoothing = element_smoothing(scene)
        smoothed[smoothing.rows] = True
        laws.append(smoothing)
    plain = linear[~smoothed[linear]]
    laws.append(LawAssignment("linear", plain, {"stiffness": arrays.linear_stiffness[plain]}))
    if (scene.law == LawKind.NODAL).any():
        from mudline.scene.contact_parts.nodal import nodal_springs  # noqa: PLC0415 - only now is it needed

        laws.append(nodal_springs(scene))
    if "SEABED UNLOADING" in scene.extensions:
        from mudline.scene.contact_parts.unloading import unloading_lines  # noqa: PLC0415 - only now is it needed

        laws.append(unloading_lines(scene))
    return laws


def _suction(scene: Scene) -> list[LawAssignment]:
    laws = []
    if given(scene, "suction"):
        stiffness, extent = scene.bed.column("suction"), scene.bed.column("extent")
        # a spring without an extent of its zone holds nothing
        rows = np.flatnonzero((stiffness > 0.0) & (extent > 0.0) & (scene.law != LawKind.RIGID))
        laws.append(LawAssignment("suction spring", rows, {"stiffness": stiffness[rows], "extent": extent[rows]}))
    if "SEABED SUCTION" in scene.extensions:
        from mudline.scene.contact_parts.suction import element_suction  # noqa: PLC0415 - only now is it needed

        laws.append(element_suction(scene))
    return laws


def _sideways(scene: Scene) -> list[LawAssignment]:
    """Lateral springs, friction, trenches."""
    laws = []
    if given(scene, "lateral"):
        lateral = _lateral(scene)
        laws.append(LawAssignment("lateral", lateral, {"stiffness": scene.bed.column("lateral")[lateral]}))
    friction = friction_of(scene)
    if friction is not None:
        laws.append(friction)
    if "SEABED TRENCH" in scene.extensions:
        from mudline.scene.contact_parts.trench import trenches  # noqa: PLC0415 - only now is it needed

        laws += trenches(scene)
    return laws


def friction_of(scene: Scene) -> LawAssignment | None:
    """The friction of the nodes; None where nothing gives any."""
    if "SEABED FRICTION" not in scene.extensions and not given(scene, "friction"):
        return None
    from mudline.scene.contact_parts.friction import node_friction  # noqa: PLC0415 - only now is it needed

    return node_friction(scene, _lateral(scene))


def _lateral(scene: Scene) -> Indices:
    """Elements with a lateral spring."""
    if not given(scene, "lateral"):
        return np.zeros(0, dtype=np.intp)
    return np.flatnonzero((scene.bed.column("lateral") > 0.0) & (scene.law != LawKind.RIGID))


def given(scene: Scene, name: str) -> bool:
    """Whether some block of the seabed gives a value above 0."""
    return any(np.greater(getattr(values, name), 0.0).any() for values in scene.bed.values)
