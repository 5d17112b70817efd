"""Puts the parts together that a scene needs; what it does not need is not imported."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from mudline.contact.extras import Extras
from mudline.contact.inputs import LawKind
from mudline.scene.floor import FloorKind

if TYPE_CHECKING:
    from mudline.contact.floors.base import Floor as ContactFloor
    from mudline.scene.model import Scene


def floor_of(scene: Scene) -> ContactFloor | None:
    """The bed; None for a flat one. Raises RefusedError."""
    if scene.floor.kind is FloorKind.FLAT:
        return None
    from mudline.scene.contact_parts.floor import contact_floor  # noqa: PLC0415 - only now is it needed

    return contact_floor(scene.floor)


def extras_of(scene: Scene, *, keep: bool) -> Extras:
    """Everything else that the deck asks for; `keep`: pulling curves are kept. Raises RefusedError."""
    return _sideways(scene, _suction(scene, _normal(scene, Extras()), keep=keep))


def _normal(scene: Scene, extras: Extras) -> Extras:
    """Nodal laws, smoothing, unloading."""
    smooth = np.zeros(len(scene.element_ids), dtype=np.bool_)
    if "SEABED CONTACT" in scene.extensions:
        from mudline.scene.contact_parts.smoothing import element_smoothing  # noqa: PLC0415 - only now is it needed

        extras = replace(extras, smoothing=element_smoothing(scene))
        if extras.smoothing is not None:
            smooth = extras.smoothing.half_width > 0.0
    if (scene.law == LawKind.NODAL).any():
        from mudline.scene.contact_parts.nodal import nodal_springs  # noqa: PLC0415 - only now is it needed

        extras = replace(extras, nodal=nodal_springs(scene))
    if "SEABED UNLOADING" in scene.extensions:
        from mudline.scene.contact_parts.unloading import unloading_stiffness  # noqa: PLC0415 - only now is it needed

        extras = replace(extras, unloading=unloading_stiffness(scene, smooth))
    return extras


def _suction(scene: Scene, extras: Extras, *, keep: bool) -> Extras:
    if _given(scene, "suction"):
        from mudline.scene.contact_parts.suction_springs import suction_springs  # noqa: PLC0415 - only now is it needed

        springs = suction_springs(scene)
        extras = replace(extras, suction_springs=springs if springs.stiffness.any() else None)
    if "SEABED SUCTION" in scene.extensions:
        from mudline.scene.contact_parts.suction import element_suction  # noqa: PLC0415 - only now is it needed

        extras = replace(extras, suction=element_suction(scene, keep=keep))
    return extras


def _sideways(scene: Scene, extras: Extras) -> Extras:
    """Lateral springs, friction, trenches."""
    if _given(scene, "lateral"):
        from mudline.scene.contact_parts.lateral import lateral_stiffness  # noqa: PLC0415 - only now is it needed

        lateral = lateral_stiffness(scene)
        extras = replace(extras, lateral=None if np.isnan(lateral).all() else lateral)
    if "SEABED FRICTION" in scene.extensions or _given(scene, "friction"):
        from mudline.scene.contact_parts.friction import node_friction  # noqa: PLC0415 - only now is it needed

        extras = replace(extras, friction=node_friction(scene, extras.lateral))
    if "SEABED TRENCH" in scene.extensions:
        from mudline.scene.contact_parts.trench import node_trench  # noqa: PLC0415 - only now is it needed

        extras = replace(extras, trench=node_trench(scene, extras.friction))
    return extras


def _given(scene: Scene, name: str) -> bool:
    """Whether some block of the bed gives a value above 0."""
    return any(np.greater(getattr(values, name), 0.0).any() for values in scene.bed.values)
