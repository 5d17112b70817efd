"""`*RIGID SURFACE`: rigid seabed (superseded, still legal)."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import about
from mudline.language.keywords.surfaces import SURFACE_SUCCESSORS, FrictionCoefficients, FrictionLengths, Surface
from mudline.language.keywords.values import Facts


class RigidProperties(FrictionLengths, FrictionCoefficients):
    """The first line."""


class RigidSurface(Surface):
    """Rigid seabed."""

    rule = "rigid_surface"
    subject = "seabed"
    facts = Facts(superseded_by=SURFACE_SUCCESSORS, seabed_type="RIGID")
    page = "kwd_model_rigidsurface"
    summary = "Rigid seabed: friction, slope or profile (superseded by *SEABED PROPERTIES)."
    example = "*RIGID SURFACE\n 0.3, 0.5\n"

    keyword: Literal["RIGID SURFACE"] = "RIGID SURFACE"
    properties: Annotated[RigidProperties, about("friction")]


BLOCK = RigidSurface
