"""The page to sign: its document block, inputs and numbers, and what it says beside them."""

from __future__ import annotations

import re
from pathlib import Path

from tests.cli.runner import run
from tests.helpers.samples import SAMPLES
from tests.tools.reporting.pages import ON_SOIL, Page, checked, made, row_of


def test_the_document_block_and_its_place_in_print(tmp_path: Path) -> None:
    words = ("--title", "Riser <A>", "--document", "P-001", "--revision", "B", "--field", "Client=A = B")
    text = made(tmp_path, str(SAMPLES / "legacy-flowline.keyxm"), *words, "--field", "Job=7", sections="verdict")
    page = checked(text)
    assert "<h1>Riser &lt;A&gt;</h1>" in text
    block = re.findall(r"<dt>(.*?)</dt><dd>(.*?)</dd>", text)
    assert block[:4] == [("Document", "P-001"), ("Revision", "B"), ("Client", "A = B"), ("Job", "7")]
    (head,) = re.findall(r'@top-left \{ content: "(.*?)"; \}', text)
    assert (
        re.sub(r"\\([0-9a-f]+) ", lambda code: chr(int(code[1], 16)), head)
        == "P-001, revision B, legacy-flowline.keyxm"
    )
    assert page.ids.index("verdict") < page.ids.index("sign") < page.ids.index("interpretation")
    assert "--field 'Client'" in run("report", "x.keyxm", "-o", "x.html", "--field", "Client").err


def test_folders_of_this_computer_do_not_stand_on_the_page(tmp_path: Path) -> None:
    deck = tmp_path / "decks" / "deck.keyxm"
    deck.parent.mkdir()
    deck.write_text(ON_SOIL + "*SEABED PROFILE\n TYPE=2D\n FILE=none.txt\n", encoding="utf-8")
    text = made(tmp_path, str(deck))
    assert "'none.txt' was not found (looked in the folder of the deck)" in Page(text).text
    assert str(tmp_path) not in text


def test_a_deck_that_continues_another_says_so_and_has_its_inputs(tmp_path: Path) -> None:
    (tmp_path / "base.keyxm").write_text(ON_SOIL + "*OCEAN\n 120.0, 1025.0, 9.81\n", encoding="utf-8")
    deck = tmp_path / "next.keyxm"
    case = "$LOAD CASE\n*RESTART\n LAST=base\n TYPE=STATIC\n*WAVE-REGULAR\n 6.0, 10.0, 180.0\n"
    deck.write_text(case, encoding="utf-8")
    text = made(tmp_path, str(deck))
    assert "<dt>Continues</dt><dd>base.keyxm</dd>" in text
    assert row_of(text, "$LOAD CASE").endswith("*RESTART | LAST=base; TYPE=STATIC | 2")
    assert "<td>amplitude 6 m, period 10 s, direction 180 deg</td><td>5</td>" in text
    assert "<td>depth 120 m; density 1025 kg/m3; gravity 9.81 m/s2</td><td>37 of base.keyxm</td>" in text


def test_the_page_has_the_qualifications_of_evaluate(tmp_path: Path) -> None:
    deck = str(SAMPLES / "scr-vessel.keyxm")
    said = run("evaluate", deck).err.removeprefix("mudline: ").strip()
    text = made(tmp_path, deck)
    assert said in Page(text).text
    assert (
        Page(text).text.count("weights without *DRAG CHAIN") == 5
    )  # figures, sheet, embedment, equilibrium, touchdown
    assert '<td>the same, empty [N]</td><td class="number">291900</td>' in text


def test_five_numbers_beside_the_verdict(tmp_path: Path) -> None:
    text = made(tmp_path, str(SAMPLES / "scr-vessel.keyxm"), sections="verdict")
    assert row_of(text, "305.1") == "305.1 | 305.1 | 0.0366 | 283300 | 0.7325"
    assert "at the deck&#39;s own coordinates; no load case is solved" in text
    assert "at the resting shape; no load case is solved" in made(
        tmp_path, str(SAMPLES / "scr-vessel.keyxm"), "--rest-shape", sections="verdict"
    )
    text = made(tmp_path, str(SAMPLES / "full-cycle.keyxm"), sections="verdict")
    (codes,) = re.findall("warnings about these numbers: (.*?)</p>", text)
    warned = run("evaluate", str(SAMPLES / "full-cycle.keyxm")).err
    assert all(code in warned for code in codes.split(", "))
    laid = tmp_path / "deck.keyxm"
    laid.write_text(ON_SOIL.replace(" 11, 3, 4\n", "").replace(" SET=Free\n 11\n", " SET=Free\n"), encoding="utf-8")
    assert "all on the seabed | 10 | 0.01 |" in row_of(
        made(tmp_path, str(laid), sections="verdict"), "all on the seabed"
    )


def test_inputs_that_are_not_read_stand_as_they_are(tmp_path: Path) -> None:
    text = made(tmp_path, str(SAMPLES / "scr-vessel.keyxm"), sections="inputs")
    assert "TYPE=VESSEL, not read: 157, Semi" in text
    assert "elevation [m], velocity [m/s], direction [deg]: 0, 0.1, 180 / 400, 0.25, 180 / 800, 1.1, 180" in text
    assert row_of(text, "41 to 110") == "41 to 110 | Touchdown | 300 | 0.2731 | 0.2223 | 10.75 | "
    weights = text[text.index("Sheet: mass and submerged weight") :]
    assert row_of(weights, "41 to 110") == "41 to 110 | 155.1 | 820 | 186.9 |  | 932.7 | 1245"
    assert '<td class="gap">none</td>' in text


def test_every_value_has_its_own_unit(tmp_path: Path) -> None:
    springs = "*NODE SPRING\n 1, 2, 500.0\n 1, 4, 30.0\n*MASS\n 1, 7.0\n 1, 8.0, TYPE=ROTARY INERTIA\n"
    case = (
        "$LOAD CASE\n*BOUNDARY\n TYPE=CONSTANT\n GEN=1, 3, 1, 4, 0.5\n 2, 4, 1.5\n 2, 1, 1.5\n"
        "*DRIFT\n VESSEL=F, TYPE=SINUSOIDAL\n 6, 4.0, 0.0, 120.0\n"
        "*RAO\n VESSEL=F\n HEADING=0.0\n 0.1\n 0.9, 0.4, 0.0, 0.0, 0.0, 1.1\n 10.0, 90.0, 0.0, 0.0, 0.0, -80.0\n"
    )
    bed = "*SEABED SUCTION\n SET=ALL\n COHESION=2000.0\n"
    metric, imperial = tmp_path / "a.keyxm", tmp_path / "a.keyxi"
    for deck in (metric, imperial):
        deck.write_text(ON_SOIL + springs + bed + case, encoding="utf-8")
    words = Page(made(tmp_path, str(metric), sections="inputs,curves", code=1)).text
    for told in (
        "stiffness 500 N/m; ",
        "stiffness 30 N m/deg",
        "mass 7 kg; node 1, mass 8 kg m2, TYPE=ROTARY INERTIA",
        "(GEN=1, 3, 1, 4, 0.5), (node 2, dof 4, value 1.5 deg), (node 2, dof 1, value 1.5 m)",
        "amplitude 4 deg",
        "heave 0.9 m/m",
        "pitch 1.1 deg/m",
        "COHESION=2000 N/m2",
    ):
        assert told in words
    words = Page(made(tmp_path, str(imperial), sections="inputs,curves", code=1)).text
    for told in ("mass 8 slug ft2", "stiffness 30 lbf ft/deg", "pitch 1.1 deg/ft", "COHESION=2000 lbf/ft2"):
        assert told in words


def test_warnings_of_the_deck_are_told_from_those_of_the_numbers_and_curves_without_a_law(tmp_path: Path) -> None:
    deck = tmp_path / "deck.keyxm"
    bare = ON_SOIL.partition("*SEABED PROPERTIES")[0]
    deck.write_text(bare + "*MOMENT-CURVATURE\n CURVE=Bend\n 0.0, 0.0\n 4.0, 1.0\n", encoding="utf-8")
    text = made(tmp_path, str(deck))
    assert re.search(r"\d+ warnings? in the deck\.", Page(text).text)
    assert (
        'The deck gives no law of the seabed; its other curves are <a href="#more-curves">in the appendix</a>.' in text
    )
