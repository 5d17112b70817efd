"""Words: the names of sections, keywords, settings and choices."""

from __future__ import annotations

from mudline.diagnostics import Code, Severity

SYN004 = Code(
    "SYN004",
    "unknown-setting",
    Severity.ERROR,
    """
    The keyword has no such KEY=.

    A setting that is misspelt is not read, and the default or nothing at all holds in its place: a seabed without its
    stiffness carries nothing. The message lists the keys of the keyword and suggests the nearest.

    Example:
         $MODEL
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
        - STIFNESS=50000.0
        + STIFFNESS=50000.0

    Finds: 5:2
    """,
)

SYN005 = Code(
    "SYN005",
    "bad-choice",
    Severity.ERROR,
    """
    The setting takes one of a few words, and this is none of them.

    A choice decides how the lines below it are read and which law holds, so it cannot be guessed. The message lists the
    words and suggests the nearest. Upper or lower case does not matter.

    Example:
         $MODEL
         *SEABED PROPERTIES
        - TYPE=ELSTIC
        + TYPE=ELASTIC
          SET=ALL
          STIFFNESS=50000.0

    Finds: 3:7
    """,
)

SYN009 = Code(
    "SYN009",
    "unknown-keyword",
    Severity.INFO,
    """
    The keyword is not known.

    There are more keywords than are known here, so this is a note: the block is passed through unchanged and not
    checked. A name that differs from a known one by a letter or two, has the same beginning or has words behind it is a
    warning, as a misspelt keyword takes its whole block out of the model. Correct the name, put a remark into a comment
    line, or ignore this rule where the keyword is right.

    Example:
         $MODEL
        -*OCAEN
        +*OCEAN
          500.0, 1025.0, 9.81

    Finds: 2:1
    """,
)

SYN010 = Code(
    "SYN010",
    "unknown-section",
    Severity.INFO,
    """
    The section is not known.

    All of it is passed through unchanged and not checked. This is a note, as there are sections that are not known
    here; a name that differs from a known one by a letter or two, has the same beginning or has words behind it is a
    warning, as everything in a misspelt section is missing from the analysis. Correct the name.

    Example:
         $MODEL
         *OCEAN
          500.0, 1025.0, 9.81
        -$LOADCASE
        +$LOAD CASE
         *ANALYSIS TYPE
          TYPE=STATIC

    Finds: 4:1
    """,
)
