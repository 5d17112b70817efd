"""What a scene does not need is not imported."""

from __future__ import annotations

import subprocess
import sys

import pytest

from tests.builders.decks import CURVED_BED, METRIC, line_deck
from tests.processes import TIMEOUT

LINEAR = "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=5000\n"

PROGRAM = """
import sys
from mudline.deck.loading import load_bytes
from mudline.scene.model import resolve
scene = resolve(load_bytes(sys.argv[1].encode(), "deck.keyxm"))
scene.contact().evaluate()
print(*(name for name in sys.modules if name.startswith(("mudline.", "scipy"))))
"""


def imported(seabed: str) -> set[str]:
    run = [sys.executable, "-W", "error", "-c", PROGRAM, line_deck(METRIC, seabed)]
    return set(subprocess.run(run, capture_output=True, text=True, timeout=TIMEOUT, check=True).stdout.split())


def test_a_deck_of_curves_on_a_flat_bed_imports_no_other_feature() -> None:
    found = imported(CURVED_BED)
    assert "mudline.curves" in found
    assert "scipy" not in found
    assert not {name for name in found if name.startswith("mudline.contact.seabed.")}
    laws = {name.rpartition(".")[2] for name in found if name.startswith("mudline.contact.laws.")}
    assert laws == {"curve"}
    assert "mudline.scene.contact_input" in found
    assert "mudline.scene.assignments" not in found


@pytest.mark.parametrize(
    ("seabed", "needed", "idle"),
    [
        (LINEAR + " FRICTION=0.3, 0.4\n", "mudline.contact.laws.friction", "mudline.contact.laws.suction"),
        (
            LINEAR + "*SEABED SUCTION\n SET=ALL\n COHESION=5000\n",
            "mudline.contact.laws.suction",
            "mudline.contact.laws.friction",
        ),
        (
            LINEAR + "*SEABED PLANES\n PLANE=a\n POINT=0,0,0\n SLOPE=1\n",
            "mudline.contact.seabed",
            "mudline.curves",
        ),
    ],
)
def test_one_feature_imports_its_own_modules_only(seabed: str, needed: str, idle: str) -> None:
    found = imported(seabed)
    assert needed in found
    assert idle not in found
