"""`*LINES`: lines made of sections; their nodes, elements, labels and sets come from them.

Its format is not public: the lines are kept, the names in them are used.
"""

from __future__ import annotations

from mudline.language.keywords.values import LINE_SETS, OpaqueKeyword

OPAQUE = OpaqueKeyword(
    keyword="LINES",
    summary="Lines made of sections: nodes, elements, labels and element sets in one.",
    example="*LINES\n LINE=Umbilical\n SECTION=Static Section, 200.0\n SECTION=Dynamic Section, 365.6\n",
    certain=(
        "It makes the nodes and elements of a line, labels for the nodes at its ends, and an element set for the line, "
        "for each section, and for each name in ADDITIONAL=."
    ),
    inferred=(
        "LINE= or NAME= gives the line's name and SECTION= that of a section, each as the first value, ADDITIONAL= has "
        "names only; any text in its lines may be a label."
    ),
    name_settings=LINE_SETS,
    labels=True,
    makes=("NODE", "ELEMENT", "ELEMENT SETS"),
)
