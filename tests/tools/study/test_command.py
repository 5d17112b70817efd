"""`mudline study`: its screen on samples, JSON, CSV, pictures and faults."""

from __future__ import annotations

import csv
from pathlib import Path

import pytest

from mudline.tools.study import precision, report, stability
from tests.cli.runner import SAMPLES, assert_fits, run
from tests.tools.study.decks import CURVE, EVERYTHING, Ticking, deck

DECKS = ("scr-dynamic.keyxm", "full-cycle.keyxm", "imperial-riser.keyxi")
"""With a time step, with suction, and in feet and pounds."""


@pytest.fixture(autouse=True)
def coarse(monkeypatch: pytest.MonkeyPatch) -> None:
    """Few steps, and a clock that does not depend on the machine: what is shown is what is tested here."""
    monkeypatch.setattr(precision, "_PER_OCTAVE", 3)
    monkeypatch.setattr(precision, "SMALLEST", 0.1)
    monkeypatch.setattr(stability, "_COARSE", 1.5)
    monkeypatch.setattr(stability, "_FINE", 1.1)
    monkeypatch.setattr(report.study, "__kwdefaults__", {**(report.study.__kwdefaults__ or {}), "timer": Ticking()})


@pytest.fixture
def small(tmp_path: Path) -> Path:
    path = tmp_path / "small.keyxm"
    path.write_text(
        deck(
            CURVE.format(first="0.0").replace("STIFFNESS=Crust\n", "STIFFNESS=Crust\n FRICTION=0.4, 0.6, 0.003, 0.15\n")
        ),
        encoding="utf-8",
    )
    return path


@pytest.mark.covered
@pytest.mark.parametrize("name", DECKS)
def test_the_screen_of_a_sample_is_one_screen(name: str) -> None:
    outcome = run("study", SAMPLES / name)
    assert (outcome.code, outcome.err) == (0, "")
    lines = outcome.out.splitlines()
    assert len(lines) <= 60
    assert max(map(len, lines)) <= 100
    assert "What the deck needs: a step of" in outcome.out


def test_a_deck_without_elements_is_refused_as_evaluate_does() -> None:
    outcome = run("study", SAMPLES / "lines-deck.keyxm")
    assert (outcome.code, outcome.out) == (1, "")
    assert outcome.err == run("evaluate", SAMPLES / "lines-deck.keyxm").err
    assert "RUN001 the deck has no elements" in outcome.err


def test_the_screen_of_a_dynamic_deck_has_three_tables_and_advice(small: Path) -> None:
    outcome = run("study", small)
    assert outcome.out.startswith("Use velocity Verlet with ")
    titles = ["Error of speed, duration and largest force", "Stable steps of velocity Verlet", "What the deck needs"]
    places = [outcome.out.index(title) for title in titles]
    assert places == sorted(places)
    assert "error\n" not in outcome.out.splitlines()
    assert "at 50 ms" in outcome.out
    assert "% too fast" in outcome.out
    assert "Extremes of this deck: " in outcome.out


def test_parts_alone(small: Path) -> None:
    outcome = run("study", small, "--only", "stability", "--only", "pruning")
    assert "Error of speed" not in outcome.out
    assert "Stable steps" in outcome.out
    assert "What the deck needs" in outcome.out
    json = run("study", small, "--only", "pruning", "--output-format", "json").json()
    assert_fits(json, "study")
    assert [json[key] is None for key in ("precision", "stability", "extremes", "stages")] == [True, True, True, False]


@pytest.mark.parametrize("seabed", [EVERYTHING, CURVE.format(first="800.0")])
def test_json_has_its_form(seabed: str, tmp_path: Path) -> None:
    path = tmp_path / "deck.keyxm"
    path.write_text(deck(seabed), encoding="utf-8")
    outcome = run("study", path, "--output-format", "json", "-o", tmp_path / "study.json", "-q")
    found = outcome.json()
    assert_fits(found, "study")
    assert list(found) == ["format", "deck", "units", "advice", "precision", "stability", "extremes", "stages"]
    assert found["advice"]["own_step"] == 0.05
    assert (tmp_path / "study.json").read_text(encoding="utf-8") == outcome.out


def test_csv_has_a_table_for_each_part(small: Path) -> None:
    text = run("study", small, "--output-format", "csv").out
    tables = [list(csv.DictReader(part.splitlines())) for part in text.split("\n\n")]
    assert [next(iter(rows[0])) for rows in tables] == ["contact", "contact", "stage"]
    assert {row["scheme"] for row in tables[0]} == {"velocity Verlet", "HHT (-0.3)", "RK4"}
    assert float(tables[1][0]["explicit_step"]) > 0.0
    assert tables[1][0]["without_jump_step"] == ""


def test_the_plot_is_written_whatever_is_shown(small: Path, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    path = tmp_path / "work.svg"
    outcome = run("study", small, "--only", "pruning", "--plot", path)
    assert outcome.err == f"mudline: plot -> {path.as_posix()}\n"
    assert "Error of speed" not in outcome.out
    data = path.read_bytes()
    assert data.startswith(b"<?xml")
    assert len(data) > 10_000


def test_a_deck_with_nothing_to_draw_says_so(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    path = tmp_path / "deck.keyxm"
    path.write_text(deck(""), encoding="utf-8")
    outcome = run("study", path, "--plot", tmp_path / "work.png")
    assert outcome.code == 0
    assert "there is nothing to draw" in outcome.err
    assert not (tmp_path / "work.png").exists()
    assert outcome.out.startswith("No contact of this deck has a frequency: no element has a seabed law.\n")
    assert outcome.out.count("No contact of this deck") == 1


def test_a_deck_from_standard_input_in_other_units() -> None:
    text = deck(CURVE.format(first="0.0")).encode()
    outcome = run("study", "-", "--stdin-filename", "given.keyxm", "--units", "user", "--only", "stability", stdin=text)
    assert outcome.code == 0
    assert "[ms]" not in outcome.out
    assert "at 0.05" in outcome.out
    json = run("study", "-", "--stdin-filename", "x.keyxm", "--output-format", "json", stdin=text).json()
    assert (json["deck"], json["units"]) == ("x.keyxm", "metric")


def test_laws_that_do_not_hold_are_listed(small: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from mudline.tools.study import extremes  # noqa: PLC0415 - patched here alone

    monkeypatch.setattr(extremes, "_TOLERANCE", extremes._TOLERANCE / 10**5)
    outcome = run("study", small, "--only", "stability")
    assert outcome.code == 0
    assert "extreme cases do not hold." in " ".join(outcome.out.split())
    assert "exact is" in outcome.out
    assert "more failed: JSON has all" in outcome.out


def test_faults_end_the_command(tmp_path: Path, small: Path) -> None:
    assert run("study", SAMPLES / "broken.keyxm").code == 1
    assert run("study", tmp_path / "missing.keyxm").code == 2
    assert run("study").code == 2
    assert run("study", small, "--only", "guessing").code == 2
    assert "-o out.csv: unknown file format: give a name ending in .json" in run("study", small, "-o", "out.csv").err
    assert run("study", small, "--only", "pruning", "-o", tmp_path / "no" / "such.json").code == 2


@pytest.mark.parametrize(
    "text",
    [
        deck(CURVE.format(first="0.0").replace(" 0.00, 0.0\n", " 0.05, 0.0\n")),  # pulls at the mudline
        deck(CURVE.format(first="0.0").replace("9000.0", "9e290")),
        deck(CURVE.format(first="0.0").replace(" 0.50", " 0.1000001")),
        deck().replace("0.05,", "1e-9,"),
        deck().replace("50.0E3", "1e300"),
    ],
    ids=["pulls", "overflows", "narrow", "tiny step", "rigid"],
)
def test_extreme_decks_are_studied_as_far_as_they_can_be(text: str, tmp_path: Path) -> None:
    path = tmp_path / "deck.keyxm"
    path.write_text(text, encoding="utf-8")
    outcome = run("study", path, "--output-format", "json")
    assert (outcome.code, outcome.err) == (0, "")
    assert_fits(outcome.json(), "study")
    assert outcome.json()["extremes"]["failed"] == []
