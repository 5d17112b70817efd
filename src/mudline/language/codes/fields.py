"""Codes on fields of lines: numbers, brackets, labels, equations, and points without a force-embedment curve."""

from __future__ import annotations

from mudline.language.diagnostics import Code, Severity

SYN002 = Code(
    "SYN002",
    "bad-number",
    Severity.ERROR,
    """
    A field that needs a number does not hold a number.

    A letter O for a zero, two decimal points or the NaN of a spreadsheet are easily overlooked. Some programs stop at
    such a field, some read the digits up to the first strange character. Values that are infinite or too large for
    double precision are not numbers either, nor are numbers with the characters of a word processor: a dash as minus
    sign, a non-breaking space, wide digits. Correct the field; an equation is written `=[...]`.

    Example on ocean:
        - 5O0.0, 1025.0, 9.81
        + 500.0, 1025.0, 9.81

    Finds: 3:2
    """,
)

SYN003 = Code(
    "SYN003",
    "wrong-field-count",
    Severity.ERROR,
    """
    The line has too few or too many fields.

    The place of a value on its line gives its meaning, so an extra comma or a missing value changes the meaning of
    every later value. The message shows the format of the line. An empty field still needs its comma.

    Example on clay:
        - 0.1
        + 0.1, 1200.0

    Finds: 5:2
    """,
)

SYN006 = Code(
    "SYN006",
    "unbalanced-bracket",
    Severity.ERROR,
    """
    A bracket, brace, slash list or quotation mark is opened and not closed on its line.

    Commas between `=[` and `]`, in `{...}`, `/.../` and `"..."` do not separate fields. Without its closing mark, an
    opening mark takes in the whole line after it, and the values there are lost. Close it on the same line: it cannot
    continue on the next line.

    Example on parameters:
          od, 0.3239
        - vessel_x, =[depth + 5.0
        + vessel_x, =[depth + 5.0]

    Finds: 5:12
    """,
)

SYN015 = Code(
    "SYN015",
    "decimal-comma",
    Severity.WARNING,
    """
    A comma may have been meant as a decimal point.

    A comma separates fields, so `0,1` is the two numbers 0 and 1. Spreadsheets in many countries write decimal commas.
    They are likely if a line has whole numbers, twice as many as it should have, or two numbers in place of one. Write
    decimal points, and check the other lines from the same source: a line with optional fields at its end is read
    without an error, but with wrong values.

    Example on clay:
        - 0,1, 1200,0
        + 0.1, 1200.0

    Finds: 5:2
    """,
)

SYN016 = Code(
    "SYN016",
    "label-without-braces",
    Severity.WARNING,
    """
    Text is given in place of the number or the {label} of a node or element.

    A label is written in braces wherever a number could be; labels of nodes and elements of *LINES have spaces in them.
    The text is read as if it had braces; other programs may stop here, or read no label. Put braces around the text.

    Example:
         $MODEL
         *LINES
          LINE=Flowline
         *ELEMENT SETS
          SET=Tie-in
        - Seabed End
        + {Seabed End}

    Finds: 6:2
    """,
)

SYN017 = Code(
    "SYN017",
    "expression-error",
    Severity.ERROR,
    """
    The equation cannot be read or has no value.

    An operand or a bracket is missing, a number is divided by zero, a function gets the wrong number of arguments: then
    the field has no value, and nor have fields that depend on it. Correct the equation at the place in the message. An
    unknown function is only a warning, since the analysis program may know it.

    Example on parameters:
        - =[depth + ], 1025.0, 9.81
        + =[depth], 1025.0, 9.81

    Finds: 7:2
    """,
)


CRV001 = Code(
    "CRV001",
    "too-few-points",
    Severity.ERROR,
    """
    A curve has fewer than two points.

    The slope of the curve is the stiffness of the seabed, and one point has no slope. A repeated point counts once.
    Give the curve a second point; a straight line through the origin equals a number in STIFFNESS=.

    Example on clay:
        + 0.0, 0.0
        + 0.1, 1200.0

    Finds: 3:2
    """,
)

CRV003 = Code(
    "CRV003",
    "duplicate-ratio",
    Severity.ERROR,
    """
    Two points of a curve have the same embedment ratio and different forces.

    The stiffness between them would be infinite, and no solver can follow such a curve. Often the ratios were rounded
    to too few digits. Give the points different ratios, or remove one point.

    Example on clay:
          0.1, 1200.0
        - 0.1, 1500.0
        + 0.13, 1500.0

    Finds: 6:2
    """,
)

CRV011 = Code(
    "CRV011",
    "slope-overflow",
    Severity.ERROR,
    """
    The distance or the slope between two points cannot be held by a floating-point number.

    Numbers reach to 1.8E308 and down to 2.2E-308. Beyond them a slope would become infinite or lose its digits, and
    with it the stiffness. Usually an exponent has a digit too many: correct the point.

    Example on clay:
        - 0.0001, 1.2E305
        - 0.5, 1.4E305
        + 0.1, 1200.0
        + 0.5, 4200.0

    Finds: 5:2
    """,
)
