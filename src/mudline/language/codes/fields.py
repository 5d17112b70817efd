"""Fields of lines: numbers, brackets, labels, equations; and points that make no force-embedment curve."""

from __future__ import annotations

from mudline.language.diagnostics import Code, Severity

SYN002 = Code(
    "SYN002",
    "bad-number",
    Severity.ERROR,
    """
    A field that needs a number holds none.

    A letter O for a zero, two decimal points or a value that a spreadsheet wrote as NaN are easily overlooked, and
    programs differ in what they make of them: some stop, some read the digits up to the first strange character. Values
    that are infinite or too large for double precision are no numbers either. Nor is what a word processor made of
    one: a dash or another minus sign, a blank that does not break, wide digits. Correct the field; an equation is
    written `=[...]`.

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

    The place of a value on its line says what it is, so one comma too many or a value left out gives every later value
    another meaning. The message shows the format of the line. A field that may be empty is still set off by its comma.

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

    Commas between `=[` and `]`, in `{...}`, `/.../` and `"..."` do not separate fields. An opened one therefore
    swallows the rest of the line, and the values after it are lost. Close it on the same line: nothing continues on
    the next.

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

    A comma separates fields, so `0,1` is the two numbers 0 and 1. A line of whole numbers, twice as many as it should
    have, or two numbers where one belongs, was probably written with decimal commas, as a spreadsheet does in many
    countries. Write decimal points, and look at the other lines from the same source: one whose last fields may be left
    out reads without an error and with other values.

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
    Text is given where the number or the {label} of a node or element belongs.

    Nodes and elements that the lines facility makes have labels with spaces in them, and a label is written in braces
    wherever a number could be. The text is read as if it had them; other programs may stop here, or read on with
    nothing. Put the braces around it.

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

    An operand or a bracket is missing, a number is divided by zero, a function gets the wrong number of arguments: the
    field then has no value, and neither has anything that depends on it. Correct the equation at the place that the
    message names. A function that is not known here may be known elsewhere; that is a warning only.

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

    The slope of the curve is the stiffness of the seabed, and one point has no slope. The same point twice counts once.
    Give the curve a second point; a straight line through the origin is the constant stiffness of a STIFFNESS= number.

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
    Two points of a curve have one embedment ratio and different forces.

    The curve would rise at once, with an infinite stiffness, and no solver can follow it. Often the ratios were rounded
    to too few digits. Give the points different ratios, or remove one.

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
