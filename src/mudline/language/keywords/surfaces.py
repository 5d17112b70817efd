"""What the keywords of the legacy seabed surfaces share: friction, and a slope or a profile of the seabed."""

from __future__ import annotations

from typing import Annotated

from mudline.language.keywords.common import CONSTANT_FRICTION
from mudline.language.keywords.fields import about
from mudline.language.keywords.model import Block, Row, rows
from mudline.language.keywords.table import Table
from mudline.language.keywords.usual import ANY, FRICTION, MOBILISATION, MODEL, POSITION, Usual
from mudline.language.keywords.values import Real, Successor

_CHARACTERISTIC_LENGTH = "10 ft or 3.048 m"
_SLOPE = "a line of one value is a slope, one of two a point of the profile: nothing else tells them apart"
SURFACE_SUCCESSORS = (Successor("SEABED PROPERTIES"), Successor("SEABED PROFILE"))


class ProfilePoint(Row):
    """A point of an inline profile."""

    y: Annotated[Real, about("horizontal coordinate Y", unit="L", usual=POSITION)]
    elevation: Annotated[Real, about("elevation of the seabed there", unit="L", usual=POSITION)]


class FrictionCoefficients(Row):
    """Friction coefficients of a legacy surface."""

    longitudinal: Annotated[
        Real | None, about("longitudinal friction coefficient", unit="-", default="0", at_least=0, usual=FRICTION)
    ] = None
    transverse: Annotated[
        Real | None, about("transverse friction coefficient", unit="-", default="0", at_least=0, usual=FRICTION)
    ] = None


class FrictionLengths(Row):
    """What else a legacy surface says of friction."""

    longitudinal_length: Annotated[
        Real | None,
        about(
            "largest longitudinal characteristic length",
            unit="L",
            default=_CHARACTERISTIC_LENGTH,
            above=0,
            usual=Usual(high=100.0, why="10 ft by default", remark=True),
        ),
    ] = None
    transverse_length: Annotated[
        Real | None,
        about(
            "largest transverse characteristic length",
            unit="L",
            default=_CHARACTERISTIC_LENGTH,
            above=0,
            usual=Usual(high=100.0, why="10 ft by default", remark=True),
        ),
    ] = None
    constant: Annotated[
        Real | None, about("constant friction force coefficient", inferred=CONSTANT_FRICTION, usual=ANY)
    ] = None
    longitudinal_mobilisation: Annotated[
        Real | None, about("longitudinal mobilisation length", unit="L", above=0, usual=MOBILISATION)
    ] = None
    transverse_mobilisation: Annotated[
        Real | None, about("transverse mobilisation length", unit="L", above=0, usual=MOBILISATION)
    ] = None


class Surface(Block):
    """A legacy surface: a line of properties, then a slope or a profile."""

    properties: Annotated[Row, about("properties of the surface")]
    slope: Annotated[
        Real | None,
        about("slope of the seabed about the origin", unit="deg", default="flat", inferred=_SLOPE, usual=MODEL),
    ] = None
    profile: Annotated[
        Table | None,
        rows(ProfilePoint, "arbitrary profile: Y and elevation, a line of two values a point", unordered=True),
    ] = None

    @classmethod
    def row_slot(cls, number: int, fields: int, given: dict[str, object], last: object) -> str:
        """The first line holds the properties; then one value is a slope, two are a point of the profile."""
        return "properties" if number == 0 else "slope" if fields == 1 else "profile"
