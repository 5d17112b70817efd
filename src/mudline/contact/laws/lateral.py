"""`LATERAL=` of `*SEABED PROPERTIES`: a spring to where the element touched down (INFERRED).

The spring acts per unit length at the middle of an element that is in contact, along n x t, where t is the element's
direction and n the mean normal of the seabed at its nodes (over a break of the seabed the mean of the normals on both
sides). Half of the force goes to each node:

    f = -k ((n x t) . (x - x_touchdown)) (n x t).
"""

from __future__ import annotations

from mudline.contact.laws.base import Law, Parameter, Value


def lateral_force(stiffness: Value, elongation: Value) -> Value:
    """Return the force along n x t on each of the two nodes; `stiffness` is k times the element's length."""
    return -0.5 * stiffness * elongation


LATERAL = Law(
    name="lateral",
    summary="spring to where the element touched down",
    acts_on="elements",
    parameters=(Parameter("stiffness", "F/L2", "force per unit length and length of lateral displacement"),),
    history=True,
    equation="f = -k y, y the displacement along n x t from the touchdown point",
    source="LATERAL= of *SEABED PROPERTIES (INFERRED)",
)
