"""A stage that an input does not need is not even imported."""

from __future__ import annotations

import subprocess
import sys

import pytest

PROGRAM = """
import sys
import numpy as np
from mudline.contact import ContactInput, ContactModel
from mudline.contact.extras import *

def extras():
    {extras}

one, zero = np.ones(1), np.zeros(1, int)
nodes = np.array([[0, 1]])
inputs = ContactInput(
    nodes[0], np.zeros((2, 3)), zero, nodes, one, one, zero + 2, zero - 1, (), one, extras=extras() or Extras()
)
model = ContactModel(inputs)
model.evaluate(np.full((3, 2, 3), -1.0), times=np.arange(3.0))
print(*sorted(name.removeprefix("mudline.contact.") for name in sys.modules if name.startswith("mudline.")))
"""
FRICTION = """
    from mudline.contact.friction.law import FrictionLaw
    both, yes = np.ones((2, 2)), np.ones(2, bool)
    rubbing = NodeFriction(FrictionLaw(both, both, both, yes, yes), np.zeros(2))
    return Extras(friction=rubbing)
"""
_LAW = """
    from mudline.contact.friction.trench import TrenchLaw
"""
_DITCH = "NodeTrench(TrenchLaw(*both, both[0]), np.full((2, 4), np.nan))"
TRENCH = _LAW + FRICTION.replace("=rubbing)", f"=rubbing, trench={_DITCH})")
SUCTION = """
    from mudline.contact.suction import SuctionLaw
    row = np.ones(1)
    law = SuctionLaw(row, row, row, row, 0.2 * row, 0.8 * row, row, row)
    return Extras(suction=ElementSuction(zero, law))
"""
ALWAYS = {"normal", "assembly", "laws.linear", "floors.flat", "stages", "model"}
FRICTIONS = {"sliding", "friction.law", "friction.directions", "friction.return_mapping"}
SUCTIONS = {"uplift", "suction.stepping", "suction.simple", "suction.law", "suction.states", "suction.trapezoid"}
UNLOADING = {"unloading", "laws.unloading"}
TRENCHES = {"trenches", "friction.trench"}
SMOOTH = {"laws.smoothing", "laws.smoothed"}
STAGES = {
    *FRICTIONS,
    *SUCTIONS,
    *UNLOADING,
    *SMOOTH,
    *TRENCHES,
    "nodal",
    "lateral",
    "tangent",
    "laws.curve",
    "mudline.curves",
    "floors.scattered",
}


@pytest.mark.parametrize(
    ("extras", "needed"),
    [
        ("pass", set()),
        ("return Extras(smoothing=Smoothing(one, one > 0.0))", SMOOTH),
        ("return Extras(nodal=NodalSprings(np.ones(2), np.ones(2), np.ones(2, bool)))", {"nodal", "laws.smoothing"}),
        ("return Extras(unloading=one)", UNLOADING),
        ("return Extras(suction_springs=SuctionSprings(one, one))", SUCTIONS),
        (SUCTION, SUCTIONS),
        ("return Extras(lateral=one)", {"lateral", "friction.directions"}),
        (FRICTION, FRICTIONS),
        (TRENCH, FRICTIONS | TRENCHES),
    ],
    ids=["nothing", "smoothing", "nodal", "unloading", "springs", "suction", "lateral", "friction", "trench"],
)
def test_only_the_stages_that_are_needed_are_imported(extras: str, needed: set[str]) -> None:
    program = PROGRAM.format(extras=extras)
    run = subprocess.run([sys.executable, "-W", "error", "-c", program], capture_output=True, text=True, check=True)
    imported = set(run.stdout.split())
    assert imported >= ALWAYS
    assert imported & STAGES == needed
