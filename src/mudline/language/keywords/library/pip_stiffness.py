"""`*PIP STIFFNESS`: contact between pipes in or on each other."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from mudline.language.keywords.common import require_one
from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, Record, Row, curve_points
from mudline.language.keywords.table import Table
from mudline.language.keywords.usual import ANY, FORCE_CURVE, OF_ITS_CURVE
from mudline.language.keywords.values import Name, Names, Real


class PipPoint(Row):
    """A point of a curve."""

    deflection: Annotated[Real, about("deflection", unit="L", at_least=0, usual=OF_ITS_CURVE)]
    force: Annotated[Real, about("contact force there", unit="F", usual=OF_ITS_CURVE)]


class PowerLaw(Row):
    """The law of TYPE=POWER LAW."""

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
    """A curve, by points or by a law."""

    rule = "pip_curve"
    curve: Annotated[Name, setting("CURVE", "name, for *PIP CONNECTION and *LINES PIP", defines=Names.PIP_STIFFNESS)]
    type_: Annotated[
        Literal["DATA PAIRS", "POWER LAW"] | None,
        setting("TYPE", "points, or a law", default="DATA PAIRS", inline=True),
    ] = Field(default=None, alias="type")
    configuration: Annotated[
        Literal["PIP", "POP"] | None,
        setting("CONFIGURATION", "of POWER LAW: pipe in pipe, or on pipe", default="PIP", inline=True),
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
    def row_slot(cls, number: int, fields: int, given: dict[str, object], last: object) -> str:
        """What TYPE= says."""
        return "law" if given.get("type") == "POWER LAW" else "points"

    @model_validator(mode="after")
    def _fits(self) -> PipCurve:
        """What its type has."""
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
    curves: list[PipCurve] = []


BLOCK = PipStiffness
