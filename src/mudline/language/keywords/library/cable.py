"""`*CABLE`: cables along which `*NODE,CURVILINEAR` places nodes (superseded, still legal)."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import about
from mudline.language.keywords.keeping import OpenBlock, OpenRecord
from mudline.language.keywords.usual import ALONG
from mudline.language.keywords.values import Ident, Names, Real, Whole

_LINE = "one line with these four data in this order, as the page names the data and not the line; others are kept"


class CableLine(OpenRecord):
    """A cable."""

    rule = "cable_line"
    cable: Annotated[Whole, about("number of the cable", defines=Names.CABLE, inferred=_LINE)]
    start: Annotated[Ident, about("node where it starts", names=Names.NODE)]
    end: Annotated[Ident, about("node where it ends", names=Names.NODE)]
    length: Annotated[Real, about("length", unit="L", above=0, usual=ALONG)]


class Cables(OpenBlock):
    """Cables."""

    rule = "cable"
    page = "theory_geomety_cables_data"
    summary = "Cables between two nodes, along which *NODE,CURVILINEAR places others (older than *LINES)."
    example = "*CABLE\n 1, 1, 41, 565.6\n"

    keyword: Literal["CABLE"] = "CABLE"
    cables: list[CableLine] = []


BLOCK = Cables
