"""A deck made anonymous: nothing of its names and texts is left, its forces are the same."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import mudline
from mudline import DeckError
from mudline.editing import anonymizing
from mudline.editing.anonymizing import anonymous
from mudline.language.deck.loading import dump
from tests.cli.runner import SAMPLES, run

DECK = """C {hidden} comment
$PREPROCESSOR
*PARAMETERS
 {hidden} depth, -0.02
$MODEL
*OCEAN
 100.0, 1025.0, 9.81
*NODE
 {nodes}
*ELEMENT
 1, 1, 2
 2, 2, 3
 3, 3, 4
*ELEMENT SETS
 SET={hidden} clay
 1
 2
*GEOMETRIC SETS
 OPTION=RIGID
 SET=ALL
 2.07E11, 7.96E10, 0.3, 0.25, 7850.0
C {hidden}
*SEABED PROPERTIES
 TYPE=ELASTIC
 SET={hidden} clay
 STIFFNESS={hidden} curve
 FRICTION=0.3, 0.5
 SET=ALL
 STIFFNESS=40000.0
*SEABED STIFFNESS
 CURVE={hidden} curve
 0.0, 0.0
 0.1, 900.0
 0.5, 2500.0
{bed}$LOAD CASE
*STANDARD OUTPUT
 {hidden}
"""
BEDS = (
    "",
    "*SEABED PROFILE\n TYPE=SLOPING\n SLOPE=2.0\n",
    "*SEABED PROFILE\n TYPE=SLOPING\n DIRECTION=180.0\n SLOPE=-2.0\n",
    "*SEABED PLANES\n PLANE={hidden} plane\n POINT=0.0, {y}, {z}\n SLOPE=1.0\n",
)
NAMES = st.text("qwzx", min_size=4, max_size=8)
FAR = st.floats(-1e6, 1e6).map(lambda value: round(value, 3))


@given(NAMES, FAR, FAR, st.sampled_from(BEDS))
def test_forces_are_the_same_and_no_name_is_left(hidden: str, y: float, z: float, bed: str) -> None:
    slope = math.tan(math.radians(2.0)) * y if "SLOPING" in bed else 0.0
    rows = [f"{n + 1}, {slope - 0.02 - 0.01 * n!r}, {y + 5.0 * n!r}, {z + 0.1 * n!r}" for n in range(4)]
    text = DECK.format(hidden=hidden, nodes="\n ".join(rows), bed=bed.format(hidden=hidden, y=y, z=z))
    deck = mudline.from_keyword(text, units="metric")
    made = anonymous(deck)
    written = dump(made.deck, "keyword")
    assert hidden.lower() not in written.lower()
    assert not re.search(r"^C\b", written, re.MULTILINE)
    assert made.left_out[0] == "PARAMETERS"
    before, after = (mudline.from_keyword(each, units="metric").scene() for each in (text, written))
    moved = before.coordinates - after.coordinates
    assert np.allclose(moved, [0.0, *made.shift], rtol=0.0, atol=1e-9)
    assert made.shift == ((0.0 if "SLOPING" in bed else float(round(y))), float(round(z)))
    one, other = before.contact().evaluate(), after.contact().evaluate()
    assert one.force.any()
    for name in ("force", "stiffness", "reaction"):
        a, b = getattr(one, name), getattr(other, name)
        assert np.abs(a - b).max() <= 1e-9 * np.abs(a).max(), name


def test_an_inline_profile_moves_with_the_nodes() -> None:
    nodes = "1, -0.02, 4000.0\n 2, -0.03, 4005.0\n 3, -0.03, 4010.0\n 4, 0.2, 4015.0"
    bed = "*ELASTIC SURFACE\n 40000.0\n 3990.0, 0.0\n 4008.0, 0.0\n 4100.0, 2.0\n"
    text = re.sub(
        r"\*SEABED PROPERTIES.*?(?=\$LOAD CASE)", bed, DECK.format(hidden="qq", nodes=nodes, bed=""), flags=re.DOTALL
    )
    made = anonymous(mudline.from_keyword(text, units="metric"))
    assert made.shift == (4000.0, 0.0)
    assert "-10.0, 0.0\n 8.0, 0.0\n 100.0, 2.0" in dump(made.deck, "keyword")


@pytest.mark.parametrize(
    "name", ["scr-touchdown.keyxm", "scr-dynamic.keyxm", "slope-friction.keyxm", "full-cycle.keyxm"]
)
def test_samples_pass_and_their_sets_have_other_names(name: str, tmp_path: Path) -> None:
    out = tmp_path / "given.keyxm"
    outcome = run("convert", SAMPLES / name, "--anonymous", "-o", out)
    assert (outcome.code, outcome.out) == (0, "")
    assert "forces are the same to 1e-09 of the largest" in outcome.err
    text = out.read_text(encoding="utf-8")
    old, new = (
        {*scene.sets, *scene.curves} for scene in (mudline.read(deck).scene() for deck in (SAMPLES / name, out))
    )
    assert {key.upper() for key in old & new} <= {"ALL"}
    assert not re.search(r"^C(\s|$)", text, re.MULTILINE)


def test_a_file_that_a_set_names_is_found_at_its_setting() -> None:
    deck = mudline.read(SAMPLES.parent / "tests/data/corpus/good/soil-from-file.keyxm")
    with pytest.raises(DeckError) as caught:
        anonymous(deck)
    (found,) = caught.value.diagnostics
    assert (found.line, found.column) == (16, 7)


def test_a_deck_that_needs_a_file_is_refused_where_it_names_it(tmp_path: Path) -> None:
    bed = "*SEABED PROFILE\n TYPE=2D\n FILE=bed.txt\n"
    text = DECK.format(hidden="qq", nodes="1, 0.0, 0.0\n 2, 0.0, 5.0\n 3, 0.0, 10.0\n 4, 0.0, 15.0", bed=bed)
    (tmp_path / "deck.keyxm").write_text(text, encoding="utf-8")
    (tmp_path / "bed.txt").write_text("-10.0, 0.0\n 90.0, 0.0\n", encoding="utf-8")
    with pytest.raises(DeckError) as caught:
        anonymous(mudline.read(tmp_path / "deck.keyxm"))
    (found,) = caught.value.diagnostics
    assert text.splitlines()[found.line - 1] == " FILE=bed.txt"
    assert "it names a file" in found.message


def test_a_deck_of_lines_is_refused_with_what_it_would_lose() -> None:
    outcome = run("convert", SAMPLES / "lines-deck.keyxm", "--anonymous", "--to", "keyword")
    assert (outcome.code, outcome.out) == (1, "")
    assert "the forces would change without *VESSEL, *LINES" in outcome.err


def test_nothing_is_written_when_the_forces_differ(monkeypatch: pytest.MonkeyPatch) -> None:
    needed = anonymizing._is_needed
    monkeypatch.setattr(
        anonymizing, "_is_needed", lambda name, block: block.keyword != "SEABED PLANES" and needed(name, block)
    )
    outcome = run("convert", SAMPLES / "slope-friction.keyxm", "--anonymous", "--to", "keyword")
    assert (outcome.code, outcome.out) == (1, "")
    assert "the forces would change without *SEABED PLANES" in outcome.err
