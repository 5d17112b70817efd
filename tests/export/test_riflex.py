"""The text for INPMOD: its groups, and what refers to what."""

from __future__ import annotations

from pathlib import Path

import pytest

from mudline.diagnostics import DeckError
from mudline.export import riflex
from mudline.export.report import Status
from tests.export.decks import BOTH, ELASTIC, EXPORTABLE, WEIGHT, model_of, sample, text

GROUPS = ("INPMOD", "UNIT", "NEW", "ARBITRARY", "SEAFLOOR", "ENVIRONMENT", "WATERDEPTH", "END")


def groups(content: str) -> dict[str, list[list[str]]]:
    """The lines of each group behind its title; groups of one title are joined."""
    found: dict[str, list[list[str]]] = {}
    title = ""
    for line in content.splitlines():
        if line.startswith("'"):
            continue
        if line.split()[0] in GROUPS:
            title = line
        else:
            found.setdefault(title, []).append(line.split())
    return found


@pytest.mark.parametrize("name", EXPORTABLE)
def test_every_name_that_is_referred_to_is_defined_and_short(name: str) -> None:
    content = riflex.write(sample(name), "a.inp")["a.inp"]
    assert max(map(len, content.splitlines())) <= 260
    found = groups(content)
    segments = [row for row in found["NEW LINE DATA"] if len(row) == 5]
    sections = {row[0] for row in found["NEW COMPONENT CRS1"] if len(row) == 2 and row[1] == "0.0" and row[0] != "0.0"}
    assert {row[0] for row in segments} == sections
    seabeds = {row[0] for row in found["NEW COMPONENT SEAFLOOR"] if row[1] == "SPRI"}
    assert {row[0] for row in found["SEAFLOOR CONTACT SPECIFICATION"][1:]} <= seabeds
    assert all(len(each) <= 8 for each in sections | seabeds)
    assert content.endswith("END\n")


def test_a_line_on_a_linear_seabed() -> None:
    found = groups(riflex.write(model_of(text()), "a.inp")["a.inp"])
    assert found["ARBITRARY SYSTEM AR"] == [
        ["2", "1", "2", "0", "0", "0", "0"],
        ["3", "-100.0", "0"],
        ["LINE1", "LTYPE1", "SN1", "SN2"],
        ["SN1", "0", "1", "1", "1", "0", "0", "0", "GLOBAL", "NO"],
        ["0.0", "0.0", "-100.0", "0.0", "0.0", "-100.0", "0.0", "0.0"],
        ["SN2", "0", "1", "1", "1", "0", "0", "0", "GLOBAL", "NO"],
        ["50.0", "0.0", "-100.0", "50.0", "0.0", "-100.0", "0.0", "0.0"],
    ]
    assert found["NEW LINE DATA"] == [["LTYPE1", "1", "0", "0", "0", "0"], ["ALL", "0", "0", "10", "50.0"]]
    assert found["SEAFLOOR CONTACT SPECIFICATION"] == [["1"], ["SOIL1", "LINE1", "1"]]
    name, normal, axial, lateral = found["NEW COMPONENT SEAFLOOR"]
    assert (name, normal) == (["SOIL1", "SPRI"], ["20000.0", "0.0"])
    assert [float(word) for word in axial] == pytest.approx([0.3 * WEIGHT / 0.01, 0.3, 0.0])
    assert [float(word) for word in lateral] == pytest.approx([0.5 * WEIGHT / 0.02, 0.5, 0.0, 0])
    assert found["WATERDEPTH AND WAVETYPE"] == [["100.0", "0", "0", "0", "0"]]
    assert found["UNIT NAMES SPECIFICATION"] == [["s", "m", "kg", "N", "10.0", "1.0"]]


def test_a_line_is_straight_and_as_long_as_its_segments_without_stress() -> None:
    found = groups(riflex.write(sample("scr-touchdown.keyxm"), "a.inp")["a.inp"])
    x0, y0, z0 = (float(word) for word in found["ARBITRARY SYSTEM AR"][4][:3])
    x1, y1, z1 = (float(word) for word in found["ARBITRARY SYSTEM AR"][6][:3])
    length = sum(float(row[4]) for row in found["NEW LINE DATA"] if len(row) == 5)
    assert ((x1 - x0) ** 2 + (y1 - y0) ** 2 + (z1 - z0) ** 2) ** 0.5 == pytest.approx(length, rel=1e-12)


def test_elements_without_a_law_have_no_contact() -> None:
    model = model_of(text(sets="*ELEMENT SETS\n SET=Half\n GEN=1, 5\n", bed=ELASTIC.replace("ALL", "Half")))
    found = groups(riflex.write(model, "a.inp")["a.inp"])
    assert [row[-1] for row in found["SEAFLOOR CONTACT SPECIFICATION"]] == ["1", "1"]
    assert [row[3:] for row in found["NEW LINE DATA"][1:]] == [["5", "25.0"], ["5", "25.0"]]


def test_a_bending_section_without_torsion_gets_some() -> None:
    sections = " OPTION=FLEXIBLE\n SET=ALL\n 1000.0, 1000.0, , 1.0E8, 50.0, 0.1, 0.0, 0.1, 0.1\n"
    model = model_of(text(sections=sections))
    found = groups(riflex.write(model, "a.inp")["a.inp"])
    assert found["NEW COMPONENT CRS1"][4:6] == [["1000.0"], ["1000.0"]]
    assert any(entry.keyword == "*GEOMETRIC SETS GJ" for entry in model.report.lost)


def test_an_uneven_seabed_is_flat_with_the_error_in_the_list(tmp_path: Path) -> None:
    (tmp_path / "bed.txt").write_text("0, 0.0\n50, -2.0\n")
    model = model_of(text(bed=ELASTIC + "*SEABED PROFILE\n TYPE=2D\n FILE=bed.txt\n", held=BOTH), folder=tmp_path)
    found = groups(riflex.write(model, "a.inp")["a.inp"])
    assert found["ARBITRARY SYSTEM AR"][1] == ["3", "-101.0", "0"]
    (entry,) = (entry for entry in model.report.entries if entry.keyword == "*SEABED PROFILE")
    assert (entry.status, entry.effect[:14]) == (Status.APPROXIMATED, "up to 1 m off ")


def test_more_than_the_program_takes_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(riflex, "_MOST", 1)
    with pytest.raises(DeckError, match="RIFLEX takes 1 line types and components"):
        riflex.write(model_of(text()), "a.inp")
