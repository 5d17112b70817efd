"""Analysis of a load case: kind of run, time, steps, convergence, contact, restart, storage of results."""

from typing import Annotated, Literal, Self

from mudline.language.keywords.common import *

_PAGE = (
    "no page of the manual was found: the types are those of known decks, other words and lines are passed through "
    "unchanged"
)
_TYPES = ("STATIC", "QUASI-STATIC", "DYNAMIC", "TIME DOMAIN", "FREQUENCY DOMAIN")


class AnalysisType(OpenBlock):
    """Kind of run."""

    rule = "analysis_type"
    sections = ("LOAD CASE", "ANALYSIS")
    subject = "analysis"
    summary = "Kind of run of a load case: static, or dynamic in the time or frequency domain."
    example = "*ANALYSIS TYPE\n TYPE=STATIC\n"

    keyword: Literal["ANALYSIS TYPE"] = "ANALYSIS TYPE"
    type_: Annotated[
        Literal["STATIC", "QUASI-STATIC", "DYNAMIC", "TIME DOMAIN", "FREQUENCY DOMAIN"] | Other | None,
        setting("TYPE", "kind of run", inferred=_PAGE, opaque=_TYPES),
    ] = Field(default=None, alias="type")


_START = "time at which the run starts"
_END = "time at which it ends"
_RAMP = "time over which loads grow"


class FixedSpan(Row):
    """Line under STEP=FIXED."""

    start: Annotated[Real, about(_START, unit="T", usual=OF_THE_RUN)]
    end: Annotated[Real, about(_END, unit="T", usual=OF_THE_RUN)]
    increment: Annotated[
        Real | None,
        about(
            "time step; a static run may leave it out",
            unit="T",
            default="end - start",
            above=0,
            also="step",
            usual=STEP,
        ),
    ] = None
    ramp: Annotated[Real | None, about(_RAMP, unit="T", at_least=0, usual=OF_THE_RUN)] = None


class VariableSpan(Row):
    """First line under STEP=VARIABLE."""

    start: Annotated[Real, about(_START, unit="T", usual=OF_THE_RUN)]
    end: Annotated[Real, about(_END, unit="T", usual=OF_THE_RUN)]
    ramp: Annotated[Real | None, about(_RAMP, unit="T", at_least=0, usual=OF_THE_RUN)] = None


class StepLimits(Record):
    """Line of limits of a variable step; each line after the first gives the time from which it holds."""

    rule = "step_limits"
    suggested: Annotated[Real, about("time step to begin with", unit="T", above=0, usual=STEP)]
    least: Annotated[Real, about("smallest time step", unit="T", above=0, usual=OF_THE_RUN)]
    largest: Annotated[Real, about("largest time step", unit="T", above=0, usual=STEP)]
    length: Annotated[Real | None, about("step length", default="0.055", above=0, usual=OF_THE_RUN)] = None
    since: Annotated[Real | None, about("time from which the line holds", unit="T", usual=OF_THE_RUN)] = None


class TimeSpan(Block):
    """Span of time with a fixed or a variable step."""

    rule = "time"
    sections = ("LOAD CASE",)
    subject = "analysis"
    page = "kwd_loadcase_time"
    summary = "Start and end time of a load case, and its time steps: of fixed length, or between limits."
    sticky = "step"
    example = "*TIME\n STEP=FIXED\n 0.0, 120.0, 0.05, 24.0\n"

    keyword: Literal["TIME"] = "TIME"
    step: Annotated[
        Literal["FIXED", "VARIABLE"] | None,
        setting("STEP", "fixed length of the steps, or limits", default="FIXED", inferred="its default, FIXED"),
    ] = None
    fixed: Annotated[FixedSpan | None, about("span under STEP=FIXED")] = None
    variable: Annotated[VariableSpan | None, about("span under STEP=VARIABLE")] = None
    limits: Records[StepLimits] = Records()

    @classmethod
    def row_slot(cls, number: int, fields: int, values: dict[str, object], last: object) -> str:
        """Return the span of the chosen STEP=."""
        return str(values.get("step") or "FIXED").lower()

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Raise ValueError unless the lines are those of the chosen STEP=."""
        step = self.step or "FIXED"
        if getattr(self, step.lower()) is None or (self.fixed and self.variable):
            raise ValueError(f"STEP={step} needs the span {step.lower()!r}, and no other")
        if step == "VARIABLE" and not self.limits:
            raise ValueError("STEP=VARIABLE needs a line of suggested, least and largest step below its first line")
        if step == "FIXED" and self.limits:
            raise ValueError("STEP=FIXED takes one line: start, end, step and ramp")
        if any(limit.since is None for limit in self.limits[1:]):
            raise ValueError("each line of step limits after the first needs the time from which it holds")
        return self


class NonLinearStatic(Block):
    """Steps and iterations."""

    rule = "non_linear_static"
    sections = ("LOAD CASE",)
    subject = "analysis"
    page = "kwd_loadcase_nonlinearstatic"
    summary = "Steps, tolerance and iterations of the static solution before dynamics in the frequency domain."
    example = "*NON LINEAR STATIC\n 5, 0.001, 40\n"

    keyword: Literal["NON LINEAR STATIC"] = "NON LINEAR STATIC"
    steps: Annotated[Whole | None, about("number of steps", default="1", at_least=1, usual=COUNT)] = None
    tolerance: Annotated[
        Real | None,
        about(
            "tolerance", unit="-", default="0.001", above=0, usual=Usual(high=0.1, why="0.001 by default", remark=True)
        ),
    ] = None
    iterations: Annotated[
        Whole | None, about("largest number of iterations", default="20", at_least=1, usual=COUNT)
    ] = None


_UNCHECKED = "without it this is not checked"
_BOTH = "the manual writes STATIC/TIME for both: the words alone are taken too"
_REPEATED = "several lines, each of another ANALYSIS="


class StepTolerances(Row):
    """Line of static runs and of the time domain."""

    displacement: Annotated[
        Real | None,
        about(
            "largest change of the solution", unit="-", default="0.001 in a static run, else 0.025", above=0, usual=ANY
        ),
    ] = None
    iterations: Annotated[Whole | None, about("most iterations", default="20", at_least=1, usual=COUNT)] = None
    torque: Annotated[
        Real | None, about("torque that counts as small", unit="F L", default="10", at_least=0, usual=ANY)
    ] = None
    penetration: Annotated[
        Real | None, about(f"penetration of a rigid seabed; {_UNCHECKED}", unit="L", above=0, usual=ANY)
    ] = None
    reaction: Annotated[
        Real | None, about(f"size of a negative reaction of a rigid seabed; {_UNCHECKED}", unit="F", above=0, usual=ANY)
    ] = None
    energy: Annotated[Real | None, about(f"energy tolerance; {_UNCHECKED}", unit="-", above=0, usual=ANY)] = None


class FrequencyTolerances(Row):
    """Line of the frequency domain."""

    tolerance: Annotated[Real | None, about("tolerance", unit="-", default="0.025", above=0, usual=ANY)] = None
    iterations: Annotated[Whole | None, about("most iterations", default="20", at_least=1, usual=COUNT)] = None
    relaxation: Annotated[
        Real | None,
        about("relaxation, the share of the new solution", unit="-", default="0.8", above=0, at_most=1, usual=ANY),
    ] = None


class Tolerances(Record):
    """Tolerances of a kind of run."""

    rule = "tolerances"
    analysis: Annotated[
        Literal["STATIC", "TIME", "STATIC/TIME", "FREQUENCY"] | None,
        setting("ANALYSIS", "kind of run", default="STATIC/TIME", inferred=f"its default; {_BOTH}"),
    ] = None
    steps: Annotated[StepTolerances | None, about("of STATIC and TIME", inferred=_REPEATED)] = None
    frequency: Annotated[FrequencyTolerances | None, about("of FREQUENCY")] = None

    @classmethod
    def row_slot(cls, number: int, fields: int, values: dict[str, object], last: object) -> str:
        """Return the line for the kind of run in ANALYSIS=."""
        return "frequency" if values.get("analysis") == "FREQUENCY" else "steps"

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Raise ValueError unless the line is that of the kind of run."""
        require_one(self, "frequency" if self.analysis == "FREQUENCY" else "steps")
        require_one(self, "steps", "frequency")
        return self


class Tolerance(Block):
    """Convergence tolerances of iterations."""

    rule = "tolerance"
    sections = ("LOAD CASE",)
    subject = "analysis"
    page = "kwd_loadcase_tolerance"
    summary = "Convergence tolerances of the iterations of a step, and their largest number."
    example = "*TOLERANCE\n ANALYSIS=FREQUENCY\n 0.025, 30, 0.8\n"

    keyword: Literal["TOLERANCE"] = "TOLERANCE"
    tolerances: Records[Tolerances] = Records()

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Raise ValueError unless each kind of run has at most one line."""
        kinds = [line.analysis or "STATIC/TIME" for line in self.tolerances]
        if len(set(kinds)) < len(kinds):
            raise ValueError("each ANALYSIS= may stand once: keep one line of each")
        return self


class Criterion(Record):
    """Value to be reached."""

    rule = "criterion"
    criterion: Annotated[
        Literal[
            "HANGOFF ANGLE",
            "TENSION",
            "AXIAL STRESS",
            "AXIAL STRAIN",
            "BENDING STRESS",
            "BENDING STRAIN",
            "BENDING MOMENT",
            "SUPPORT REACTION",
            "SEABED CONTACT",
            "VON MISES STRESS",
        ],
        setting("CRITERION", "quantity"),
    ]
    monitor: Annotated[Name, setting("MONITOR", "element, element set or guide to be monitored", inline=True)]
    target: Annotated[Real, setting("TARGET", "value to be reached", inline=True, usual=ANY)]
    tolerance: Annotated[
        Real | None, setting("TOLERANCE", "tolerance", unit="%", default="1", above=0, inline=True, usual=ANY)
    ] = None


class Criteria(Block):
    """Criteria of a static run."""

    rule = "criteria"
    sections = ("LOAD CASE",)
    subject = "analysis"
    page = "kwd_loadcase_criteria"
    summary = "Target of a static run, and the object that is moved or lengthened until it is reached."
    example = (
        "*CRITERIA\n CRITERION=TENSION, MONITOR=12, TARGET=2.5E5\n VARIABLE=VESSEL, ADJUST=FPSO, VECTOR=Away\n"
        " MAX ITERATIONS=50\n"
    )

    keyword: Literal["CRITERIA"] = "CRITERIA"
    criteria: Records[Criterion] = Records()
    variable: Annotated[Literal["NODE", "VESSEL", "LENGTH"] | None, setting("VARIABLE", "what is changed")] = None
    option: Annotated[
        Literal["LENGTH"] | None,
        setting("OPTION", "the same of a length", inferred="the manual prints OPTION=LENGTH; VARIABLE=LENGTH is taken"),
    ] = None
    adjust: Annotated[Name, setting("ADJUST", "node, vessel, element or set that is changed", inline=True)]
    vector: Annotated[
        Name | None, setting("VECTOR", "of NODE and VESSEL: direction, of *VECTOR", inline=True, names=Names.VECTOR)
    ] = None
    iterations: Annotated[Whole | None, setting("MAX ITERATIONS", "most iterations", at_least=1, usual=COUNT)] = None
    least: Annotated[
        Real | None, setting("MIN ADJUSTMENT", "smallest change", inline=True, behind="MAX ITERATIONS", usual=ANY)
    ] = None
    largest: Annotated[
        Real | None, setting("MAX ADJUSTMENT", "largest change", inline=True, behind="MAX ITERATIONS", usual=ANY)
    ] = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Raise ValueError unless the criteria change either a variable or an option."""
        require_one(self, "variable", "option")
        return self


class ContactModelling(Block):
    """Ramp of contact."""

    rule = "contact_modelling"
    sections = ("LOAD CASE",)
    subject = "analysis"
    page = "kwd_loadcase_contactmodelling"
    summary = "Ramp of the contact with guides over a distance."
    example = "*CONTACT MODELLING\n RAMP=0.01, POWER=1.5\n"

    keyword: Literal["CONTACT MODELLING"] = "CONTACT MODELLING"
    ramp: Annotated[
        Real, setting("RAMP", "distance over which contact grows; 0 without", unit="L", at_least=0, usual=ANY)
    ]
    power: Annotated[
        Real | None, setting("POWER", "exponent of the growth", default="1.5", above=0, inline=True, usual=ANY)
    ] = None


_WORDS = "the manual writes DYNAMIC/STATIC for both: the words alone are taken too"


class Restart(OpenBlock):
    """Earlier run that this run continues."""

    rule = "restart"
    known_forms = True
    sections = ("LOAD CASE",)
    subject = "analysis"
    page = "kwd_loadcase_restart"
    summary = "The deck that this deck continues, and whose model it takes over."
    example = "*RESTART\n LAST=static\n"

    keyword: Literal["RESTART"] = "RESTART"
    last: Annotated[
        Name,
        setting(
            "LAST",
            "file of the deck before, beside this one; its suffix may be left out",
            inferred="the model of that deck comes before what this deck has of its own",
            names=Names.DECK,
        ),
    ]
    type_: Annotated[
        Literal["DYNAMIC", "STATIC", "DYNAMIC/STATIC", "CONTINUATION"] | None,
        setting(
            "TYPE", "with new loads, or the same run continued", default="DYNAMIC/STATIC", inline=True, inferred=_WORDS
        ),
    ] = Field(default=None, alias="type")
    option: Annotated[
        Literal["APPEND"] | None,
        setting("OPTION", "results go on in the same file, for a CONTINUATION", inline=True),
    ] = None


class Database(Block):
    """Times at which results are stored."""

    rule = "database"
    sections = ("LOAD CASE",)
    subject = "analysis"
    page = "kwd_loadcase_database"
    summary = "Times at which results are stored: all, selected, the end, or none. Once in a load case."
    example = "*DATABASE\n TIME=SELECTED\n 60.0, 0.5\n"

    keyword: Literal["DATABASE"] = "DATABASE"
    time: Annotated[Literal["ALL", "SELECTED", "END", "NONE"], setting("TIME", "the times")]
    start: Annotated[
        Real | None,
        about("of SELECTED: first time", unit="T", default="the start of the run", at_least=0, usual=OF_THE_RUN),
    ] = None
    interval: Annotated[Real | None, about("of SELECTED: time between two", unit="T", above=0, usual=STORED)] = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Raise ValueError for a line of times, unless selected times are stored."""
        if self.time == "SELECTED" and self.interval is None:
            raise ValueError("TIME=SELECTED needs a line `start, interval` below it")
        if self.time != "SELECTED" and (self.start is not None or self.interval is not None):
            raise ValueError(f"TIME={self.time} takes no line below it: only SELECTED does")
        return self


class AlphaParameters(Row):
    """Line of TYPE=GENERALISED-ALPHA without P-INFINITY=."""

    alpha_f: Annotated[
        Real | None, about("alpha_f, the share of the old forces", unit="-", default="0.286", at_least=0, at_most=0.5)
    ] = None
    alpha_m: Annotated[
        Real | None,
        about("alpha_m, the share of the old accelerations", unit="-", default="-0.143", at_least=-1, at_most=0.5),
    ] = None


class HilberHughes(Row):
    """Line of TYPE=HILBER-HUGHES."""

    coefficient: Annotated[
        Real | None, about("coefficient, from -1/3 to 0", unit="-", default="-0.25", at_least=-0.3334, at_most=0)
    ] = None


class TimeStepping(Block):
    """Scheme of implicit steps."""

    rule = "time_stepping"
    sections = ("LOAD CASE",)
    subject = "analysis"
    page = "kwd_loadcase_timestepping"
    summary = "Scheme of implicit time stepping, and its damping of the highest frequencies."
    example = "*TIME STEPPING\n TYPE=GENERALISED-ALPHA, P-INFINITY=0.4\n"

    keyword: Literal["TIME STEPPING"] = "TIME STEPPING"
    type_: Annotated[
        Literal["GENERALISED-ALPHA", "HILBER-HUGHES"] | None,
        setting("TYPE", "scheme", default="GENERALISED-ALPHA"),
    ] = Field(default=None, alias="type")
    infinity: Annotated[
        Real | None,
        setting(
            "P-INFINITY",
            "spectral radius at infinite frequency, which gives alpha_f and alpha_m",
            unit="-",
            default="0.4",
            at_least=0,
            at_most=1,
            inline=True,
            inferred="a line of its own too",
        ),
    ] = None
    alphas: Annotated[AlphaParameters | None, about("parameters of GENERALISED-ALPHA, instead of P-INFINITY=")] = None
    hilber_hughes: Annotated[HilberHughes | None, about("parameter of HILBER-HUGHES")] = None

    @classmethod
    def row_slot(cls, number: int, fields: int, values: dict[str, object], last: object) -> str:
        """Return the parameters of the scheme in TYPE=."""
        return "hilber_hughes" if values.get("type_", values.get("type")) == "HILBER-HUGHES" else "alphas"

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Raise ValueError unless the scheme has its own parameters, given once."""
        of_alpha, of_hughes = self.infinity is not None or self.alphas is not None, self.hilber_hughes is not None
        if (of_alpha and self.type_ == "HILBER-HUGHES") or (of_hughes and self.type_ != "HILBER-HUGHES"):
            raise ValueError(
                f"TYPE={self.type_ or 'GENERALISED-ALPHA'} does not take the parameters of the other scheme"
            )
        if self.infinity is not None and self.alphas is not None:
            raise ValueError("give P-INFINITY= or the line of alpha_f and alpha_m, not both")
        return self
