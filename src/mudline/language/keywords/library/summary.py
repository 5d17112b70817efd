"""Requests of summary postprocessing (`*PARA ...`), time span of the summary, and collated outputs."""

from typing import Annotated, Literal

from mudline.language.keywords.common import *

LOCATION = "place on the section, of outputs that have one"
AXIS = "name of an axis system of *AXIS/VECTOR"


class SummaryRequest(Block):
    """Request with its head."""

    sections = ("SUMMARY POSTPROCESSING",)
    subject = "post-processing"

    title: Annotated[Title | None, setting("TITLE", "title of the output", default="blank")] = None
    scale: Annotated[Real | None, setting("SCALE", "factor on the values", default="1", usual=ANY)] = None
    units: Annotated[
        Name | None, setting("UNITS", "unit of the output", default="of its kind", inline=True, behind="SCALE")
    ] = None
    plot: Annotated[Literal["YES", "NO"] | None, setting("PLOT", "plot beside the summary", default="NO")] = None


LocalNode = Annotated[
    Whole,
    setting("DATA2", "place on the element; 1 first node, 2 middle, 3 second node", at_least=1, at_most=3, usual=COUNT),
]


class ForceVariable(Row):
    """Requested variable."""

    variable: Annotated[Name, about("output variable, in the words of the manual", names=Names.VARIABLE)]
    location: Annotated[Name | None, about(LOCATION)] = None


class ParaAngleElement(SummaryRequest):
    """Angle."""

    rule = "para_angle_element"
    page = "kwd_summarypostprocessing_paraangleelement"
    summary = "The angle between two elements, in the summary."
    example = "*PARA ANGLE ELEMENT\n TITLE=Flex joint\n DATA1=12\n DATA2={Vessel End}\n"

    keyword: Literal["PARA ANGLE ELEMENT"] = "PARA ANGLE ELEMENT"
    first: Annotated[Ident, setting("DATA1", "element number, or its label", names=Names.ELEMENT)]
    second: Annotated[Ident, setting("DATA2", "element number, or its label", names=Names.ELEMENT)]


class ParaForce(SummaryRequest):
    """Force."""

    rule = "para_force"
    page = "kwd_summarypostprocessing_paraforce"
    summary = "A force, moment or similar variable of an element, in the summary."
    example = "*PARA FORCE\n TITLE=Tension\n DATA1={Hang-off}\n DATA2=1\n DATA3=EFFECTIVE TENSION\n"

    keyword: Literal["PARA FORCE"] = "PARA FORCE"
    element: Annotated[Ident, setting("DATA1", "element number, or its label", names=Names.ELEMENT)]
    node: LocalNode
    variable: Annotated[ForceVariable, setting("DATA3", "output variable, and its place")]


class ParaForceEnvelope(SummaryRequest):
    """Extremes of a force."""

    rule = "para_force_envelope"
    page = "kwd_summarypostprocessing_paraforceenvelope"
    summary = "Statistics of a force over the elements of a set, in the summary."
    example = "*PARA FORCE ENVELOPE\n TITLE=Tension\n DATA1=ALL\n DATA2=EFFECTIVE TENSION\n"

    keyword: Literal["PARA FORCE ENVELOPE"] = "PARA FORCE ENVELOPE"
    set_name: Annotated[Name, setting("DATA1", "element set, or ALL", names=Names.SET)]
    variable: Annotated[ForceVariable, setting("DATA2", "output variable, and its place")]


class ParaKinematic(SummaryRequest):
    """Motion."""

    rule = "para_kinematic"
    page = "kwd_summarypostprocessing_parakinematic"
    summary = "A motion, displacement, velocity or acceleration of a node, in the summary."
    example = "*PARA KINEMATIC\n TITLE=Hang-off\n PLOT=YES\n DATA1={Hang-off}\n DATA2=1\n DATA3=2\n"

    keyword: Literal["PARA KINEMATIC"] = "PARA KINEMATIC"
    node: Annotated[Ident, setting("DATA1", "node number, or its label", names=Names.NODE)]
    dof: Annotated[Whole, setting("DATA2", "degree of freedom", at_least=1, at_most=6, usual=COUNT)]
    quantity: Annotated[
        Whole,
        setting("DATA3", "1 motion, 2 displacement, 3 velocity, 4 acceleration", at_least=1, at_most=4, usual=COUNT),
    ]
    axis: Annotated[Name | None, setting("DATA4", AXIS, default="global", names=Names.AXIS)] = None


class ParaReaction(SummaryRequest):
    """Reaction."""

    rule = "para_reaction"
    page = "kwd_summarypostprocessing_parareaction"
    summary = "The reaction at a node in a degree of freedom, in the summary."
    example = "*PARA REACTION\n TITLE=Anchor\n SCALE=0.001, UNITS=kN\n DATA1=1\n DATA2=2\n"

    keyword: Literal["PARA REACTION"] = "PARA REACTION"
    node: Annotated[Ident, setting("DATA1", "node number, or its label", names=Names.NODE)]
    dof: Annotated[Whole, setting("DATA2", "degree of freedom", at_least=1, at_most=6, usual=COUNT)]
    axis: Annotated[Name | None, setting("DATA3", AXIS, default="global")] = None


class ParaSeabed(SummaryRequest):
    """Request for contact with the seabed."""

    rule = "para_seabed"
    page = "kwd_summarypostprocessing_paraseabed"
    summary = "Clearance, length on the seabed, or spans and gaps of a set, in the summary."
    example = "*PARA SEABED\n TITLE=On the seabed\n DATA1=ALL\n DATA2=2\n"

    keyword: Literal["PARA SEABED"] = "PARA SEABED"
    set_name: Annotated[Name, setting("DATA1", "element set, or ALL", names=Names.SET)]
    quantity: Annotated[
        Whole,
        setting(
            "DATA2", "1 clearance, 2 length on the seabed, 3 largest span with its average gaps", at_least=1, at_most=3
        ),
    ]


class SummaryTime(Block):
    """Time span of the summary."""

    rule = "summary_time"
    sections = ("SUMMARY POSTPROCESSING",)
    subject = "post-processing"
    page = "kwd_summarypostprocessing_time"
    summary = "The part of a run that is summarised; by default the whole run."
    example = "*TIME\n START=20.0\n END=120.0\n"

    keyword: Literal["TIME"] = "TIME"
    start: Annotated[
        Real | None,
        setting(
            "START", "time at which it starts; -1 is the last stored step", unit="T", at_least=-1, usual=OF_THE_RUN
        ),
    ] = None
    end: Annotated[Real | None, setting("END", "time at which it ends", unit="T", usual=OF_THE_RUN)] = None


class PlotAxis(Record):
    """Axis of a plot."""

    rule = "plot_axis"
    name: Annotated[Name, about("name of the axis", unique=True)]
    value: Annotated[Real, about("value of this run on it", usual=ANY)]


class CollatePlotAxes(Block):
    """Place of a run in plots."""

    rule = "collate_plot_axes"
    sections = ("SUMMARY POSTPROCESSING",)
    subject = "post-processing"
    page = "kwd_summarypostprocessing_collateplotaxes"
    summary = "Place of a run on the axes of plots over many runs: the name of each axis, and the run's value."
    example = '*COLLATE PLOT AXES\n "Wave Period", 9.0\n Heading, 180.0\n'

    keyword: Literal["COLLATE PLOT AXES"] = "COLLATE PLOT AXES"
    axes: Records[PlotAxis] = Records()


class CollatedOutput(Record):
    """Output, and the runs that are left out."""

    rule = "collated_output"
    title: Annotated[Name, setting("TITLE", "title of the output in each run", unique=True)]
    units: Annotated[Name | None, setting("UNITS", "unit of the output", default="of its kind", inline=True)] = None
    least: Annotated[Real | None, setting("MIN", "runs with a smaller minimum are left out", usual=ANY)] = None
    largest: Annotated[
        Real | None, setting("MAX", "runs with a larger maximum are left out", inline=True, usual=ANY)
    ] = None
    deviation: Annotated[
        Real | None,
        setting("STDDEV", "runs with a larger standard deviation are left out", at_least=0, inline=True, usual=ANY),
    ] = None


class Collate(Block):
    """Collated outputs."""

    rule = "collate"
    sections = ("SUMMARY COLLATE",)
    subject = "post-processing"
    page = "kwd_summarycollate_collate"
    summary = "Outputs to be collated over many runs (by default all), and limits beyond which a run is left out."
    example = "*COLLATE\n TITLE=Tension, UNITS=kN\n MIN=0.0, MAX=2500.0\n TITLE=Clearance\n"

    keyword: Literal["COLLATE"] = "COLLATE"
    outputs: Records[CollatedOutput] = Records()
