"""`mudline backbone`: what is printed is a curve of a deck, and says where it comes from."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import mudline
from mudline.model.curves.backbones import MODELS, Backbone, Soil
from tests.cli.runner import run

CLAY = ("--diameter", "0.3", "--strength", "5000,1500")
DECK = """\
$MODEL
*NODE
 1, -0.03, 0
 2, -0.03, 1
*ELEMENT
 1, 1, 2
*GEOMETRIC SETS
 OPTION=RIGID
 SET=ALL
 207.0E9, 79.6E9, 0.3, 0.28, 7850.0
{bed}
"""
NEW = "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=Clay\n"
OLD = "*ELASTIC SURFACE\n 5000\n"


def curve(text: str) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    (found,) = mudline.from_keyword(text).scene().curves.values()
    return np.column_stack((found.ratios, found.forces))


@pytest.mark.parametrize("model", sorted(MODELS))
@pytest.mark.parametrize("legacy", [False, True])
def test_a_deck_reads_the_points_of_the_model(model: str, legacy: bool) -> None:
    name = "ALL" if legacy else "Clay"
    outcome = run("backbone", model, *CLAY, "--name", name, *["--legacy"] * legacy)
    assert (outcome.code, outcome.err) == (0, "")
    points = Backbone(MODELS[model], Soil(0.3, 5000.0, 1500.0)).points(MODELS[model].published, 0.005, 0.001)
    assert curve(DECK.format(bed=(OLD if legacy else NEW) + outcome.out)).tolist() == points.tolist()


@pytest.mark.parametrize(("axis", "seabed"), [(-0.03, ""), (0.12, "*SEABED PROFILE\n TYPE=2D\n FILE=bed.txt\n")])
def test_the_datum_takes_the_shift_from_axis_to_invert(folder: Path, axis: float, seabed: str) -> None:
    """The invert of a pipe of 0.3 m is 0.03 m deep: nodes D/2 lower, or the seabed D/2 higher, as the page has it."""
    (folder / "bed.txt").write_text("0, 0.15\n100, 0.15\n", encoding="ascii")
    block = run("backbone", "f114", *CLAY, "--name", "Clay").out
    deck = folder / "deck.keyxm"
    deck.write_text(DECK.format(bed=NEW + block + seabed).replace("-0.03", str(axis)), encoding="ascii")
    result = mudline.read(deck).scene().contact().evaluate()
    expected = Backbone(MODELS["f114"], Soil(0.3, 5000.0, 1500.0)).force(np.array([0.1]))
    assert result.force == pytest.approx(expected, rel=0.01)
    assert run("lint", deck, "--isolated", "--select", "CRV006").code == 0


def test_beyond_the_published_range() -> None:
    outcome = run("backbone", "f114", *CLAY, "--depth", "0.7")
    assert (outcome.code, outcome.out) == (1, "")
    assert outcome.err == (
        "mudline: f114 ends at z/D = 0.5: beyond half the diameter its users warn of the result. "
        "Give --extend to go on to 0.7\n"
    )
    extended = run("backbone", "f114", *CLAY, "--depth", "0.7", "--extend")
    assert extended.code == 0
    assert "warn of the result; the last points are beyond it\n" in extended.out
    assert extended.out.splitlines()[-1].startswith(" 0.7, ")
    assert run("backbone", "f114", *CLAY, "--depth", "0.4").out.splitlines()[-1].startswith(" 0.4, ")


@pytest.mark.parametrize(
    ("given", "says"),
    [
        (("--diameter", "0", "--strength", "1"), "--diameter must be a number above 0, not 0.0"),
        (("--diameter", "1", "--strength", "0"), "expected su0 > 0, or su0,gradient with a gradient >= 0"),
        (("--diameter", "1", "--strength", "1,-1"), "expected su0 > 0"),
        (("--diameter", "1", "--strength", "1,1,1"), "expected su0 > 0"),
        (("--diameter", "1", "--strength", "a"), "'a': expected su0 > 0"),
        ((*CLAY, "--weight", "-1"), "--weight must be a number of 0 or more, not -1.0"),
        ((*CLAY, "--depth", "-1"), "--depth must be a number above 0, not -1.0"),
        ((*CLAY, "--first", "0.5"), "--first must be a ratio z/D below 0.5, not 0.5"),
        ((*CLAY, "--name", "a, b"), "--name 'a, b' is not what a deck reads as a name"),
        ((*CLAY, "--tolerance", "1"), "1.0 is not in the range"),
        (("--diameter", "1e200", "--strength", "1e200"), "the force is too large or too small for a float64"),
    ],
)
def test_wrong_usage(given: tuple[str, ...], says: str) -> None:
    outcome = run("backbone", "f114", *given)
    assert (outcome.code, outcome.out) == (2, "")
    assert says in outcome.err


def test_the_first_point_is_one_that_an_analysis_can_use() -> None:
    outcome = run("backbone", "aubeny", "--diameter", "0.27305", "--strength", "1200,1500")
    points = [line for line in outcome.out.splitlines() if line.startswith(" 0.")]
    assert points[1].startswith(" 0.001, ")
    # The model is 332.6 there; the chord is farthest below at x = 0.23^(1/0.77), by x^0.23 - x = 0.4965 of that.
    assert "bound 0.5 %; below z/D = 0.001 10 %\n" in outcome.out
    nearer = run("backbone", "aubeny", *CLAY, "--first", "0.00001").out
    assert " 0.00001, " in nearer
    assert "below z/D" not in run("backbone", "randolph-quiggin", *CLAY).out  # it is not steep at 0
