"""Three samples at rest in MoorDyn: it and mudline agree within what the difference of laws explains.

`docs/export.md` has the figures of longer statics.
"""

from __future__ import annotations

from math import cos, radians, tan
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("moordyn", reason="MoorDyn's Python package is not installed")

from tests.tools.exporting.at_rest import DECKS, ROOT, at_rest, run, table
from tests.tools.exporting.decks import ELASTIC, WEIGHT, model_of, text

pytestmark = pytest.mark.slow


CLOSE = {"reaction": 0.02, "touchdown": 0.5, "penetration": 0.06}
COARSE = {"reaction": 0.03, "touchdown": 0.6, "penetration": 0.08}
"""Of a riser whose elements of 10 ft are longer than its bending length at touchdown, sqrt(EI/T), of some 7 ft."""


@pytest.mark.alike
@pytest.mark.parametrize("name", DECKS)
def test_reaction_touchdown_and_penetration_agree(name: str, tmp_path: Path) -> None:
    bounds = COARSE if name == "imperial-riser.keyxi" else CLOSE
    found = at_rest(ROOT / "samples" / name, tmp_path, statics=20.0)
    # With strakes this sample is two lines, which swing about the point between them: by 0.8 % in a second after 100 s.
    assert found.change < (0.02 if name == "scr-touchdown.keyxm" else 0.01)
    assert found.same_law == pytest.approx(found.reaction, rel=bounds["reaction"])
    assert found.deck_law == pytest.approx(found.same_law + found.explained, abs=0.002 * found.reaction)
    assert found.touchdown[1] == pytest.approx(found.touchdown[0], abs=bounds["touchdown"])
    assert found.penetration[1] == pytest.approx(found.penetration[0], rel=bounds["penetration"])
    assert table([found]).count("\n") == 2


def test_the_file_of_the_seabed_is_where_the_deck_has_it(tmp_path: Path) -> None:
    slope = radians(2.0)
    deck = text(bed=ELASTIC + "*SEABED PROFILE\n TYPE=SLOPING\n SLOPE=2.0\n")
    model = model_of(deck.replace(" 11, 0.0, 50.0", f" 11, {50.0 * tan(slope)!r}, 50.0"))
    (line,) = run(model, tmp_path, 20.0)["lines"]
    x, y, z = np.array(line["places"])[1:-1].T
    sunk = (model.levels(x, y) - z) * cos(slope)
    assert sunk == pytest.approx(np.full(len(x), WEIGHT * cos(slope) / 20000.0), rel=0.2)
    assert sum(line["forces"]) == pytest.approx(WEIGHT * 45.0 / cos(slope), rel=0.05)
