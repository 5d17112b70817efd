"""Three samples at rest in MoorDyn: it and mudline agree within what the difference of laws explains.

`docs/export.md` has the figures of longer statics.
"""

from __future__ import annotations

from pathlib import Path

import pytest

pytest.importorskip("moordyn", reason="MoorDyn's Python package is not installed")

from tests.export.at_rest import DECKS, ROOT, at_rest, table

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("name", DECKS)
def test_reaction_touchdown_and_penetration_agree(name: str, tmp_path: Path) -> None:
    found = at_rest(ROOT / "samples" / name, tmp_path, statics=20.0)
    assert found.change < 0.01
    assert found.same_law == pytest.approx(found.reaction, rel=0.02)
    assert found.deck_law == pytest.approx(found.same_law + found.explained, abs=0.002 * found.reaction)
    assert found.touchdown[1] == pytest.approx(found.touchdown[0], abs=0.5)
    assert found.penetration[1] == pytest.approx(found.penetration[0], rel=0.06)
    assert table([found]).count("\n") == 2
