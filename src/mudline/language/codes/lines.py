"""Codes on lines, blocks and files that cannot be read as written, and on unknown names in them."""

from __future__ import annotations

from mudline.language.diagnostics import Code, Severity

SYN001 = Code(
    "SYN001",
    "unreadable-line",
    Severity.ERROR,
    """
    The line fits none of the line formats of its keyword.

    The lines of a keyword come in a fixed order: a setting such as SET= opens a group, and only certain settings and
    rows of numbers may follow it. A line that does not fit is left out, so its data are missing from the model. The
    message lists the expected lines: often a KEY= was forgotten in front of a number, or two lines were exchanged.

    Example on seabed:
        - 50000.0
        + STIFFNESS=50000.0

    Finds: 5:2
    """,
)

SYN004 = Code(
    "SYN004",
    "unknown-setting",
    Severity.ERROR,
    """
    The keyword has no such KEY=.

    A misspelt setting is not read: its default, if any, is used in its place. A seabed without its stiffness carries
    no load. The message lists the keys of the keyword and suggests the nearest.

    Example on seabed:
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
    The value is not one of the words that the setting allows.

    The word decides how the lines below it are read and which law holds, so it cannot be guessed. The message lists the
    words and suggests the nearest. Upper or lower case does not matter. Some settings allow more words than public
    pages show: an unknown word is then an info, and the lines after it are passed through unchanged.

    Example on seabed:
        - TYPE=ELSTIC
        + TYPE=ELASTIC

    Finds: 3:7
    """,
)

SYN007 = Code(
    "SYN007",
    "keyword-outside-section",
    Severity.ERROR,
    """
    A keyword comes before the first $SECTION.

    The meaning of a keyword depends on its section. Before the first section it has no meaning, and the whole block is
    not read. The section line may have been lost when decks were merged. Put the line that the message names, for most
    keywords `$MODEL`, in front of it.

    Example on ocean:
        +$MODEL

    Finds: 1:1
    """,
)

SYN008 = Code(
    "SYN008",
    "keyword-in-wrong-section",
    Severity.ERROR,
    """
    The keyword does not belong in this section.

    `$MODEL` describes the model, and `$LOAD CASE` the loads on it. A block in the wrong section has no effect: a
    restraint in `$MODEL` restrains nothing, a seabed in `$LOAD CASE` carries no load. Move the block to a section that
    the message names; a missing `$LOAD CASE` line above it is the usual cause. It is an error in `$PREPROCESSOR`,
    `$MODEL` and `$LOAD CASE` for a keyword whose section is certain, else an info.

    Example on ocean:
          500.0, 1025.0, 9.81
        +$LOAD CASE
        |*BOUNDARY
        | TYPE=CONSTANT
        | 1, 1
        | 1, 2

    Finds: 4:1
    """,
)

SYN009 = Code(
    "SYN009",
    "unknown-keyword",
    Severity.INFO,
    """
    The keyword is not known.

    The block is passed through unchanged and not checked. This is an info, since there are more keywords than mudline
    knows. It is a warning if the keyword was probably misspelt, since the whole block is then missing from the model.
    Such a name differs from a known name by a letter or two, has the same beginning or has words after it, and its
    lines can be read as those of the known keyword. Correct the name, put a remark into a comment line, or ignore this
    rule if the keyword is right.

    Example on ocean:
        -*OCAEN
        +*OCEAN

    Finds: 2:1
    """,
)

SYN010 = Code(
    "SYN010",
    "unknown-section",
    Severity.INFO,
    """
    The section is not known.

    The whole section is passed through unchanged and not checked. This is an info, since there are more sections than
    mudline knows. It is a warning if the name differs from a known name by a letter or two, has the same beginning or
    has words after it: all blocks of a misspelt section are missing from the analysis. Correct the name.

    Example on ocean:
          500.0, 1025.0, 9.81
        -$LOADCASE
        +$LOAD CASE
        |*ANALYSIS TYPE
        | TYPE=STATIC

    Finds: 4:1
    """,
)

SYN011 = Code(
    "SYN011",
    "data-outside-keyword",
    Severity.WARNING,
    """
    A data line belongs to no keyword.

    Lines before the first section, or between a `$SECTION` and its first keyword, are not read. Title lines at the top
    of a deck are common and do no harm: words above the first section are an info. Numbers there are missing from the
    model. Turn a title into a comment (C and a space), and put data under their keyword.

    Example on ocean:
        -Flowline on soft clay, as laid
        +C Flowline on soft clay, as laid
         $MODEL

    Finds: 1:1
    """,
)

SYN012 = Code(
    "SYN012",
    "bad-encoding",
    Severity.WARNING,
    """
    The file holds bytes that are not UTF-8 text, or control characters.

    Editors save non-English letters, for instance in the name of a set, as different bytes. A file that is not UTF-8 is
    read as CP1252 or, if that fails, as Latin-1. This is a guess: afterwards a name may not match the same name in
    another file. Control characters, such as the Ctrl-Z that old systems put at the end of a file, are invisible and
    corrupt their line (before a * or a $ they are ignored). UTF-16 and binary data are not read at all. It is an info
    if only comments have such letters, for instance a degree sign. Save the file as UTF-8, and remove the characters
    that the message names.

    Example on ocean:
         $MODEL
        |C Flowline Ø 323.9 mm on soft clay

    Bytes: cp1252
    Finds: 2:12
    """,
)

SYN013 = Code(
    "SYN013",
    "ambiguous-comment",
    Severity.WARNING,
    """
    The line begins with a C in column 1 and a letter: comment or data?

    A C in column 1 begins a comment. Before a space there is no doubt, but programs differ on lines such as `CURVE=` or
    `COMPRESSION CHECK=` in column 1: some read data, some a comment. mudline reads data if the line begins with a key
    of its keyword, else a comment; this is our reading and not a documented rule. So a misspelt `CURV=` drops a whole
    curve. Put a space after the C of a comment, and in front of data.

    Example on ocean:
         *OCEAN
        -Carried over from the survey report
        +C Carried over from the survey report

    Finds: 3:1
    """,
)

SYN014 = Code(
    "SYN014",
    "truncated-file",
    Severity.ERROR,
    """
    The file ends in the middle of a line or block.

    An interrupted copy or a full disk cuts a deck anywhere: inside a number (`1.0E`), inside an equation, or before a
    mandatory line of the last keyword. All text after the cut is missing as well, and a deck may look complete without
    it. Fetch the file again, or add the missing text, and end the last line with a line end.

    Example:
         $MODEL
         *OCEAN
        - 120.0, 1025.0, 9.81, 1.3E-
        + 120.0, 1025.0, 9.81, 1.3E-6

    Cut: yes
    Finds: 3:23
    """,
)

SYN018 = Code(
    "SYN018",
    "not-a-deck",
    Severity.ERROR,
    """
    The file is not a deck, or holds two unmerged versions of a deck.

    A merge that stopped at a conflict leaves both versions in the file, between marks of `<`, `=` and `>`. Other causes
    are a pointer of Git LFS, if `git lfs pull` was forgotten, a web page, if a download asked for a password, and key
    files of password managers, which have the suffix `.keyx` too. The file is neither read nor rewritten. Solve the
    conflict, or fetch the deck.

    Example on ocean:
         *OCEAN
        -<<<<<<< HEAD
          500.0, 1025.0, 9.81
        -=======
        - 510.0, 1025.0, 9.81
        ->>>>>>> survey-2026

    Finds: 3:1
    """,
)
