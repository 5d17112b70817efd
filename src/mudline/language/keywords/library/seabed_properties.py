"""Contact of the seabed by element set, and the legacy surfaces that are superseded by it."""

from typing import Annotated, Literal

from mudline.language.keywords.common import *

_CONSTANT_FRICTION = (
    "no meaning: the manual names the field and says neither what it does nor its unit, so the value is kept and no "
    "friction is computed from it"
)
_AT_MEAN_DEPTH = "a number acts at the mean depth of the two nodes of an element, as the manual says of curves"
_SUCTION_STIFFNESS = (
    "the unit, which the manual does not give: that of the linear stiffness, a force per unit length for each length "
    "that the pipe rises"
)
_RANGE = "it is above 0, as friction divides by it; the manual gives no range"
_MODAL = "the unit, which the manual does not give: that of the linear stiffness"


class SetFriction(Row):
    """Values of FRICTION=."""

    longitudinal: Annotated[
        Real | None, about("longitudinal friction coefficient", unit="-", default="0", at_least=0, usual=FRICTION)
    ] = None
    transverse: Annotated[
        Real | None, about("transverse friction coefficient", unit="-", default="0", at_least=0, usual=FRICTION)
    ] = None
    longitudinal_mobilisation: Annotated[
        Real | None, about("longitudinal mobilisation length", unit="L", above=0, inferred=_RANGE, usual=MOBILISATION)
    ] = None
    transverse_mobilisation: Annotated[
        Real | None, about("transverse mobilisation length", unit="L", above=0, inferred=_RANGE, usual=MOBILISATION)
    ] = None
    constant: Annotated[
        Real | None, about("constant friction force coefficient", inferred=_CONSTANT_FRICTION, usual=ANY)
    ] = None
    longitudinal_stiffness: Annotated[
        Real | None,
        about(
            "longitudinal friction stiffness of modal and frequency runs",
            unit="F/L2",
            at_least=0,
            inferred=_MODAL,
            usual=Usual(95.0, 2.1e11, remark=True),
        ),
    ] = None
    transverse_stiffness: Annotated[
        Real | None,
        about(
            "transverse friction stiffness of modal and frequency runs",
            unit="F/L2",
            at_least=0,
            inferred=_MODAL,
            usual=Usual(95.0, 2.1e11, remark=True),
        ),
    ] = None


class SetSuction(Row):
    """Values of SUCTION=."""

    stiffness: Annotated[
        Real,
        about(
            "suction stiffness",
            unit="F/L2",
            at_least=0,
            inferred=_SUCTION_STIFFNESS,
            usual=(LEAST_SIDE, Usual(high=1e8, why="soils yield sooner", remark=True)),
        ),
    ]
    extent: Annotated[
        Real | None,
        about(
            "height of the suction zone above the seabed",
            unit="L",
            above=0,
            inferred="it is above 0, as a zone without a height holds nothing; the manual gives no range",
            usual=Usual(high=10.0, why="a few diameters", remark=True),
        ),
    ] = None


class SeabedSet(Record):
    """Contact of one SET=, taken as a whole."""

    rule = "seabed_set"
    set_name: Annotated[Name | None, setting("SET", "element set", default="ALL", inferred=NO_SET, names=Names.SET)] = (
        Field(default=None, alias="set")
    )
    stiffness: Annotated[
        RealOrName | None,
        setting(
            "STIFFNESS",
            "linear stiffness per unit length, or the name of a curve",
            unit="F/L2",
            at_least=0,
            names=Names.CURVE,
            inferred=_AT_MEAN_DEPTH,
            usual=BED,
        ),
    ] = None
    friction: Annotated[SetFriction | None, setting("FRICTION", "friction coefficients and mobilisation")] = None
    lateral: Annotated[
        Real | None,
        setting(
            "LATERAL", "lateral resistance; replaces transverse friction", unit="F/L2", at_least=0, usual=LEAST_SIDE
        ),
    ] = None
    suction: Annotated[SetSuction | None, setting("SUCTION", "suction stiffness and zone")] = None


class SeabedProperties(Block):
    """Seabed contact by set."""

    rule = "seabed_properties"
    subject = "seabed"
    facts = Facts(
        supersedes=True,
        later_wins=True,
        carried=("type_",),
        computed_in="normal-laws",
        telling=("TYPE=ELASTIC", "TYPE=RIGID"),
    )
    page = "kwd_model_seabedproperties"
    summary = "Rigid or elastic seabed; stiffness, friction, lateral resistance and suction by element set."
    example = "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=50000.0\n FRICTION=0.3, 0.5, 0.03, 0.05\n"

    keyword: Literal["SEABED PROPERTIES"] = "SEABED PROPERTIES"
    type_: Annotated[
        Literal["RIGID", "ELASTIC"] | None, setting("TYPE", "contact model; one type in a model; mandatory")
    ] = Field(default=None, alias="type")
    sets: Records[SeabedSet] = Records()


_CHARACTERISTIC_LENGTH = "10 ft or 3.048 m"
_SLOPE = "a line of one value is a slope, one of two a point of the profile: nothing else tells them apart"
_SURFACE_SUCCESSORS = (Successor("SEABED PROPERTIES"), Successor("SEABED PROFILE"))


class ProfilePoint(Row):
    """Point of an inline profile."""

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
    """Lengths for the friction of a legacy surface."""

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
        Real | None, about("constant friction force coefficient", inferred=_CONSTANT_FRICTION, usual=ANY)
    ] = None
    longitudinal_mobilisation: Annotated[
        Real | None, about("longitudinal mobilisation length", unit="L", above=0, usual=MOBILISATION)
    ] = None
    transverse_mobilisation: Annotated[
        Real | None, about("transverse mobilisation length", unit="L", above=0, usual=MOBILISATION)
    ] = None


class Surface(Block):
    """Legacy surface: a line of properties, then a slope or a profile."""

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
    def row_slot(cls, number: int, fields: int, values: dict[str, object], last: object) -> str:
        """Return the field of a row: properties first; then one value is a slope, two are a point of the profile."""
        return "properties" if number == 0 else "slope" if fields == 1 else "profile"


class _Stiffness(Row):
    """Values before the friction coefficients."""

    stiffness: Annotated[
        Real | None,
        about(
            "stiffness per unit length; without it *EMBEDMENT is required",
            unit="F/L2",
            at_least=0,
            inferred=_AT_MEAN_DEPTH,
            usual=BED,
        ),
    ] = None


class _Resistance(Row):
    """Values after the friction coefficients."""

    lateral: Annotated[Real | None, about("lateral stiffness", unit="F/L2", at_least=0, usual=LEAST_SIDE)] = None
    suction_stiffness: Annotated[
        Real | None, about("suction stiffness", unit="F/L2", at_least=0, inferred=_SUCTION_STIFFNESS, usual=LEAST_SIDE)
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
    """Property line of an elastic surface."""


class ElasticSurface(Surface):
    """Elastic seabed."""

    rule = "elastic_surface"
    subject = "seabed"
    facts = Facts(superseded_by=_SURFACE_SUCCESSORS, seabed_type="ELASTIC", beside=("EMBEDMENT",))
    page = "kwd_model_elasticsurface"
    summary = "Elastic seabed: stiffness, friction, slope or profile (superseded by *SEABED PROPERTIES)."
    example = "*ELASTIC SURFACE\n 50000.0, 0.3, 0.5\n"

    keyword: Literal["ELASTIC SURFACE"] = "ELASTIC SURFACE"
    properties: Annotated[ElasticProperties, about("stiffness, friction, lateral resistance, suction")]


class RigidProperties(FrictionLengths, FrictionCoefficients):
    """Property line of a rigid surface."""


class RigidSurface(Surface):
    """Rigid seabed."""

    rule = "rigid_surface"
    subject = "seabed"
    facts = Facts(superseded_by=_SURFACE_SUCCESSORS, seabed_type="RIGID")
    page = "kwd_model_rigidsurface"
    summary = "Rigid seabed: friction, slope or profile (superseded by *SEABED PROPERTIES)."
    example = "*RIGID SURFACE\n 0.3, 0.5\n"

    keyword: Literal["RIGID SURFACE"] = "RIGID SURFACE"
    properties: Annotated[RigidProperties, about("friction")]
