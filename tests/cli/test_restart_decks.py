"""A static deck and a dynamic one that continues it, from the command line."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.cli.conftest import Place
from tests.cli.runner import SAMPLES, run
from tests.helpers.builders.decks import CLEAN, ILLEGAL

DYNAMIC = "$LOAD CASE\n*RESTART\n LAST=static\n$MODEL\n*ELEMENT SETS\n SET=First\n SUBSET=Pipe\n"


@pytest.fixture
def pair(place: Place) -> str:
    """The dynamic deck of a pair."""
    place(CLEAN, "static.keyxm")
    return place(DYNAMIC, "dynamic.keyxm")


def test_evaluate_and_curves_as_of_the_static_deck(pair: str) -> None:
    for command in (["evaluate", "--output-format", "csv"], ["curves", "--output-format", "csv"]):
        one, other = (run(command[0], name, *command[1:]) for name in (pair, "static.keyxm"))
        assert one.code == other.code == 0
        assert one.out == other.out
        assert one.out.count("\n") > 2


def test_a_missing_deck_is_a_warning(place: Place) -> None:
    name = place(DYNAMIC, "dynamic.keyxm")
    found = run("lint", name, "--output-format", "concise", "--select", "REF015")
    assert found.out == (
        "dynamic.keyxm:3:7: REF015 the deck 'static' was not found (looked in . for static, static.keyxm, "
        "static.keyxi, static.keyx, static.das): correct the name, or put the deck there\n"
    )
    assert run("validate", name).code == 0
    assert run("show", name).out.startswith("dynamic.keyxm: metric units, 0+ nodes, 0+ elements, no seabed\n  $LOAD")


def test_errors_of_the_static_deck_are_told_with_their_file(place: Place) -> None:
    place(ILLEGAL, "static.keyxm")
    name = place(DYNAMIC, "dynamic.keyxm")
    assert run("validate", name).code == 0
    assert run("lint", name).code == 0
    found = run("evaluate", name)
    assert found.code == 1
    assert "static.keyxm:20:6: error: REF001" in found.err
    assert "dynamic.keyxm:" not in found.err
    shown = run("show", name)
    assert (shown.code, shown.err) == (1, "mudline: static.keyxm has 1 error: see mudline lint\n")


def test_a_file_that_is_not_there(place: Place) -> None:
    soil = '*P-Y\n SET=Pipe\n FILE=soil.txt\n*T-Z\n SET=Pipe\n FILE="%name%.txt"\n SET=a\n FILE=%other%.txt\n'
    name = place("$PREPROCESSOR\n*PARAMETERS\n name, Sand\n" + CLEAN + soil)
    found = run("lint", name, "--select", "REF015", "--output-format", "concise")
    lines = [line.partition(" REF015 ")[2] for line in found.out.splitlines()]
    assert lines == [
        "the file 'soil.txt' was not found (looked in .): correct the name, or put the file there",
        "the file 'Sand.txt' was not found (looked in .): correct the name, or put the file there",
    ]
    place("", "soil.txt")
    place("", "Sand.txt")
    assert run("lint", name, "--select", "REF015").code == 0


def test_the_samples(tmp_path: Path) -> None:
    positions = str(SAMPLES / "positions.csv")
    results = []
    for sample in ("scr-dynamic.keyxm", "scr-touchdown.keyxm"):
        out = tmp_path / f"{sample}.csv"
        assert run("evaluate", str(SAMPLES / sample), "--positions", positions, "-o", str(out)).code == 0
        results.append(out.read_bytes())
    assert results[0] == results[1]
