"""`SUCTION=` of `*SEABED PROPERTIES`: a spring against uplift, up to some height above the seabed (INFERRED).

    f = -k x for 0 < x <= extent, 0 elsewhere,

x the height of the element above the point where its contact begins. It has no history, and acts beside an unloading
line: where the element is above the seabed.
"""

from __future__ import annotations

from mudline.contact.laws.base import Law, Parameter, Value, where


def spring_suction(uplift: Value, stiffness: Value, extent: Value) -> tuple[Value, Value]:
    """Return the force per unit length at a height `uplift` above the seabed, and its stiffness -d force / d x."""
    held = (uplift > 0.0) & (uplift <= extent)
    return where(held, 0.0 - stiffness * uplift, 0.0), where(held, stiffness, 0.0)


SUCTION_SPRING = Law(
    name="suction spring",
    summary="spring against uplift, without history",
    acts_on="elements",
    parameters=(
        Parameter("stiffness", "F/L2", "force per unit length and length of uplift"),
        Parameter("extent", "L", "height above the seabed up to which it acts"),
    ),
    equation="f = -k x for 0 < x <= extent",
    source="SUCTION= of *SEABED PROPERTIES (INFERRED)",
)
