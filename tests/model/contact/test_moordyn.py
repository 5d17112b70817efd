"""The reactions of a linear seabed beside those of MoorDyn, a public program for mooring lines, at the same positions.

MoorDyn takes kbot d l z at a node: kbot in Pa/m, d the diameter, l half of the lengths of its segments. Its Z is up.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

from mudline.model.contact import ContactModel
from mudline.model.contact.arrays import FloatArray
from tests.helpers.builders.contact import LINEAR, NONE, chain, on

pytestmark = pytest.mark.slow

moordyn = pytest.importorskip("moordyn", reason="MoorDyn's Python package is not installed")

DIAMETER, STIFFNESS, WATER, SEGMENTS, LENGTH = 0.1, 3.0e4, 50.0, 35, 70.0
DECK = f"""A line from an anchor on the seabed up to a fixed point
--------- LINE TYPES
Name  Diam  MassDen  EA  BA/-zeta  EI  Cd  Ca  CdAx  CaAx
(-)   (m)   (kg/m)   (N) (N-s/-)  (N-m2) (-) (-) (-) (-)
main  {DIAMETER}   80.0     1.0e8 -0.8    0    1.2 1.0  0.1  0.0
--------- POINTS
ID  Type   X   Y   Z    M  V  CdA  CA
(-) (-)   (m) (m) (m)  (kg) (m3) (m2) (-)
1   Fixed   0   0  {-WATER}  0  0  0  0
2   Fixed  50   30 -30.0  0  0  0  0
--------- LINES
ID  LineType AttachA AttachB UnstrLen NumSegs Outputs
(-)   (-)     (-)     (-)     (m)    (-)   (-)
1   main      1       2       {LENGTH}    {SEGMENTS}     -
--------- OPTIONS
0 writeLog
0.0005 dtM
{STIFFNESS} kbot
{STIFFNESS / 10.0} cbot
1025 WtrDnsty
{WATER} WtrDpth
2.0 dtIC
100.0 TmaxIC
0.0001 threshIC
4.0 CdScaleIC
---------
"""


class Line(NamedTuple):
    """Nodes (n, 3) and reactions (n,) of MoorDyn, X up from the seabed."""

    nodes: FloatArray
    reactions: FloatArray


@pytest.fixture(scope="module")
def at_rest(tmp_path_factory: pytest.TempPathFactory) -> Line:
    folder: Path = tmp_path_factory.mktemp("moordyn")
    deck = folder / "lines.txt"
    deck.write_text(DECK, encoding="ascii")
    system = moordyn.Create(str(deck))
    try:
        assert moordyn.Init(system, [], []) == 0
        line = moordyn.GetLine(system, 1)
        count = range(moordyn.GetLineNumberNodes(line))
        places = np.array([moordyn.GetLineNodePos(line, node) for node in count])
        forces = np.array([moordyn.GetLineNodeSeabedForce(line, node) for node in count])
    finally:
        moordyn.Close(system)
    assert not forces[:, :2].any()
    return Line(np.column_stack([places[:, 2] + WATER, places[:, :2]]), forces[:, 2])


def test_springs_of_nodes_are_those_of_moordyn(at_rest: Line) -> None:
    share = np.full(SEGMENTS + 1, STIFFNESS * DIAMETER * LENGTH / SEGMENTS)
    share[[0, -1]] *= 0.5
    contact = ContactModel(chain([NONE] * SEGMENTS, on("nodal", SEGMENTS + 1, stiffness=share)))
    result = contact.evaluate(at_rest.nodes)
    assert 5 < np.count_nonzero(at_rest.reactions) < SEGMENTS
    assert at_rest.reactions.max() > 1000.0
    assert result.normal_force == pytest.approx(at_rest.reactions, rel=1e-9, abs=1e-6)


def test_elements_share_the_same_load_in_another_way(at_rest: Line) -> None:
    """An element presses by its middle: where the line bends, a node gives some of its reaction to its neighbours."""
    line = chain([LINEAR] * SEGMENTS, diameter=DIAMETER, length=LENGTH / SEGMENTS, stiffness=STIFFNESS * DIAMETER)
    given = ContactModel(line).evaluate(at_rest.nodes).normal_force
    assert given.sum() == pytest.approx(at_rest.reactions.sum(), rel=0.02)
    flat = slice(6, 12)
    assert at_rest.reactions[flat].min() > 1000.0
    assert given[flat] == pytest.approx(at_rest.reactions[flat], rel=1e-3)
