"""Names, numbers and files that one place of a deck uses and another one defines."""

from __future__ import annotations

from mudline.language.diagnostics import Code, Severity

REF001 = Code(
    "REF001",
    "undefined-set",
    Severity.ERROR,
    """
    A SET= names a set that the deck does not define.

    What is below the SET= would reach no element: no stiffness, no diameter, no curve. Mostly the name is spelt
    differently in two places: case is ignored in names, spaces are not. Define the set in *ELEMENT SETS, or correct
    the name. Where *LINES, which makes sets of its own, or the deck that *RESTART continues could define the set, this
    is a warning. Two more names give warnings here too: a REPEAT= of *LINE PATH SECTIONS that names no group of
    *LINE SECTION GROUPS, and a LINE= there that *LINE PATHS does not name. And a VARIATIONS= of *COMBINATIONS that
    names no variation is an error, as no deck could be made.

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

    The set is smaller than it was meant to be, so elements miss their stiffness, diameter or curve. This happens when a
    mesh is made coarser and the sets stay as they were. Correct the number, or define the element. A range of which
    only some elements exist is a warning. Elements that only *CABLE can define are one info for it.

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

    The element has no place and no length, and nothing can be said of its contact. Correct the number, or define the
    node. The same holds for nodes that *BOUNDARY holds, of which a range may lack some as a warning, and of NODE= in
    *P-Y and *T-Z. A node that only *LINES or the deck before a *RESTART can define is a warning, and so is a label that
    is spelt nearly as one in *LINES or *LINE LOCATIONS. Nodes that only *CABLE or *NODE,CURVILINEAR can
    define, whose lines are not read, are one info for the keyword.

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

    The later definition holds, and the earlier one is lost silently: a line copied and half changed puts a kink
    into the pipe, or leaves an element out. Remove one of the two, or give it another number.

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
    A SUBSET= leads back to its own set, or names no set.

    A set takes in all elements of its subsets. A set that is, through others, a subset of itself has no meaning, and a
    subset that does not exist leaves elements out. Remove one of the SUBSET= lines of the cycle, or correct the name.

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

    ALL holds every element of the model, whatever else the deck says, so the lines below this SET= have no effect,
    although a reader may expect it. Choose another name, or remove the lines.

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

    Properties given to an empty set reach no element. A set without a line is a warning; a GEN= whose end comes before
    its start, whose increment does not lead to the end, or that would generate more than memory holds, is an error, as
    start and end may be exchanged or a digit wrong. Give the set its elements, or remove it.

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

    The field has no value then, and nothing that depends on it can be evaluated. Define the parameter in *PARAMETERS,
    or correct its name. Items of a list have the name of the list in front, as in Soil_stiffness. Also reported are a
    PARA= of *VARIATION and a %name% in the names of files of *COMBINATIONS without a parameter: no deck could be made.

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

    Each of them needs the value of the other first, so none has a value. Give one of them as a number.

    Example on parameters:
        - od, =[wall*17.0]
        + od, 0.3239
        | wall, =[od/17.0]

    Finds: 5:8
    """,
)

REF015 = Code("REF015", "missing-file", Severity.WARNING)
