"""`*ELEMENT SET` of postprocessing: named groups of elements."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import setting
from mudline.language.keywords.lists import ElementGenerate, ElementList
from mudline.language.keywords.model import Block, Record
from mudline.language.keywords.values import Name, Names


class OtherSet(Record):
    """All elements of another set."""

    rule = "other_set"
    subset: Annotated[Name, setting("SUBSET", "another set, all of whose elements belong to this one too")]


class PostSet(Record):
    """A set."""

    rule = "post_set"
    name: Annotated[Name, setting("SET", "set name: up to 256 characters; ALL is predefined", defines=Names.SET)]
    members: list[ElementList | ElementGenerate | OtherSet] = []


class PostSets(Block):
    """Sets of elements for postprocessing."""

    rule = "element_set_post"
    sections = ("DATABASE POSTPROCESSING", "POSTPROCESSING")
    subject = "post-processing"
    page = "kwd_databasepostprocessing_elementsets"
    summary = "Named groups of elements for postprocessing."
    example = "*ELEMENT SET\n SET=Hot Spots\n 1, {Hang-off}, 3\n GEN=10, 20, 2\n SUBSET=Riser\n"

    keyword: Literal["ELEMENT SET"] = "ELEMENT SET"
    sets: list[PostSet] = []


BLOCK = PostSets
