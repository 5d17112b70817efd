"""Codes on names, numbers and files that one part of a deck uses and another part defines."""

from __future__ import annotations

from mudline.language.diagnostics import Code, Severity

REF001 = Code(
    "REF001",
    "undefined-set",
    Severity.ERROR,
    """
    A SET= names a set that the deck does not define.

    The lines below the SET= reach no element: no stiffness, no diameter, no curve. Usually the name is spelt
    differently in two places: case is ignored in names, spaces are not. Define the set in *ELEMENT SETS, or correct
    the name. It is a warning if *LINES, which creates sets, or the deck that *RESTART continues may define the set.

    The rule also reports other names: as warnings a REPEAT= of *LINE PATH SECTIONS without a group of that name in
    *LINE SECTION GROUPS, and a LINE= there without a line of that name in *LINE PATHS; as an error a VARIATIONS= of
    *COMBINATIONS without a variation of that name, since no deck can be generated.

    Example on sets:
          GEN=3, 4
        |*SEABED PROPERTIES
        | TYPE=ELASTIC
        - SET=Flow Line
        + SET=FLOWLINE
        | STIFFNESS=50000.0

    Finds: 16:6
    """,
)

REF005 = Code(
    "REF005",
    "undefined-element",
    Severity.ERROR,
    """
    A set or a GEN= uses an element that is not defined.

    The set is smaller than intended, so elements lack their stiffness, diameter or curve. This happens when a mesh is
    made coarser and the sets are not changed. Correct the number, or define the element. It is a warning if some
    elements of a range exist. Elements that only a *CABLE can define are reported together, as one info.

    Example on sets:
        - 1, 2, 5
        + 1, 2

    Finds: 11:8
    """,
)

REF006 = Code(
    "REF006",
    "undefined-node",
    Severity.ERROR,
    """
    An element or a GEN= uses a node that is not defined.

    The element has no position and no length, and its contact cannot be evaluated. Correct the number, or define the
    node. Nodes in *BOUNDARY and in NODE= of *P-Y and *T-Z are checked too.

    It is a warning if some nodes of a range in *BOUNDARY exist, if only *LINES or the deck before a *RESTART can define
    the node, or if a label is spelt almost like a label in *LINES or *LINE LOCATIONS. Nodes that only unread lines of
    *CABLE or *NODE,CURVILINEAR can define are reported together, as one info for the keyword.

    Example on sets:
          GEN=1, 4
        - 5, 5, 6

    Finds: 9:8
    """,
)

REF007 = Code(
    "REF007",
    "duplicate-id",
    Severity.ERROR,
    """
    A node or an element is defined twice.

    The later definition overrides the earlier one: a line that was copied and only partly changed puts a kink into the
    pipe, or leaves an element out. Remove one of the two, or give it another number.

    Example on sets:
          GEN=1, 5
        - 5, 12.0, 50.0

    Finds: 6:2
    """,
)

REF008 = Code(
    "REF008",
    "subset-cycle",
    Severity.ERROR,
    """
    A SUBSET= leads back to its own set, or names an undefined set.

    A set contains all elements of its subsets. A set cannot be a subset of itself, directly or through other sets; an
    undefined subset leaves elements out. Remove one of the SUBSET= lines of the cycle, or correct the name.

    Example on sets:
          1, 2
        - SUBSET=Whole Line
          SET=Flowline
          GEN=3, 4
        | SET=Whole Line
        | SUBSET=Riser

    Finds: 16:9
    """,
)

REF009 = Code(
    "REF009",
    "redefined-all",
    Severity.ERROR,
    """
    The predefined set ALL is defined again.

    ALL always contains every element of the model, so the lines below this SET= have no effect. Choose another name, or
    remove the lines.

    Example on sets:
        - SET=All
        + SET=Riser

    Finds: 10:6
    """,
)

REF010 = Code(
    "REF010",
    "empty-set",
    Severity.WARNING,
    """
    A set has no element, or a GEN= generates nothing.

    Properties of an empty set reach no element. A set without a line is a warning. A GEN= is an error if its end comes
    before its start, if its increment does not lead to the end, or if the range exceeds the memory: start and end may
    be exchanged, or a digit wrong. Give the set its elements, or remove it.

    Example on sets:
        - GEN=4, 3
        + GEN=3, 4

    Finds: 13:2
    """,
)

REF013 = Code(
    "REF013",
    "undefined-parameter",
    Severity.ERROR,
    """
    An equation uses a parameter that is not defined.

    The field has no value, and fields that depend on it cannot be evaluated. Define the parameter in *PARAMETERS, or
    correct its name. Names of list items begin with the name of the list, as in Soil_stiffness. Undefined parameters in
    PARA= of *VARIATION and in a %name% of the file names of *COMBINATIONS are reported too: no deck can be generated.

    Example on parameters:
        - water depth, 850.0
        + depth, 850.0

    Finds: 7:2
    """,
)

REF014 = Code(
    "REF014",
    "parameter-cycle",
    Severity.ERROR,
    """
    Parameters are defined through each other.

    Each of them needs the value of another first, so none has a value. Give one of them as a number.

    Example on parameters:
        - od, =[wall*17.0]
        + od, 0.3239
        | wall, =[od/17.0]

    Finds: 5:8
    """,
)

REF002 = Code("REF002", "undefined-curve", Severity.ERROR)
REF015 = Code("REF015", "missing-file", Severity.WARNING)
REF019 = Code("REF019", "undefined-name", Severity.ERROR)
