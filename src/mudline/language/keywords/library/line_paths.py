"""`*LINE PATHS`: lines that follow a path; `*LINE PATH SECTIONS` says what they are made of.

Its format is not public: the lines are kept, the names in them are used.
"""

from __future__ import annotations

from mudline.language.keywords.values import LINE_SETS, OpaqueKeyword

OPAQUE = OpaqueKeyword(
    keyword="LINE PATHS",
    summary="Lines that follow a path; their sections are given in *LINE PATH SECTIONS.",
    example="*LINE PATHS\n LINE=Flowline\n 0.0, 0.0, 0.0\n 0.0, 850.0, 0.0\n",
    certain="It defines the lines that *LINE PATH SECTIONS divides into sections, with bends.",
    inferred=(
        "LINE= or NAME= gives the line's name, which is an element set too; SECTION= and ADDITIONAL= give such sets if "
        "they belong here; a line makes nodes, elements and labels as those of *LINES do; any text may be a label."
    ),
    name_settings=LINE_SETS,
    labels=True,
    makes=("NODE", "ELEMENT", "ELEMENT SETS"),
)
