"""`*ELASTIC SURFACE`: linear elastic seabed (superseded, still legal)."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.common import SUCTION_STIFFNESS
from mudline.language.keywords.fields import about
from mudline.language.keywords.model import Row
from mudline.language.keywords.surfaces import SURFACE_SUCCESSORS, FrictionCoefficients, FrictionLengths, Surface
from mudline.language.keywords.usual import BED, LEAST_SIDE, Usual
from mudline.language.keywords.values import Facts, Real


class _Stiffness(Row):
    """What stands before the friction coefficients."""

    stiffness: Annotated[
        Real | None,
        about("stiffness per unit length; without it *EMBEDMENT is required", unit="F/L2", at_least=0, usual=BED),
    ] = None


class _Resistance(Row):
    """What stands behind the friction coefficients."""

    lateral: Annotated[Real | None, about("lateral stiffness", unit="F/L2", at_least=0, usual=LEAST_SIDE)] = None
    suction_stiffness: Annotated[
        Real | None, about("suction stiffness", unit="F/L2", at_least=0, inferred=SUCTION_STIFFNESS, usual=LEAST_SIDE)
    ] = None
    suction_extent: Annotated[
        Real | None,
        about(
            "height of the suction zone above the seabed",
            unit="L",
            at_least=0,
            usual=Usual(high=10.0, why="a few diameters", remark=True),
        ),
    ] = None


class ElasticProperties(FrictionLengths, _Resistance, FrictionCoefficients, _Stiffness):  # the last base's fields first
    """The first line."""


class ElasticSurface(Surface):
    """Elastic seabed."""

    rule = "elastic_surface"
    subject = "seabed"
    facts = Facts(superseded_by=SURFACE_SUCCESSORS, seabed_type="ELASTIC", beside=("EMBEDMENT",))
    page = "kwd_model_elasticsurface"
    summary = "Elastic seabed: stiffness, friction, slope or profile (superseded by *SEABED PROPERTIES)."
    example = "*ELASTIC SURFACE\n 50000.0, 0.3, 0.5\n"

    keyword: Literal["ELASTIC SURFACE"] = "ELASTIC SURFACE"
    properties: Annotated[ElasticProperties, about("stiffness, friction, lateral resistance, suction")]


BLOCK = ElasticSurface
