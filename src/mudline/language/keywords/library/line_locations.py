"""`*LINE LOCATIONS`: labels for nodes at a distance along a line.

Its format is not public: the lines are kept, the names in them are used.
"""

from __future__ import annotations

from mudline.language.keywords.values import Names, OpaqueKeyword

OPAQUE = OpaqueKeyword(
    keyword="LINE LOCATIONS",
    summary="Labels for nodes at given distances along a line.",
    example="*LINE LOCATIONS\n LINE=Umbilical\n Touchdown, 200.0\n",
    certain="It gives labels to nodes at a distance along a line.",
    inferred="LINE= names a line, which is an element set too; any other text in its lines may be a label.",
    name_settings={"LINE": Names.SET},
    labels=True,
    makes=("NODE",),
)
