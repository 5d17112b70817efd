"""Lines, blocks and files that cannot be read as they stand, and unknown names of sections, keywords and settings."""

from __future__ import annotations

from mudline.language.diagnostics import Code, Severity

SYN001 = Code(
    "SYN001",
    "unreadable-line",
    Severity.ERROR,
    """
    The line fits none of the line formats of its keyword.

    The lines of a keyword come in a fixed order: a setting such as SET= opens a group, and only certain settings and
    rows of numbers may follow it. A line that fits nowhere is left out, so whatever it was meant to define is missing
    from the model. The message says which lines were expected: often a KEY= was forgotten in front of a number, or a
    line is one place too early or too late.

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

    A setting that is misspelt is not read, and the default or nothing at all holds in its place: a seabed without its
    stiffness carries nothing. The message lists the keys of the keyword and suggests the nearest.

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
    The setting takes one of a few words, and this is none of them.

    A choice decides how the lines below it are read and which law holds, so it cannot be guessed. The message lists the
    words and suggests the nearest. Upper or lower case does not matter. Some settings take more words than public pages
    show: another one is an info where the lines behind it are passed through unchanged.

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

    What a keyword means depends on its section, and before the first one it has no meaning: the whole block is not
    read. The section line may have been lost when decks were put together. Put the line that the message names, for
    most keywords `$MODEL`, in front of it.

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

    The model is described once, in `$MODEL`, and a load case says what acts on it. A block in the wrong section is not
    read as what it looks like: a restraint in `$MODEL` restrains nothing, a seabed in `$LOAD CASE` carries nothing.
    Move the block to a section that the message names; a missing `$LOAD CASE` line above it is the usual cause. It is
    an error in `$PREPROCESSOR`, `$MODEL` and `$LOAD CASE` for a keyword whose section is certain, else an info.

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

    There are more keywords than are known here, so this is a note: the block is passed through unchanged and not
    checked. Where the name differs from a known one by a letter or two, has the same beginning or has words after it,
    and its lines read as those of the known one, it is a warning: a misspelt keyword takes its whole block out of the
    model. Correct the name, put a remark into a comment line, or ignore this rule where the keyword is right.

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

    All of it is passed through unchanged and not checked. This is a note, as there are sections that are not known
    here; a name that differs from a known one by a letter or two, has the same beginning or has words after it is a
    warning, as everything in a misspelt section is missing from the analysis. Correct the name.

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

    Lines before the first section, or between a `$SECTION` and its first keyword, belong to nothing and are not read.
    Title lines at the top of a deck are common and do no harm: words above the first section are an info. Numbers there
    are numbers that the model lacks. Turn a title into a comment (C and a space), and put data under their keyword.

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

    Letters beyond the English alphabet, in a set name for instance, are saved as different bytes by different editors.
    A file that is not UTF-8 is read as CP1252, and as Latin-1 if that cannot be: a guess, after which a set's name may
    not match the same name in another file. Control characters, such as the Ctrl-Z that old systems put at the end of a
    file, are invisible and corrupt the line that holds them (in front of a * or a $ they are ignored). UTF-16 and
    binary data are not read at all. Where only comments hold such letters, as a degree sign, it is an info. Save the
    file as UTF-8, and remove what the message names.

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

    A C in column 1 makes a comment. Before a space there is no doubt, but `CURVE=` or `COMPRESSION CHECK=` in
    column 1 is data to one reader and a comment to another. Here a line counts as data if it begins with a key that its
    keyword knows; any other is taken for a comment, which is our reading and not a documented rule. A misspelt `CURV=`
    drops a whole curve in this way. Put a space after the C of a comment, and in front of data.

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
    The file ends in the middle of something.

    A copy that was broken off, or a full disk, cuts a deck anywhere: inside a number (`1.0E`), inside an equation, or
    before a line that the last keyword must have. Everything after the cut is missing as well, and a deck may look
    complete without it. Fetch the file again, or write what is missing, and end the last line with a line end.

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
    The file is not a deck, or holds two versions of one that were not merged.

    A merge that stopped at a conflict leaves both versions in the file, between marks of `<`, `=` and `>`: nobody knows
    which lines hold, so none is read. A pointer of Git LFS stands where `git lfs pull` was forgotten, a web page where
    a download asked for a password, and password managers name their key files `.keyx`, too. The file is neither read
    nor rewritten. Solve the conflict, or fetch the deck.

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
