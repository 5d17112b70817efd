"""`*ELEMENT SETS`: named groups of elements."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, ListRow, Record
from mudline.language.keywords.values import Facts, Ident, Name, Names, Whole


class ElementRange(ListRow):
    """First and last element, and the step between them."""

    start: Annotated[Whole, about("first element", names=Names.ELEMENT)]
    end: Annotated[Whole, about("last element", names=Names.ELEMENT)]
    increment: Annotated[Whole | None, about("step", default="1")] = None


class SetList(Record):
    """Elements by number or label; the language allows 20 on a line."""

    rule = "set_list"
    elements: Annotated[list[Ident], about("element numbers or {labels}", names=Names.ELEMENT)]


class SetGenerate(Record):
    """A range of element numbers."""

    rule = "set_generate"
    generate: Annotated[ElementRange, setting("GEN", "range of element numbers")]


class SetSubset(Record):
    """All elements of another set."""

    rule = "set_subset"
    subset: Annotated[
        Name, setting("SUBSET", "another set, all of whose elements belong to this one too", names=Names.SUBSET)
    ]


class ElementSet(Record):
    """A set."""

    rule = "element_set"
    name: Annotated[
        Name, setting("SET", "set name: up to 256 characters, case is ignored, spaces are not", defines=Names.SET)
    ]
    members: list[SetList | SetGenerate | SetSubset] = []


class ElementSets(Block):
    """Element sets."""

    rule = "element_sets"
    facts = Facts(defines="sets")
    summary = "Named groups of elements; ALL is predefined."
    example = "*ELEMENT SETS\n SET=Riser\n 1, 2, 3\n GEN=10, 20, 2\n SET=Everything\n SUBSET=Riser\n"

    keyword: Literal["ELEMENT SETS"] = "ELEMENT SETS"
    sets: list[ElementSet] = []


BLOCK = ElementSets
