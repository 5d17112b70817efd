"""`*TIME STEPPING`: the scheme that integrates a load case in time."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, Row
from mudline.language.keywords.values import Real


class AlphaParameters(Row):
    """The line of TYPE=GENERALISED-ALPHA without P-INFINITY=."""

    alpha_f: Annotated[
        Real | None, about("alpha_f, the share of the old forces", unit="-", default="0.286", at_least=0, at_most=0.5)
    ] = None
    alpha_m: Annotated[
        Real | None,
        about("alpha_m, the share of the old accelerations", unit="-", default="-0.143", at_least=-1, at_most=0.5),
    ] = None


class HilberHughes(Row):
    """The line of TYPE=HILBER-HUGHES."""

    coefficient: Annotated[
        Real | None, about("coefficient, from -1/3 to 0", unit="-", default="-0.25", at_least=-0.3334, at_most=0)
    ] = None


class TimeStepping(Block):
    """The scheme of implicit steps."""

    rule = "time_stepping"
    sections = ("LOAD CASE",)
    subject = "analysis"
    page = "kwd_loadcase_timestepping"
    summary = "Scheme of the implicit time steps, and how it damps the highest frequencies."
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
    def row_slot(cls, number: int, fields: int, given: dict[str, object], last: object) -> str:
        """The parameters of the scheme that TYPE= chose."""
        return "hilber_hughes" if given.get("type_", given.get("type")) == "HILBER-HUGHES" else "alphas"

    @model_validator(mode="after")
    def _fits(self) -> TimeStepping:
        """Each scheme has its own parameters, given once."""
        of_alpha, of_hughes = self.infinity is not None or self.alphas is not None, self.hilber_hughes is not None
        if (of_alpha and self.type_ == "HILBER-HUGHES") or (of_hughes and self.type_ != "HILBER-HUGHES"):
            raise ValueError(
                f"TYPE={self.type_ or 'GENERALISED-ALPHA'} does not take the parameters of the other scheme"
            )
        if self.infinity is not None and self.alphas is not None:
            raise ValueError("give P-INFINITY= or the line of alpha_f and alpha_m, not both")
        return self
