"""Kinds of faults that the linter misses or buries, each with the reason; a test keeps the lists exact."""

from __future__ import annotations

MISSED = {
    "ocean-depth-lost-a-digit": "a wind turbine rises as far above shallow water: below 500 m nothing is said",
    "ocean-depth-in-other-unit": "likewise, where the model rises less than 500 m above the sea",
    "steel-lost-a-digit": "the wall of a riser joint may carry its buoyancy, and be as light",
    "outer-diameter-in-millimetres": "a diameter of 4 m with a small bore: what is wider than 2.5 m may be a hull",
    "mobilisation-in-millimetres": "in inches it is shorter than the usual characteristic length of 10 ft",
    "digits-of-coordinate-exchanged": "in a steep part the line makes a spike aside there, and does not turn back",
    "density-left-out": "in user units nothing is known of the density of water beside flexible lines",
}
"""Kinds of which at least one fault is missed."""

BURIED = {
    "legacy-curve-in-new-deck": "in a deck in newtons with a suffix of user units, the pasted curve is weak too",
}
"""Kinds of which at least one fault is found and has more than one other finding beside it."""
