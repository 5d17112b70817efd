"""`*EXCEL VARIATIONS`: decks to be made from a table of parameters in a workbook."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import setting
from mudline.language.keywords.model import Block
from mudline.language.keywords.values import Name, Names


class ExcelVariations(Block):
    """Decks from a workbook."""

    rule = "excel_variations"
    sections = ("PREPROCESSOR",)
    subject = "deck"
    page = "kwd_preprocessor_excelvariations"
    summary = "Decks to be made from a table of parameters in a workbook."
    example = "*EXCEL VARIATIONS\n SUBDIRECTORY=Cases, FILENAME=Case %Number%\n EXCEL=cases.xlsx, RANGE=A1:D20\n"

    keyword: Literal["EXCEL VARIATIONS"] = "EXCEL VARIATIONS"
    directory: Annotated[Name | None, setting("DIRECTORY", "folder of the decks")] = None
    subdirectory: Annotated[Name | None, setting("SUBDIRECTORY", "folder of a deck; %Parameter% is its value")] = None
    filename: Annotated[
        Name | None, setting("FILENAME", "name of a deck; %Parameter% likewise", inline=True, behind="SUBDIRECTORY")
    ] = None
    excel: Annotated[Name, setting("EXCEL", "workbook", names=Names.FILE)]
    sheet: Annotated[Name | None, setting("SHEET", "its sheet", default="the first", inline=True)] = None
    cells: Annotated[Name, setting("RANGE", "cells with the table", inline=True)]
    orientation: Annotated[
        Literal["HORIZONTAL"] | None, setting("ORIENTATION", "names are in the first column", inline=True)
    ] = None


BLOCK = ExcelVariations
