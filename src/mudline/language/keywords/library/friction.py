"""`*FRICTION`: seabed friction of an analysis in the frequency domain, or of modes."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import about
from mudline.language.keywords.keeping import OpenBlock
from mudline.language.keywords.usual import Usual
from mudline.language.keywords.values import Real

_NEEDS = "; a direction whose coefficient is 0 stays free"


class LinearFriction(OpenBlock):
    """Stiffnesses that stand for friction; both zero mean that the model is held fast."""

    rule = "friction"
    sections = ("LOAD CASE", "MODES")
    subject = "seabed"
    page = "kwd_loadcase_friction"
    summary = "Stiffnesses that represent seabed friction in the frequency domain and in modes; both 0: held fast."
    example = "*FRICTION\n 500.0, 250.0\n"

    keyword: Literal["FRICTION"] = "FRICTION"
    longitudinal: Annotated[
        Real | None,
        about(
            "stiffness along the line" + _NEEDS,
            unit="F/L2",
            default="0",
            inferred="per unit length",
            usual=Usual(95.0, 2.1e11, remark=True),
        ),
    ] = None
    transverse: Annotated[
        Real | None,
        about(
            "stiffness across the line" + _NEEDS,
            unit="F/L2",
            default="0",
            inferred="per unit length",
            usual=Usual(95.0, 2.1e11, remark=True),
        ),
    ] = None


BLOCK = LinearFriction
