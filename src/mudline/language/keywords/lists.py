"""What the keywords share whose lines are about nodes, elements and degrees of freedom."""

from __future__ import annotations

from typing import Annotated

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import ListRow, Record
from mudline.language.keywords.usual import COUNT
from mudline.language.keywords.values import Ident, Names, Whole

Node = Annotated[Ident, about("node number, or its label", names=Names.NODE)]
Element = Annotated[Ident, about("element number, or its label", names=Names.ELEMENT)]
Freedom = Annotated[
    Whole, about("degree of freedom; 1 vertical, 2 and 3 horizontal, 4 to 6 rotations", at_least=1, at_most=6)
]


class ElementSpan(ListRow):
    """First and last element, and the step between them."""

    start: Annotated[Ident, about("first element", names=Names.ELEMENT)]
    end: Annotated[Ident, about("last element", names=Names.ELEMENT)]
    increment: Annotated[Whole | None, about("step", default="1", at_least=1, usual=COUNT)] = None


class ElementList(Record):
    """Elements by number or label; the language allows 20 on a line."""

    rule = "element_list"
    elements: Annotated[list[Ident], about("element numbers or {labels}", names=Names.ELEMENT)]


class ElementGenerate(Record):
    """A range of elements."""

    rule = "element_span"
    generate: Annotated[ElementSpan, setting("GEN", "range of elements")]
