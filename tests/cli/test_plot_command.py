"""`mudline plot`: the pictures of `mudline evaluate` from result files."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from unittest.mock import patch

import pytest

pytest.importorskip("matplotlib")

from tests.cli.conftest import Place
from tests.cli.runner import run
from tests.cli.test_evaluate_files import STEPS

CURVE = re.compile(r'<g id="line2d_\d+">\s*<path d="([^"]+)"')


@pytest.fixture
def steps(place: Place) -> Callable[[str], str]:
    """Writes results of two steps to a file, and returns its name."""

    def put(name: str) -> str:
        outcome = run("evaluate", place(), "--positions", place(STEPS, "steps.csv"), "-o", name, "-q")
        assert outcome.code == 0
        return name

    return put


@pytest.mark.parametrize("form", ["csv", "json", "npz"])
def test_a_file_gives_the_picture_of_its_evaluation(
    steps: Callable[[str], str], place: Place, folder: Path, form: str
) -> None:
    options = ("--panels", "line,force,envelope,traces", "-q")
    assert run("plot", steps(f"out.{form}"), "-o", "from-file.svg", *options).code == 0
    run("evaluate", place(), "--positions", "steps.csv", "--plot", "from-deck.svg", *options)
    found, wanted = ((folder / f"from-{each}.svg").read_text(encoding="utf-8") for each in ("file", "deck"))
    assert f"out.{form}" in found
    assert CURVE.findall(found) == CURVE.findall(wanted)
    assert len(CURVE.findall(found)) > 20


def test_points_are_drawn_without_their_curves(steps: Callable[[str], str], folder: Path) -> None:
    outcome = run("plot", steps("out.npz"), "-o", "p.svg", "--panels", "curves")
    assert (outcome.code, outcome.out, outcome.err) == (0, "", "mudline: plot -> p.svg\n")
    assert "<!-- Clay -->" in (folder / "p.svg").read_text(encoding="utf-8")


def test_an_animation(steps: Callable[[str], str], folder: Path) -> None:
    outcome = run("plot", steps("out.npz"), "-o", "a.gif")
    assert (outcome.code, outcome.err) == (0, "mudline: animation -> a.gif\n")
    assert (folder / "a.gif").read_bytes().startswith(b"GIF")


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("-o", "p.jpg"), "p.jpg: unknown file format: give a name ending in .png, .svg or .pdf"),
        (("-o", "p.svg", "--panels", "friction"), "the panel friction cannot be drawn: there is neither friction nor"),
        (("-o", "p.svg", "--panels", "loop"), "the panel loop cannot be drawn: it needs the numbers of elements"),
        (("-o", "p.svg", "--panels", "wine"), "no panel is called 'wine'"),
        (("-o", "p.svg", "--plot-elements", "9"), "no evaluated element has the number 9"),
        (("-o", "a.gif", "--panels", "line"), "--panels is for a plot: give -o with a picture"),
        (("-o", "nowhere/p.svg", "--panels", "line"), "nowhere/p.svg: cannot be written"),
        ((), "Missing option '-o'"),
    ],
)
def test_wrong_usage(steps: Callable[[str], str], folder: Path, options: tuple[str, ...], message: str) -> None:
    outcome = run("plot", steps("out.npz"), *options)
    assert (outcome.code, outcome.out) == (2, "")
    assert message in outcome.err
    assert not list(folder.glob("[pa].*"))


def test_a_state_is_not_animated(place: Place) -> None:
    run("evaluate", place(), "-o", "out.npz", "-q")
    outcome = run("plot", "out.npz", "-o", "a.html")
    assert (outcome.code, "a.html: an animation needs time steps, and this is one state" in outcome.err) == (2, True)


def test_files_that_are_no_results(place: Place, folder: Path) -> None:
    outcome = run("plot", "nowhere.npz", "-o", "p.svg")
    assert (outcome.code, outcome.err) == (2, "mudline: nowhere.npz: no such file or directory\n")
    outcome = run("plot", place(), "-o", "p.svg")
    assert (outcome.code, "deck.keyxm: results are in files .csv" in outcome.err) == (2, True)
    outcome = run("plot", place("a,b\n1,2\n", "other.csv"), "-o", "p.svg")
    assert (outcome.code, outcome.err.startswith("other.csv:1:1: error: DAT001 ")) == (1, True)
    assert not (folder / "p.svg").exists()


def test_without_matplotlib(steps: Callable[[str], str]) -> None:
    name = steps("out.npz")
    with patch.dict("sys.modules", {"mudline.results.plots": None}):
        outcome = run("plot", name, "-o", "p.png")
    assert (outcome.code, outcome.err) == (1, "mudline: .png needs matplotlib: pip install 'mudline[plot]'\n")
