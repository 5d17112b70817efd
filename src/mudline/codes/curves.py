"""Points that make no force-embedment curve."""

from __future__ import annotations

from mudline.diagnostics import Code, Severity

CRV001 = Code(
    "CRV001",
    "too-few-points",
    Severity.ERROR,
    """
    A curve has fewer than two points.

    The slope of the curve is the stiffness of the seabed, and one point has no slope. The same point twice counts once.
    Give the curve a second point; a straight line through the origin is the constant stiffness of a STIFFNESS= number.

    Example:
         $MODEL
         *SEABED STIFFNESS
          CURVE=Rock
        + 0.0, 0.0
          0.01, 25000.0
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=Rock

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

    Example:
         $MODEL
         *SEABED STIFFNESS
          CURVE=Sand
          0.00, 0.0
        - 0.05, 1800.0
        - 0.05, 2100.0
        + 0.048, 1800.0
        + 0.054, 2100.0
          0.20, 9000.0
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=Sand

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

    Example:
         $MODEL
         *SEABED STIFFNESS
          CURVE=Clay
          0.0, 0.0
        - 0.0001, 1.2E305
        - 0.1, 1.4E305
        + 0.0001, 1.2E3
        + 0.1, 1.4E3
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=Clay

    Finds: 5:2
    """,
)
