"""A normal law of a module of its own: hyperbolic, as the resistance of soft clay is often drawn.

    F = k z / (1 + z / z0),  dF/dz = k / (1 + z / z0)^2

per unit length, with the initial stiffness k; it comes near to k z0 as z grows.
"""

from __future__ import annotations

from mudline.contact.laws import NormalLaw, Parameter, Value, register


def hyperbolic_reaction(z: Value, _diameter: Value, stiffness: Value, reference: Value) -> tuple[Value, Value]:
    """Return F and dF/dz."""
    share = 1.0 / (1.0 + z / reference)
    return stiffness * z * share, stiffness * share * share


def hyperbolic_steepest(_z: Value, _diameter: Value, stiffness: Value, _reference: Value) -> Value:
    """Return k, the stiffness at the mudline."""
    return stiffness


HYPERBOLIC = register(
    NormalLaw(
        name="hyperbolic",
        summary="hyperbolic resistance",
        acts_on="elements",
        parameters=(
            Parameter("stiffness", "F/L2", "initial stiffness k"),
            Parameter("reference", "L", "penetration z0 at which half of the largest force acts", above=True),
        ),
        reaction=hyperbolic_reaction,
        steepest=hyperbolic_steepest,
        equation="F = k z / (1 + z / z0)",
        source="Duncan and Chang (1970), in the form of a p-y curve",
    )
)
