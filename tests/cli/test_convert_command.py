"""`mudline convert`: between the three forms, to a file or to standard output."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from mudline.language.deck.loading import load_bytes, load_path
from tests.cli.conftest import Place
from tests.cli.runner import SAMPLES, process, run
from tests.helpers.builders.decks import BAD_NUMBER, CLEAN, UNSORTED
from tests.helpers.samples import FAULTY

LEGIBLE = sorted(path.name for path in SAMPLES.glob("*.key*") if path.name not in FAULTY)


@pytest.mark.parametrize("name", LEGIBLE)
def test_samples_make_the_round_trip(name: str, folder: Path) -> None:
    original = load_path(SAMPLES / name, name)
    for source, target in ((SAMPLES / name, "a.json"), ("a.json", "a.yaml"), ("a.yaml", "b.json"), ("b.json", name)):
        outcome = run("convert", source, "-o", target)
        assert (outcome.code, outcome.out) == (0, "")
    assert (folder / "a.json").read_bytes() == (folder / "b.json").read_bytes()
    back = load_path(folder / name, name)
    assert back == original
    assert run("convert", name, "--to", "json").output == (folder / "a.json").read_bytes()


def test_form_to_write_may_differ_from_the_suffix(place: Place, folder: Path) -> None:
    assert run("convert", place(), "-o", "deck.txt", "--to", "json").code == 0
    assert json.loads((folder / "deck.txt").read_text(encoding="utf-8"))["units"] == "metric"


def test_form_to_read_may_differ_from_the_suffix(place: Place) -> None:
    text = run("convert", place(), "--to", "json").output
    place(text, "deck.txt")
    outcome = run("convert", "deck.txt", "--from", "json", "--to", "keyword", "-o", "-")
    assert outcome.code == 0
    assert load_bytes(outcome.output, "deck.keyxm").sections == load_bytes(CLEAN.encode(), "deck.keyxm").sections


def test_document_from_standard_input() -> None:
    text = run("convert", "-", "--to", "yaml", stdin=CLEAN.encode()).output
    for options in (("--from", "yaml"), ("--stdin-filename", "x.yml")):
        outcome = run("convert", "-", "--to", "keyword", *options, stdin=text)
        assert outcome.code == 0
        assert outcome.out.startswith("$MODEL\n*OCEAN\n")


def test_curves_are_written_sorted(place: Place) -> None:
    block = run("convert", place(UNSORTED), "--to", "json", "--sorted").json()["sections"][0]["blocks"][-1]
    assert block["curves"][0]["points"] == [[0.0, 0.0], [0.1, 1000.0], [0.5, 3000.0]]


def test_curve_with_an_equation_for_a_ratio_keeps_its_order(place: Place) -> None:
    deck = UNSORTED.replace(" 0.5, 3000.0", " =[0.25*2], 3000.0")
    outcome = run("convert", place(deck), "--to", "json", "--sorted")
    assert outcome.code == 0
    assert outcome.err == "mudline: curve Clay keeps its order: a ratio in it is an equation\n"
    points = outcome.json()["sections"][0]["blocks"][-1]["curves"][0]["points"]
    assert points == [[0.1, 1000.0], [0.0, 0.0], ["=[0.25*2]", 3000.0]]


@pytest.mark.parametrize("target", ["out.json", "-"])
def test_deck_that_cannot_be_read_is_refused(place: Place, folder: Path, target: str) -> None:
    outcome = run("convert", place(BAD_NUMBER), "-o", target, "--to", "json")
    assert (outcome.code, outcome.out) == (1, "")
    assert outcome.err.startswith("deck.keyxm:6:11: error: SYN002 'ten' is not a number")
    assert not (folder / "out.json").exists()


def test_document_that_breaks_the_schema_is_refused_with_its_path(place: Place) -> None:
    document = run("convert", place(), "--to", "json").json()
    document["sections"][0]["blocks"][0]["depth"] = "deep"
    name = place(json.dumps(document, indent=1), "deck.json")
    outcome = run("convert", name, "--to", "keyword")
    assert (outcome.code, outcome.out) == (1, "")
    assert "DOC002 sections[0].blocks[0].depth: " in outcome.err


def test_bytes_are_utf_8_with_line_feeds_whatever_the_terminal_is(place: Place) -> None:
    name = place(CLEAN.replace("Clay", "Lehm\u00e4"))
    outcome = process("convert", name, "--to", "keyword", env={"PYTHONIOENCODING": "ascii"})
    assert outcome.code == 0
    assert " CURVE=Lehm\u00e4\n".encode() in outcome.output
    assert b"\r" not in outcome.output


@pytest.mark.parametrize(
    ("lines", "code"),
    [
        ("*OCEAN\n -5.0, 1025.0\n", "SBD010"),
        ("*SEABED STIFFNESS\n CURVE=a\n 0, 0\n", "CRV001"),
        ("$LOAD CASE\n*TIME\n STEP=FIXED\n 0, 10, -1\n", "SBD010"),
    ],
)
def test_values_that_no_document_holds(place: Place, folder: Path, lines: str, code: str) -> None:
    """The finding has its own code and place, nothing is written; keyword text keeps the deck as it is."""
    deck = place(f"$MODEL\n{lines}")
    for form in ("json", "yaml"):
        outcome = run("convert", deck, "-o", f"out.{form}")
        assert (outcome.code, outcome.out, (folder / f"out.{form}").exists()) == (1, "", False)
        assert f": error: {code} " in outcome.err
    assert run("convert", deck, "--to", "keyword").code == 0
