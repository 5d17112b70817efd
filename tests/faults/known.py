"""Kinds of faults that the linter misses or buries, each with the reason; a test keeps the lists exact."""

from __future__ import annotations

MISSED = {
    "ocean-depth-lost-a-digit": "a wind turbine rises as far above shallow water: below 500 m nothing is said",
    "ocean-depth-in-other-unit": "likewise, where the model rises less than 500 m above the sea",
    "steel-lost-a-digit": "the wall of a riser joint may carry its buoyancy, and be as light",
    "outer-diameter-in-millimetres": "a diameter of 4 m with a small bore: what is wider than 2.5 m may be a hull",
    "mobilisation-in-millimetres": "in inches it is shorter than the usual characteristic length of 10 ft",
    "decimal-comma-in-coordinate": "rows of nodes are read as tables, in which blanks beside commas are not looked at",
    "density-left-out": "in user units nothing is known of the density of water beside flexible lines",
    "ocean-deleted": "a model in air has no `*OCEAN`, and what a load case needs is not looked at",
}
"""Kinds of which at least one fault is missed."""

_FOLLOWS = "rows of a block without its keyword line are read under the keyword before, one by one"
_NAMES = "what the lost block defined is missing at every place that names it"
_ROWS = "every row of the pasted table is reported"
_ONE_ROW = "several fields of the row are wrong, and values that were read from it are judged too"

BURIED = {
    "user-water-in-other-mass": "every section contradicts the density of the water",
    "letter-l-for-one": "without the density, a deck in kilonewtons is taken for one in newtons",
    "unit-behind-value": "without the density, a deck in kilonewtons is taken for one in newtons",
    "decimal-commas-throughout": _ROWS,
    "lost-comma-in-section": _ONE_ROW,
    "semicolons": "the node of the row is missing in its elements",
    "misspelt-curve": _NAMES,
    "plural-node": _NAMES,
    "misspelt-element-sets": _NAMES,
    "joined-element-sets": _NAMES,
    "misspelt-geometric-sets": _NAMES,
    "misspelt-seabed-stiffness": _NAMES,
    "star-for-dollar": "every keyword stands before the first section",
    "model-line-missing": "every keyword stands before the first section",
    "node-line-missing": _FOLLOWS,
    "element-line-missing": _FOLLOWS,
    "element-sets-line-missing": _FOLLOWS,
    "geometric-sets-line-missing": _FOLLOWS,
    "seabed-properties-line-missing": "curves without a law that names them are reported as unused",
    "seabed-stiffness-line-missing": _FOLLOWS,
    "embedment-line-missing": _FOLLOWS,
    "star-missing": _FOLLOWS,
    "star-missing-at-seabed": _FOLLOWS,
    "exclamation-comment": _ONE_ROW,
    "stars-comment": "the nodes behind the comment are missing in their elements",
    "table-of-the-interface": _ROWS,
    "header-line-of-nodes": _ONE_ROW,
    "row-numbers-pasted": _ROWS,
    "cut-in-exponent": _NAMES,
    "cut-behind-keyword": _NAMES,
    "block-of-nodes-pasted-twice": _ROWS,
    "whole-model-pasted-twice": _ROWS,
    "number-used-twice": "the number that is lost is missing in the elements",
    "forces-in-falling-order": "force at ratio 0, falling force, and pull beyond the last point are three rules",
    "ratio-without-point": "falling force, range of ratios, and pull beyond the last point are three rules",
    "legacy-curve-in-new-deck": "in a deck in newtons with a suffix of user units, the pasted curve is weak too",
    "rigid-surface-in-new-deck": "SBD016 repeats what SBD002 says, beside the note on the superseded keyword",
    "both-surfaces": "the curves of `*EMBEDMENT` stand under a rigid surface too",
    "legacy-row-in-new-block": _NAMES,
    "new-settings-in-old-block": "each setting is reported",
    "curve-for-set-in-embedment": "the points behind the comment belong to no set",
    "set-for-curve-in-stiffness": _NAMES,
    "option-line-deleted": "every section of the option is reported",
    "section-of-other-option": "every section of the option is reported",
    "extension-on-rigid-seabed": "every extension keyword is reported",
}
"""Kinds of which at least one fault is found and has more than one other finding beside it."""
