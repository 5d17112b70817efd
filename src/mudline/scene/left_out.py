"""What a deck asks for and the evaluator does not use, and why."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from mudline.contact.input import LawKind

if TYPE_CHECKING:
    from mudline.scene.model import Scene


def left_out(scene: Scene, laws: Sequence[str]) -> dict[str, str]:
    """By stage of the plan, what is asked for and not evaluated, or not as it is written; nothing for other stages."""
    told = {
        "smoothing": _smoothing(scene),
        "suction": _suction(scene),
        "friction": "; ".join(_friction(scene, laws)),
    }
    return {stage: why for stage, why in told.items() if why}


def _smoothing(scene: Scene) -> str:
    if "SEABED CONTACT" not in scene.extensions:
        return ""
    from mudline.scene.contact_parts.smoothing import weightless  # noqa: PLC0415 - only now is it needed

    count = weightless(scene)
    return f"none for {_elements(count)} of SMOOTHING=AUTO: no submerged weight above 0 is known" if count else ""


def _suction(scene: Scene) -> str:
    suction = _given(scene, "suction")
    if not suction.any():
        return ""
    extent = scene.bed.column("extent") > 0.0
    count = int((suction & ~extent & (scene.law != LawKind.RIGID)).sum())
    return f"SUCTION= without an extent of its zone holds nothing: {_elements(count)}" if count else ""


def _friction(scene: Scene, laws: Sequence[str]) -> list[str]:
    told = []
    coefficients = _given(scene, "friction").any(axis=1)
    extension = scene.extensions.get("SEABED FRICTION")
    asked = coefficients if extension is None else coefficients | (extension.of_element >= 0)
    if count := int((asked & (scene.law == LawKind.RIGID)).sum()):
        told.append(f"none on a rigid bed, whose reaction is that of a constraint: {_elements(count)}")
    if "lateral" in laws and asked.any():
        told.append("LATERAL= replaces the transverse coefficient")
    if _given(scene, "constant").any():
        told.append("the constant friction force coefficient is not evaluated: the manual does not say what it means")
    if _given(scene, "friction_stiffness").any():
        told.append("friction stiffnesses of FRICTION= are for modal and frequency runs (inferred)")
    return told


def _given(scene: Scene, name: str) -> np.ndarray[tuple[int, ...], np.dtype[np.bool_]]:
    """Where elements have a value of the bed above 0."""
    given: np.ndarray[tuple[int, ...], np.dtype[np.bool_]] = scene.bed.column(name) > 0.0
    return given


def _elements(count: int) -> str:
    return f"{count} element{'' if count == 1 else 's'}"
