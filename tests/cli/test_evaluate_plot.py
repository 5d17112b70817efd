"""`mudline evaluate --plot`."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.cli.conftest import Place
from tests.cli.runner import run
from tests.cli.test_evaluate_files import STEPS
from tests.helpers.builders.decks import CLEAN

pytest.importorskip("matplotlib")


def words(folder: Path) -> str:
    """The texts of an SVG picture stand in its comments."""
    return (folder / "p.svg").read_text(encoding="utf-8")


def test_steps_have_traces(place: Place, folder: Path) -> None:
    options = ("--positions", place(STEPS, "steps.csv"), "--plot", "p.svg", "-o", "out.json")
    assert run("evaluate", place(), *options).code == 0
    text = words(folder)
    for label in ("time [s]", "total reaction", "least to largest", "when the total reaction is largest"):
        assert label in text, label
    assert (folder / "out.json").exists()


@pytest.mark.parametrize(
    "deck",
    [
        CLEAN.replace("-0.1,", "9.0,"),
        CLEAN.replace(" 2, 2, 3\n", "").replace(" 1, 2\n*GEO", " 1\n*GEO"),
        CLEAN.replace("-0.1, 0.0\n 2,", "-0.2, 10.0\n 2,").replace("20.0\n*E", "10.0\n*E"),
        CLEAN.partition("*SEABED PROPERTIES")[0],
        CLEAN.replace("Clay", "C$l$ay <&"),
        CLEAN.replace("20.0\n*E", "1.0E150\n*E"),
    ],
    ids=["above the bed", "one element", "vertical", "no law", "odd name", "huge"],
)
def test_odd_scenes(place: Place, folder: Path, deck: str) -> None:
    outcome = run("evaluate", place(deck), "--plot", "p.png")
    assert outcome.code == 0
    assert (folder / "p.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--plot-elements", "1"), "--plot-elements: force over penetration needs time steps, and this is one state"),
        (("--positions", "steps.csv", "--plot-elements", "1,7"), "no evaluated element has the number 7"),
        (("--plot-elements", "1,b"), "--plot-elements: 'b' is not an element number; give numbers as 12,13"),
    ],
)
def test_what_cannot_be_drawn_is_wrong_usage(
    place: Place, folder: Path, options: tuple[str, str], message: str
) -> None:
    place(STEPS, "steps.csv")
    outcome = run("evaluate", place(), "--plot", "p.svg", "-o", "out.json", *options)
    assert (outcome.code, outcome.out) == (2, "")
    assert message in outcome.err
    assert sorted(file.name for file in folder.iterdir()) == ["deck.keyxm", "steps.csv"], "nothing is written"


def test_elements(place: Place, folder: Path) -> None:
    options = ("--positions", place(STEPS, "steps.csv"), "--plot", "p.svg", "-q")
    assert run("evaluate", place(), *options, "--plot-elements", "2, 1").code == 0
    text = words(folder)
    assert text.index("penetration of element 2 [m]") < text.index("penetration of element 1 [m]")
