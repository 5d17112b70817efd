"""`*ELASTIC SURFACE`: linear elastic seabed (superseded, still legal)."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from mudline.keywords import common
from mudline.keywords.about import about
from mudline.keywords.common import Surface
from mudline.keywords.model import Row
from mudline.keywords.values import Real

_STIFFNESS = about("stiffness per unit length; without it *EMBEDMENT is required", unit="F/L2", at_least=0)
_EXTENT = about("height of the suction zone above the bed", unit="L", at_least=0)


class ElasticProperties(Row):
    """The first line."""

    stiffness: Annotated[Real | None, _STIFFNESS] = None
    longitudinal: Annotated[Real | None, common.AXIAL_FRICTION] = None
    transverse: Annotated[Real | None, common.LATERAL_FRICTION] = None
    lateral: Annotated[Real | None, about("lateral stiffness", unit="F/L2", at_least=0)] = None
    suction_stiffness: Annotated[Real | None, about("suction stiffness", unit="F/L2", at_least=0)] = None
    suction_extent: Annotated[Real | None, _EXTENT] = None
    longitudinal_length: Annotated[Real | None, common.AXIAL_LENGTH] = None
    transverse_length: Annotated[Real | None, common.LATERAL_LENGTH] = None
    constant: Annotated[Real | None, common.CONSTANT_FRICTION] = None
    longitudinal_mobilisation: Annotated[Real | None, common.AXIAL_MOBILISATION] = None
    transverse_mobilisation: Annotated[Real | None, common.LATERAL_MOBILISATION] = None


class ElasticSurface(Surface):
    """Elastic seabed."""

    rule: ClassVar[str] = "elastic_surface"
    names: ClassVar[tuple[str, ...]] = ("ELASTIC SURFACE",)
    summary: ClassVar[str] = "Elastic seabed: stiffness, friction, slope or profile (superseded by *SEABED PROPERTIES)."
    example: ClassVar[str] = "*ELASTIC SURFACE\n 50000.0, 0.3, 0.5\n"

    keyword: Literal["ELASTIC SURFACE"] = "ELASTIC SURFACE"
    properties: Annotated[ElasticProperties, about("stiffness, friction, lateral resistance, suction")]


BLOCK = ElasticSurface
