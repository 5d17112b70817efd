"""The motions that are integrated: one with published numbers, and those on the scene's own seabed."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

from mudline.scene.model import Scene
from mudline.study.precision.case import Case
from mudline.study.precision.drag import drag_case
from mudline.study.precision.drop import Drop, drop_case, drop_to
from mudline.study.precision.laws import CurveLaw, LinearLaw
from mudline.study.precision.pull import Pull, pull_case
from mudline.study.precision.seabed import (
    Bed,
    Seabed,
    friction_of,
    static_depth,
    suction_of,
    usual_velocity,
)
from mudline.study.report import Omission, StudyError

_REACH = 0.25
"""Of the diameter: how deep the masses fall."""


def reference_drop() -> Drop:
    """500 kg fall on 50 kN/m with 0.5 m/s: 0.20820726588 m deep."""
    mass, stiffness, speed = 500.0, 5e4, 0.5
    static = mass * 9.81 / stiffness
    deepest = static + math.sqrt(static**2 + mass * speed**2 / stiffness)
    return Drop(LinearLaw("50 kN/m", stiffness), mass, mass * 9.81, speed, deepest)


def all_cases(scene: Scene, seabed: Seabed, omissions: list[Omission], notes: list[str]) -> list[Case]:
    """The reference, then for each seabed a drop, and for the first a pull and a drag."""
    cases = [drop_case("drop-reference", "dropped, published case", reference_drop())]
    for bed in seabed.beds:
        _add(cases, omissions, f"drop on {bed.law.name}", partial(_drop, bed))
    for bed in seabed.beds[:1]:
        _add(cases, omissions, f"pull off {bed.law.name}", partial(_pull, scene, seabed, bed, notes))
        _add(cases, omissions, f"drag along {bed.law.name}", partial(_drag, seabed, bed, notes))
    return cases


def _drop(bed: Bed) -> Case:
    kind = "curve" if isinstance(bed.law, CurveLaw) else "linear"
    drop = drop_to(bed.law, bed.mass, bed.weight, _REACH * bed.diameter)
    return drop_case(f"drop-{kind}", f"dropped on {bed.law.name}", drop)


def _pull(scene: Scene, seabed: Seabed, bed: Bed, notes: list[str]) -> Case:
    suction = suction_of(scene, seabed.inputs, bed, notes)
    return pull_case(Pull(bed.law.name, bed.law, suction, bed.mass, static_depth(bed), usual_velocity(scene)))


def _drag(seabed: Seabed, bed: Bed, notes: list[str]) -> Case:
    return drag_case(friction_of(seabed.inputs, bed, notes))


def _add(cases: list[Case], omissions: list[Omission], what: str, make: Callable[[], Case]) -> None:
    """A case, or the reason why there is none: numbers of a deck may be beyond what can be integrated."""
    try:
        case = make()
    except (StudyError, ArithmeticError, ValueError) as error:
        omissions.append(Omission(what, str(error)))
        return
    if math.isfinite(case.omega) and math.isfinite(case.duration) and case.omega > 0.0:
        cases.append(case)
    else:
        omissions.append(Omission(what, "its stiffness or its duration overflows"))
