"""Nodes, elements, their labels, and element sets of the model."""

from typing import Annotated, Literal, Self

from mudline.language.keywords.common import *


class NodeRow(Row):
    """Columns of the table of nodes."""

    node: Annotated[Whole, about("node number", defines=Names.NODE)]
    x: Annotated[
        Real,
        about("vertical coordinate, positive upwards; the mudline of a flat seabed is at 0", unit="L", usual=POSITION),
    ]
    y: Annotated[Real, about("horizontal coordinate", unit="L", usual=POSITION)]
    z: Annotated[Real | None, about("horizontal coordinate", unit="L", default="0", usual=POSITION)] = None


class NodeRange(ListRow):
    """First and last node, and the step of the numbers between them."""

    start: Annotated[Whole, about("existing node that the line of nodes starts from", names=Names.NODE)]
    end: Annotated[Whole, about("existing node that it ends at", names=Names.NODE)]
    increment: Annotated[Whole | None, about("step between the node numbers", default="1")] = None


class NodeRows(Record):
    """Nodes by coordinates."""

    rule = "node_rows"
    nodes: Annotated[Table, rows(NodeRow, "nodes: number, x, y and z")]


class NodeGenerate(Record):
    """Equally spaced nodes on the straight line between two nodes."""

    rule = "node_generate"
    generate: Annotated[NodeRange, setting("GEN", "equally spaced nodes between two existing ones")]


class Nodes(Block):
    """Nodes."""

    rule = "node"
    facts = Facts(defines="nodes", beside=("ELEMENT",))
    page = "kwd_model_node"
    summary = "Nodes by number and coordinates; X is vertical."
    tabular = True
    example = "*NODE\n 1, 0.0, 0.0\n 11, 0.0, 100.0\n GEN=1, 11\n"

    keyword: Literal["NODE"] = "NODE"
    entries: Records[NodeRows | NodeGenerate] = Records()


_AXIS = "component {} of the vector that orients the local {} axis of the undeformed element"


class ElementRow(Row):
    """Columns of the table of elements."""

    element: Annotated[Whole, about("element number", defines=Names.ELEMENT)]
    node1: Annotated[Ident, about("first node", names=Names.NODE)]
    node2: Annotated[Ident, about("second node", names=Names.NODE)]
    v1: Annotated[Real | None, about(_AXIS.format(1, "y"), unit="-", usual=COMPONENT)] = None
    v2: Annotated[Real | None, about(_AXIS.format(2, "y"), unit="-", usual=COMPONENT)] = None
    v3: Annotated[Real | None, about(_AXIS.format(3, "y"), unit="-", usual=COMPONENT)] = None
    w1: Annotated[Real | None, about(_AXIS.format(1, "z"), unit="-", usual=COMPONENT)] = None
    w2: Annotated[Real | None, about(_AXIS.format(2, "z"), unit="-", usual=COMPONENT)] = None
    w3: Annotated[Real | None, about(_AXIS.format(3, "z"), unit="-", usual=COMPONENT)] = None


class ElementPattern(ListRow):
    """Master, number of elements including it, and the step of element and node numbers."""

    master: Annotated[Whole, about("existing element whose pattern is repeated", names=Names.ELEMENT)]
    count: Annotated[Whole, about("number of elements, the master included", at_least=1, usual=COUNT)]
    increment: Annotated[Whole | None, about("step of element and node numbers", default="1", usual=COUNT)] = None


class ElementRows(Record):
    """Elements by their nodes."""

    rule = "element_rows"
    elements: Annotated[Table, rows(ElementRow, "elements: number and two nodes")]


class ElementGenerate(Record):
    """Elements stepped from a master."""

    rule = "element_generate"
    generate: Annotated[ElementPattern, setting("GEN", "elements stepped from a master defined before")]


class Elements(Block):
    """Elements."""

    rule = "element"
    facts = Facts(defines="elements", beside=("NODE",))
    page = "kwd_model_element"
    summary = "Elements by number and their two nodes."
    tabular = True
    example = "*ELEMENT\n 1, 1, 2\n GEN=1, 10\n"

    keyword: Literal["ELEMENT"] = "ELEMENT"
    entries: Records[ElementRows | ElementGenerate] = Records()


class ElementRange(ListRow):
    """First and last element, and the step between them."""

    start: Annotated[Whole, about("first element", names=Names.ELEMENT)]
    end: Annotated[Whole, about("last element", names=Names.ELEMENT)]
    increment: Annotated[Whole | None, about("step", default="1")] = None


class SetList(Record):
    """Elements by number or label, at most 20 on a line."""

    rule = "set_list"
    elements: Annotated[list[Ident], about("element numbers or {labels}", names=Names.ELEMENT)]


class SetGenerate(Record):
    """Range of element numbers."""

    rule = "set_generate"
    generate: Annotated[ElementRange, setting("GEN", "range of element numbers")]


class SetSubset(Record):
    """All elements of another set."""

    rule = "set_subset"
    subset: Annotated[
        Name, setting("SUBSET", "another set, all of whose elements belong to this one too", names=Names.SUBSET)
    ]


class ElementSet(Record):
    """Set."""

    rule = "element_set"
    name: Annotated[
        Name, setting("SET", "set name: up to 256 characters, case is ignored, spaces are not", defines=Names.SET)
    ]
    members: Records[SetList | SetGenerate | SetSubset] = Records()


class ElementSets(Block):
    """Element sets."""

    rule = "element_sets"
    facts = Facts(defines="sets")
    summary = "Named groups of elements; ALL is predefined."
    example = "*ELEMENT SETS\n SET=Riser\n 1, 2, 3\n GEN=10, 20, 2\n SET=Everything\n SUBSET=Riser\n"

    keyword: Literal["ELEMENT SETS"] = "ELEMENT SETS"
    sets: Records[ElementSet] = Records()


class LabelledNode(Row):
    """Node of a label."""

    number: Annotated[Whole, about("node number", names=Names.NODE)]


class LabelledElement(Row):
    """Element of a label."""

    number: Annotated[Whole, about("element number", names=Names.ELEMENT)]


class LabelLine(Record):
    """Label; `thing` is given where it changes."""

    rule = "label_line"
    sticky = "thing"
    thing: Annotated[
        Literal["NODE", "ELEMENT"] | None, setting("TYPE", "kind of labelled object, until it is given again")
    ] = None
    node: Annotated[LabelledNode | None, about("of NODE: the node")] = None
    element: Annotated[LabelledElement | None, about("of ELEMENT: the element")] = None
    label: Annotated[
        Name, setting("LABEL", "the label; elsewhere it stands in braces, in place of the number", inline=True)
    ]

    @classmethod
    def row_slot(cls, number: int, fields: int, values: dict[str, object], last: object) -> str:
        """Return the kind of object in TYPE=, here or on an earlier line."""
        return str(values.get("thing") or last or "NODE").lower()

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Raise ValueError unless the label belongs to either a node or an element."""
        require_one(self, "node", "element")
        return self


class Labels(Block):
    """Labels."""

    rule = "label"
    page = "kwd_model_label"
    summary = "Names for nodes and elements, used in braces in place of their numbers."
    example = "*LABEL\n TYPE=NODE\n 1, LABEL=Anchor\n 11, LABEL=Hang-off\n TYPE=ELEMENT\n 10, LABEL=Top Joint\n"

    keyword: Literal["LABEL"] = "LABEL"
    labels: Records[LabelLine] = Records()

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Raise ValueError unless TYPE= stands above the first label."""
        if self.labels and self.labels[0].thing is None:
            raise ValueError("TYPE=NODE or TYPE=ELEMENT must stand above the first label")
        return self
