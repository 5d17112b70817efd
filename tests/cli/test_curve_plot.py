"""`mudline curves --plot`: a picture of the curves."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from xml.parsers import expat

import pytest

from tests.builders.decks import BAD_NUMBER, CLEAN, UNUSED
from tests.cli.conftest import Place
from tests.cli.runner import run

TEXT = re.compile(r"<!-- (.*?) -->")


def drawn(place: Place, deck: str, *options: str) -> str:
    """The texts of the picture, and that it is well-formed."""
    outcome = run("curves", place(deck), "--plot", "out.svg", "--output-format", "json", *options)
    assert (outcome.code, outcome.err) == (0, "")
    assert outcome.json()
    picture = Path("out.svg").read_text(encoding="utf-8")
    expat.ParserCreate().Parse(picture, True)
    return "\n".join(TEXT.findall(picture))


def test_png(place: Place, folder: Path) -> None:
    outcome = run("curves", place(), "--plot", "out.PNG")
    assert outcome.code == 0
    assert outcome.out.startswith("curve Clay")
    assert (folder / "out.PNG").read_bytes().startswith(b"\x89PNG\r\n")


def test_axes_have_units_and_curves_names(place: Place) -> None:
    texts = drawn(place, UNUSED)
    assert "embedment ratio, depth / diameter [-]" in texts
    assert "seabed reaction per unit length [N/m]" in texts
    assert "Clay" in texts
    assert "Sand" in texts
    assert "beyond the points" in texts
    assert "static embedment" not in texts


def test_what_was_asked_for_is_marked(place: Place) -> None:
    texts = drawn(place, CLEAN, "--at", "2", "--at", "-0.2", "--weight", "700")
    assert "values asked for" in texts
    assert "static embedment" in texts


@pytest.mark.parametrize(("units", "name"), [("imperial", "lbf/ft"), ("user", "force per length")])
def test_other_units(place: Place, units: str, name: str) -> None:
    assert f"seabed reaction per unit length [{name}]" in drawn(place, CLEAN, "--units", units)


def test_names_are_plain_text(place: Place) -> None:
    names = ["_hidden", "$\\frac$", "a_b^c", "\x07bell", "\u6f22\u5b57", "n" * 300]
    curves = "".join(f" CURVE={name}\n 0.0, 0.0\n 0.1, {i}.0\n" for i, name in enumerate(names, 1))
    texts = drawn(place, CLEAN + curves)
    for shown in ("_hidden", "$\\frac$", "a_b^c", "\ufffdbell", "\u6f22\u5b57", "n" * 37 + "..."):
        assert shown in texts


def test_same_curves_make_the_same_picture(place: Place, folder: Path) -> None:
    drawn(place, CLEAN)
    first = (folder / "out.svg").read_bytes()
    drawn(place, CLEAN)
    assert (folder / "out.svg").read_bytes() == first


def test_many_curves(place: Place) -> None:
    curves = "".join(f" CURVE=Extra {i}\n 0.0, 0.0\n 0.1, {i}.0\n" for i in range(1, 40))
    assert "Extra 39" in drawn(place, CLEAN + curves)


def test_long_curve(place: Place) -> None:
    points = "".join(f" {i / 1000}, {i}.0\n" for i in range(1, 200))
    assert "Clay" in drawn(place, CLEAN.partition(" 0.1, 1000.0")[0] + points)


@pytest.mark.parametrize("points", [" 0.0, 0.0\n 1.0E300, 1.0E300\n", " 1.0E308, 0.0\n 1.1E308, 1.0\n"])
def test_numbers_out_of_the_ordinary(place: Place, points: str) -> None:
    run("curves", place(CLEAN.partition(" 0.0, 0.0\n 0.1")[0] + points), "--plot", "out.png")
    assert Path("out.png").exists()


def test_deck_without_a_curve(place: Place, folder: Path) -> None:
    outcome = run("curves", place("$MODEL\n"), "--plot", "out.png")
    assert outcome.code == 0
    assert (folder / "out.png").exists()


def test_no_matplotlib(place: Place, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    for name in [name for name in sys.modules if name.startswith("mudline.results.plots")]:
        monkeypatch.delitem(sys.modules, name)
    outcome = run("curves", place(), "--plot", "out.png")
    assert (outcome.code, outcome.out) == (1, "")
    assert outcome.err == "mudline: --plot needs matplotlib: pip install 'mudline[plot]'\n"
    assert not (folder / "out.png").exists()


@pytest.mark.parametrize("name", ["out.pdf", "out", "png"])
def test_other_forms_are_wrong_usage(place: Place, name: str) -> None:
    outcome = run("curves", place(), "--plot", name)
    assert (outcome.code, outcome.out) == (2, "")
    assert f"{name}: unknown file format: give a name ending in .png or .svg" in outcome.err


def test_folder_that_is_missing(place: Place) -> None:
    outcome = run("curves", place(), "--plot", "nowhere/out.png")
    assert (outcome.code, outcome.out) == (2, "")
    assert outcome.err == "mudline: nowhere/out.png: cannot be written: no such file or directory\n"


def test_deck_that_cannot_be_read_draws_nothing(place: Place, folder: Path) -> None:
    assert run("curves", place(BAD_NUMBER), "--plot", "out.png").code == 1
    assert not (folder / "out.png").exists()
