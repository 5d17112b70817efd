"""Pipe in pipe: sections, their connections, and lines in or on each other."""

from typing import Annotated, Literal, Self

from mudline.language.keywords.common import *


class PipSets(Record):
    """Set inside another set."""

    rule = "pip_sets"
    outer: Annotated[Name, setting("OUTER", "set of the outer pipe", names=Names.SET)]
    inner: Annotated[Name, setting("INNER", "set of the inner pipe", names=Names.SET, inline=True)]


class PipSections(Block):
    """Pipes in pipes."""

    rule = "pip_section"
    page = "kwd_model_pipsection"
    summary = "Element sets that lie inside other element sets."
    example = "*PIP SECTION\n INNER_HYDRO=LHS, AUTO_CREATE=YES\n OUTER=Outer Pipe, INNER=Inner Pipe\n"

    keyword: Literal["PIP SECTION"] = "PIP SECTION"
    inner_hydro: Annotated[
        Literal["LHS", "RHS"] | None, setting("INNER_HYDRO", "side of the equations of the inner forces", default="LHS")
    ] = None
    auto_create: Annotated[
        Literal["YES", "NO"] | None,
        setting("AUTO_CREATE", "create connections automatically", default="YES", inline=True),
    ] = None
    pipes: Records[PipSets] = Records()


class PipPoint(Row):
    """Point of a curve."""

    deflection: Annotated[Real, about("deflection", unit="L", at_least=0, usual=OF_ITS_CURVE)]
    force: Annotated[Real, about("contact force there", unit="F", usual=OF_ITS_CURVE)]


class PowerLaw(Row):
    """Power law of TYPE=POWER LAW."""

    largest: Annotated[Real, about("largest contact force", unit="F", at_least=0, usual=ANY)]
    exponent: Annotated[
        Real | None,
        about(
            "exponent",
            default="5",
            above=0,
            inferred="the default: a page on theory says 10, that of the keyword 5",
            usual=ANY,
        ),
    ] = None


class PipCurve(Record):
    """Curve, by points or by a law."""

    rule = "pip_curve"
    curve: Annotated[Name, setting("CURVE", "name, for *PIP CONNECTION and *LINES PIP", defines=Names.PIP_STIFFNESS)]
    type_: Annotated[
        Literal["DATA PAIRS", "POWER LAW"] | None,
        setting("TYPE", "points, or a law", default="DATA PAIRS", inline=True),
    ] = Field(default=None, alias="type")
    configuration: Annotated[
        Literal["PIP", "POP"] | None,
        setting("CONFIGURATION", "for POWER LAW: pipe in pipe, or pipe on pipe", default="PIP", inline=True),
    ] = None
    law: Annotated[PowerLaw | None, about("of POWER LAW: its line")] = None
    points: Annotated[
        Table | None,
        curve_points(
            PipPoint,
            "of DATA PAIRS: points in any order; at least two",
            "pipe-in-pipe stiffness",
            abscissa="deflection",
            usual=FORCE_CURVE,
        ),
    ] = None

    @classmethod
    def row_slot(cls, number: int, fields: int, values: dict[str, object], last: object) -> str:
        """Return the field of the form in TYPE=."""
        return "law" if values.get("type") == "POWER LAW" else "points"

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Raise ValueError unless the curve has the data of its type."""
        require_one(self, "law" if self.type_ == "POWER LAW" else "points")
        require_one(self, "law", "points")
        return self


class PipStiffness(Block):
    """Contact curves."""

    rule = "pip_stiffness"
    page = "kwd_model_pipstiffness"
    summary = "Non-linear contact of pipe in pipe or pipe on pipe: force against deflection, or a power law."
    example = "*PIP STIFFNESS\n CURVE=Spacer\n 0.0, 0.0\n 0.01, 5.0E4\n CURVE=Law, TYPE=POWER LAW\n 1.0E6, 5.0\n"

    keyword: Literal["PIP STIFFNESS"] = "PIP STIFFNESS"
    curves: Records[PipCurve] = Records()


_CURVES = "the curve is one of *PIP STIFFNESS, as of *LINES PIP"
_SLIDING = "the form of many sliding connections: that of one, with GEN= in place of its node"
Stiffness = Annotated[
    Real | None, setting("STIFFNESS", "stiffness, or give CURVE=", unit="F/L", inline=True, usual=ANY)
]
CurveName = Annotated[
    Name | None,
    setting(
        "CURVE", "curve of *PIP STIFFNESS, or give STIFFNESS=", inline=True, inferred=_CURVES, names=Names.PIP_STIFFNESS
    ),
]
AxialStiffness = Annotated[
    Real | None,
    setting("AXIAL_STIFF", "for sliding connections: axial stiffness", unit="F/L", at_least=0, inline=True, usual=ANY),
]
AxialCurve = Annotated[Name | None, setting("AXIAL_NONLINEAR", "for sliding connections: axial curve", inline=True)]


class PipRange(ListRow):
    """First and last node, and the step between them."""

    start: Annotated[Ident, about("first node", names=Names.NODE)]
    end: Annotated[Ident, about("last node", names=Names.NODE)]
    increment: Annotated[Whole | None, about("step", default="1", at_least=1, usual=COUNT)] = None


class PipPair(Record):
    """Node that is held at a second node, or slides along a set."""

    rule = "pip_pair"
    primary: Node
    secondary: Annotated[Ident | None, about("node that it is held at, or give SET=", names=Names.NODE)] = None
    set_name: Annotated[Name | None, setting("SET", "set that it slides along", names=Names.SET, inline=True)] = Field(
        default=None, alias="set"
    )
    stiffness: Stiffness = None
    curve: CurveName = None
    axial_stiffness: AxialStiffness = None
    axial_curve: AxialCurve = None


class PipPairs(Record):
    """Range of pairs."""

    rule = "pip_pairs"
    generate: Annotated[PipRange, setting("GEN", "primary nodes")]
    second: Annotated[PipRange | None, setting("GEN", "secondary nodes, or give SET=", inline=True)] = None
    set_name: Annotated[
        Name | None, setting("SET", "set that they slide along", names=Names.SET, inline=True, inferred=_SLIDING)
    ] = Field(default=None, alias="set")
    stiffness: Stiffness = None
    curve: CurveName = None
    axial_stiffness: AxialStiffness = None
    axial_curve: AxialCurve = None


class PipConnections(Block):
    """Connections."""

    rule = "pip_connection"
    page = "kwd_model_pipconnection"
    summary = "Connections of pipes in or on each other: between two nodes, or sliding along a set."
    example = "*PIP CONNECTION\n 12, 112, STIFFNESS=1.0E6\n GEN=13, 20, GEN=113, 120, CURVE=Spacer\n"

    keyword: Literal["PIP CONNECTION"] = "PIP CONNECTION"
    orientation: Annotated[Name | None, setting("ORIENTATION", "from present or from initial positions")] = None
    bandwidth: Annotated[Literal["UPDATED"] | None, setting("BANDWIDTH", "renumbered as the pipes slide")] = None
    tolerance: Annotated[
        Real | None, setting("PENETRATION_TOLERANCE", "tolerance of penetration", at_least=0, usual=ANY)
    ] = None
    connections: Records[PipPair | PipPairs] = Records()


class Spacing(Row):
    """Positions of connections, measured from the start of the primary line."""

    spacing: Annotated[Real | None, about("distance between two", unit="L", above=0, usual=ALONG)] = None
    start: Annotated[Real | None, about("distance of the first", unit="L", at_least=0, usual=ALONG)] = None
    end: Annotated[Real | None, about("distance of the last", unit="L", at_least=0, usual=ALONG)] = None


class _ConnectionStiffness(Row):
    stiffness: Annotated[Real, about("stiffness", unit="F/L", at_least=0, usual=ANY)]


class _Curve(Row):
    curve: Annotated[Name, about("curve of *PIP STIFFNESS", names=Names.PIP_STIFFNESS)]


class _Bulkhead(Row):
    bulkhead: Annotated[Literal["BULKHEAD"], about("the word")]


class StiffConnections(Spacing, _ConnectionStiffness):  # the last base's fields first
    """Values of STIFFNESS=."""


class CurveConnections(Spacing, _Curve):
    """Values of CURVE=."""


class Bulkheads(Spacing, _Bulkhead):
    """Line of bulkheads."""


class PipLink(Record):
    """Line of connections."""

    rule = "pip_link"
    stiffness: Annotated[StiffConnections | None, setting("STIFFNESS", "connections of a stiffness")] = None
    curve: Annotated[CurveConnections | None, setting("CURVE", "connections with a curve")] = None
    bulkhead: Annotated[Bulkheads | None, about("bulkheads")] = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Raise ValueError unless a link has exactly one kind of connection."""
        require_one(self, "stiffness", "curve", "bulkhead")
        return self


class LinePair(Record):
    """Two lines."""

    rule = "line_pair"
    primary: Annotated[Name, setting("PRIMARY", "line of *LINES", names=Names.LINE)]
    secondary: Annotated[Name, setting("SECONDARY", "line in or on it", inline=True, names=Names.LINE)]
    type_: Annotated[
        Literal["PIP", "POP"] | None,
        setting("TYPE", "pipe in pipe, or on pipe", default="PIP", inline=True, inferred="it may be left out"),
    ] = Field(default=None, alias="type")
    offset: Annotated[
        Real | None, setting("OFFSET", "offset along the line", unit="L", default="0", inline=True, usual=ALONG)
    ] = None
    links: Records[PipLink] = Records()


class LinesPip(Block):
    """Pairs of lines."""

    rule = "lines_pip"
    page = "kwd_model_linespip"
    summary = "Lines that lie in or on each other, and their connections."
    example = (
        "*LINES PIP\n PRIMARY=Carrier, SECONDARY=Flowline, TYPE=PIP\n STIFFNESS=1.0E6, 12.0, 0.0, 480.0\n"
        " BULKHEAD, 240.0, 0.0, 480.0\n"
    )

    keyword: Literal["LINES PIP"] = "LINES PIP"
    pairs: Records[LinePair] = Records()
