"""What the keywords of soil springs share: curves of resistance against displacement, by depth or by node."""

from __future__ import annotations

from typing import Annotated

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.keeping import OpenRecord
from mudline.language.keywords.model import Row, curve_points
from mudline.language.keywords.table import Table
from mudline.language.keywords.usual import OF_ITS_CURVE, SOIL_CURVES, Usual
from mudline.language.keywords.values import Ident, Name, Names, Real

_SOIL_POINTS = "points of the curve: resistance and displacement"


class SoilPoint(Row):
    """A point of a curve: resistance first."""

    resistance: Annotated[
        Real,
        about(
            "soil resistance; it comes first", unit="F/L", inferred="P is per unit length, as T is", usual=OF_ITS_CURVE
        ),
    ]
    displacement: Annotated[
        Real,
        about(
            "displacement of the pipe against the soil",
            unit="L",
            usual=Usual(-5.0, 5.0, "soil yields within a few diameters", meant=0.05, within=30.0),
        ),
    ]


class DepthCurve(OpenRecord):
    """The curve of a depth."""

    rule = "depth_curve"
    depth: Annotated[
        Real,
        setting(
            "DEPTH",
            "depth below the mudline, negative above it",
            unit="L",
            usual=Usual(-500.0, 500.0, "piles are no longer", remark=True),
        ),
    ]
    points: Annotated[
        Table, curve_points(SoilPoint, _SOIL_POINTS, "soil spring curve", abscissa="displacement", usual=SOIL_CURVES)
    ]


class NodeCurve(OpenRecord):
    """The curve of a node."""

    rule = "node_curve"
    node: Annotated[
        Ident, setting("NODE", "node that the curve belongs to", inferred="in place of DEPTH=", names=Names.NODE)
    ]
    points: Annotated[
        Table, curve_points(SoilPoint, _SOIL_POINTS, "soil spring curve", abscissa="displacement", usual=SOIL_CURVES)
    ]


SoilCurves = list[DepthCurve | NodeCurve]
CurvesFile = Annotated[Name | None, setting("FILE", "file with the curves, instead of lines", names=Names.FILE)]
