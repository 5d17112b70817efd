"""`*CABLE`: cables along which `*NODE,CURVILINEAR` places nodes.

Its format is not public: the lines are kept, the names in them are used.
"""

from __future__ import annotations

from mudline.keywords.values import LINE_SETS, OpaqueKeyword

OPAQUE = OpaqueKeyword(
    keyword="CABLE",
    summary="Cables along which *NODE,CURVILINEAR places nodes (superseded by *LINES).",
    example="*CABLE\n 1, 41, 565.6\n",
    certain="Nodes can be given by their distance along a cable; *LINES supersedes it, and it is still legal.",
    inferred="It may define nodes, elements and element sets, these by LINE=, NAME=, SECTION= and ADDITIONAL=.",
    name_settings=LINE_SETS,
    makes=("NODE", "ELEMENT", "ELEMENT SETS"),
)
