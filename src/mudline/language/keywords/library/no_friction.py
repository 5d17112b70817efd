"""`*NO FRICTION`: a run without seabed friction.

Its format page is not public, and neither is its section: the lines are kept, if it has any.
"""

from __future__ import annotations

from mudline.language.keywords.values import OpaqueKeyword

OPAQUE = OpaqueKeyword(
    keyword="NO FRICTION",
    summary="A run without seabed friction, whatever coefficients the seabed has.",
    example="*NO FRICTION\n",
    certain="Friction acts if any coefficient is not zero; this keyword suppresses it for a run.",
    inferred="It belongs in $LOAD CASE and has no lines; in another section it is not reported.",
    sections=("LOAD CASE",),
    sections_inferred=True,
    subject="seabed",
)
