"""Kinds of faults that the linter misses or buries, each with the reason; a test keeps the lists exact."""

from __future__ import annotations

MISSED = {
    "ocean-depth-lost-a-digit": "a wind turbine rises as far above shallow water: below 500 m nothing is said",
    "ocean-depth-in-other-unit": "likewise, where the model rises less than 500 m above the sea",
    "outer-diameter-in-millimetres": "a diameter of 4 m with a small bore: what is wider than 2.5 m may be a hull",
    "mobilisation-in-millimetres": "in inches it is shorter than the usual characteristic length of 10 ft",
    "digits-of-coordinate-exchanged": "in a steep part the line makes a spike aside there, and does not turn back",
    "density-left-out": "in user units nothing is known of the density of water beside flexible lines",
}
"""Kinds of which at least one fault is missed."""

BURIED = {
    "curve-for-set-in-embedment": "points under no SET= are read as those of SET=ALL, which has consequences",
    "cut-behind-keyword": "the curves that the lost lines defined are reported too, each where it is used",
    "new-settings-in-old-block": "each line of the other family is reported, and the row that the block lacks",
    "parameters-line-missing": "as the first keyword of its section: each undefined parameter is reported",
    "set-for-curve-in-stiffness": "the curve that is not defined then is reported too, and its points",
    "table-of-the-interface": "points under no SET= are read as those of SET=ALL, which has consequences",
    "whole-model-pasted-twice": "each kind of a repeated definition is reported, not the copy as a whole",
    "legacy-curve-in-new-deck": "in a deck in newtons with a suffix of user units, the pasted curve is weak too",
}
"""Kinds of which at least one fault is found and has more than one other finding beside it."""
