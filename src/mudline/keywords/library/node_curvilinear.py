"""`*NODE,CURVILINEAR`: nodes by distance along a cable.

Its format is not public: the lines are kept. Its nodes have no coordinates here.
"""

from __future__ import annotations

from mudline.keywords.values import OpaqueKeyword

OPAQUE = OpaqueKeyword(
    keyword="NODE,CURVILINEAR",
    summary="Nodes by their distance along a *CABLE (superseded by *LINES).",
    example="*NODE,CURVILINEAR\n 2, 14.1\n 3, 28.2\n",
    certain="It defines nodes by distance along a *CABLE; *LINES supersedes it.",
    inferred="It defines nothing but nodes; these have numbers, not labels.",
    makes=("NODE",),
)
