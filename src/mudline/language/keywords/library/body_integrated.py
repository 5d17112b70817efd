"""`*BODY,INTEGRATED`: bodies that are drawn."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, Record, Row
from mudline.language.keywords.usual import POSITION
from mudline.language.keywords.values import Ident, Name, Names, Real
from mudline.language.keywords.vessels import Dimensions


class Location(Row):
    """A place."""

    x: Annotated[Real, about("vertical coordinate", unit="L", usual=POSITION)]
    y: Annotated[Real, about("horizontal coordinate Y", unit="L", usual=POSITION)]
    z: Annotated[Real, about("horizontal coordinate Z", unit="L", usual=POSITION)]


class DrawnBody(Record):
    """A body."""

    rule = "drawn_body"
    body: Annotated[Name, setting("BODY", "name of the body")]
    location: Annotated[Location, setting("LOCATION", "where it is")]
    node: Annotated[Ident | None, setting("NODE", "node that it moves with", names=Names.NODE)] = None
    profile: Annotated[
        Literal["BOP", "CALMBUOY", "PLET", "ROV", "USER"], setting("PROFILE", "its shape; USER: of a file")
    ]
    file: Annotated[Name | None, setting("FILE", "of USER: file with the shape; mandatory", names=Names.FILE)] = None
    dimensions: Annotated[Dimensions | None, setting("DIMENSIONS", "its size")] = None


class DrawnBodies(Block):
    """Bodies."""

    rule = "body_integrated"
    page = "kwd_model_bodyintegrated"
    summary = "Bodies that are drawn: where they are, their shapes, and the nodes that they move with."
    example = "*BODY,INTEGRATED\n BODY=Manifold\n LOCATION=0.0, 10.0, 0.0\n NODE=1\n PROFILE=PLET\n"

    keyword: Literal["BODY,INTEGRATED"] = "BODY,INTEGRATED"
    bodies: list[DrawnBody] = []


BLOCK = DrawnBodies
