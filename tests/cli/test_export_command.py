"""`mudline export`: files, the table of what does not carry over, exit codes."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.cli.runner import SAMPLES, assert_fits, run
from tests.tools.exporting.decks import ELASTIC, text

WATER = "*HYDRODYNAMIC SETS\n SET=ALL\n 1.5, 0.0, 2.0, 0.8\n"
PLAIN = text(bed=ELASTIC.replace(" FRICTION=0.3, 0.5, 0.01, 0.02\n", "") + WATER)


@pytest.mark.parametrize("target", ["moordyn", "orcaflex"])
def test_a_sample_is_written_with_its_list(target: str, tmp_path: Path) -> None:
    out = tmp_path / "model.txt"
    outcome = run("export", str(SAMPLES / "scr-touchdown.keyxm"), "--to", target, "-o", str(out))
    assert outcome.code == 0
    assert "model.txt" in outcome.err
    assert "What does not carry over" in outcome.out
    assert "carried; JSON lists them too" in outcome.out
    head = out.read_text(encoding="ascii")[:4000]
    assert "model of scr-touchdown.keyxm" in head
    assert "*SEABED PROPERTIES, *SEABED STIFFNESS (299, 302, 310) approximated: " in head
    assert "25.51 kN/m2" in head


def test_json_has_what_is_carried_too(tmp_path: Path) -> None:
    out = tmp_path / "model.yml"
    arguments = ("--to", "orcaflex", "-o", str(out), "--output-format", "json")
    outcome = run("export", str(SAMPLES / "scr-touchdown.keyxm"), *arguments)
    found = outcome.json()
    assert_fits(found, "export")
    assert (found["target"], found["exact"], found["files"]) == ("orcaflex", False, [out.as_posix()])
    curves = [entry for entry in found["entries"] if entry["keyword"] == "*SEABED STIFFNESS"]
    assert [(entry["line"], entry["status"]) for entry in curves] == [(310, "approximated"), (323, "approximated")]
    assert curves[1]["effect"] == (
        "curve 'Flowline Clay': secant 105.8 kN/m2 at W (8.82 mm), tangent there 54.2 kN/m2; sinks 36.6 mm here, as "
        "the target has one stiffness"
    )
    assert {"carried", "approximated", "left out"} == {entry["status"] for entry in found["entries"]}


def test_strict_is_1_where_something_is_lost_and_writes_all_the_same(tmp_path: Path) -> None:
    out = tmp_path / "model.inp"
    assert run("export", str(SAMPLES / "scr-touchdown.keyxm"), "--to", "orcaflex", "-o", str(out), "--strict").code == 1
    assert out.exists()
    deck = tmp_path / "deck.keyxm"
    deck.write_text(PLAIN)
    outcome = run("export", str(deck), "--to", "orcaflex", "-o", str(out), "--strict")
    assert outcome.code == 0
    assert outcome.out.startswith("All carries over: ")


def test_a_seabed_of_its_own_is_a_second_file(tmp_path: Path) -> None:
    deck, out = tmp_path / "deck.keyxm", tmp_path / "my model.txt"
    deck.write_text(text(bed=ELASTIC + "*SEABED PROFILE\n TYPE=SLOPING\n SLOPE=2.0\n"))
    outcome = run("export", str(deck), "--to", "moordyn", "-o", str(out))
    assert outcome.code == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == ["deck.keyxm", "my model.txt", "my_model-seabed.txt"]
    assert "my_model-seabed.txt" in outcome.err


def test_entries_of_another_file_have_its_name(tmp_path: Path) -> None:
    (tmp_path / "model.keyxm").write_text(PLAIN.partition("$LOAD CASE")[0])
    case = "$LOAD CASE\n*RESTART\n LAST=model, TYPE=DYNAMIC\n*ANALYSIS TYPE\n TYPE=TIME DOMAIN\n"
    case += "*BOUNDARY\n TYPE=CONSTANT\n"
    case += "".join(f" {node}, {freedom}\n" for node in (1, 11) for freedom in (1, 2))
    (tmp_path / "case.keyxm").write_text(case)
    arguments = ("--to", "moordyn", "-o", str(tmp_path / "a.txt"))
    outcome = run("export", str(tmp_path / "case.keyxm"), *arguments)
    assert outcome.code == 0
    assert "free in DOF 3 in the deck" in " ".join(outcome.out.split())
    found = run("export", str(tmp_path / "case.keyxm"), *arguments, "--output-format", "json").json()
    assert {Path(entry["file"]).name for entry in found["entries"]} == {"case.keyxm", "model.keyxm"}


def test_a_folder_that_is_not_there(tmp_path: Path) -> None:
    deck = tmp_path / "deck.keyxm"
    deck.write_text(PLAIN)
    outcome = run("export", str(deck), "--to", "orcaflex", "-o", str(tmp_path / "no/folder/a.inp"))
    assert (outcome.code, "cannot be written" in outcome.err) == (2, True)


def test_a_refusal_names_the_cause(tmp_path: Path) -> None:
    deck = tmp_path / "deck.keyxm"
    deck.write_text(PLAIN.replace("*GEOMETRIC SETS", "GEOMETRIC SETS"), encoding="utf-8")
    out = tmp_path / "model.txt"
    outcome = run("export", str(deck), "--to", "moordyn", "-o", str(out))
    assert outcome.code == 1
    assert "without its star" in outcome.err
    assert outcome.err.count("error:") == 1
    assert not out.exists()
