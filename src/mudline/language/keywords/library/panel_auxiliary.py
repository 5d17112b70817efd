"""`*PANEL,AUXILIARY`: panels of auxiliary bodies (superseded, still legal)."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import about
from mudline.language.keywords.model import Block, Row, rows
from mudline.language.keywords.table import Table
from mudline.language.keywords.usual import NUMBER
from mudline.language.keywords.values import Whole

_FORM = "the line: a number and 3 nodes; the manual page was not seen"


class AuxiliaryPanel(Row):
    """An auxiliary panel."""

    panel: Annotated[Whole, about("number", inferred=_FORM, usual=NUMBER)]
    first: Annotated[Whole, about("its first auxiliary node", usual=NUMBER)]
    second: Annotated[Whole, about("its second auxiliary node", usual=NUMBER)]
    third: Annotated[Whole, about("its third auxiliary node", usual=NUMBER)]


class AuxiliaryPanels(Block):
    """Auxiliary panels."""

    rule = "panel_auxiliary"
    summary = "Panels of auxiliary bodies, each between 3 auxiliary nodes."
    tabular = True
    example = "*PANEL,AUXILIARY\n 1, 1001, 1002, 1003\n"

    keyword: Literal["PANEL,AUXILIARY"] = "PANEL,AUXILIARY"
    panels: Annotated[Table | None, rows(AuxiliaryPanel, "auxiliary panels")] = None


BLOCK = AuxiliaryPanels
