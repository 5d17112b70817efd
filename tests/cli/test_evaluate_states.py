"""`mudline evaluate` with suction, friction, rigid beds and places without a bed: states and forces in every form."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from tests.cli.conftest import Place
from tests.cli.runner import SAMPLES, assert_fits, run
from tests.helpers.builders.decks import CLEAN

UPLIFT = CLEAN + "*SEABED SUCTION\n SET=Pipe\n COHESION=4000.0\n"
SLIDING = CLEAN + "*SEABED FRICTION\n SET=Pipe\n COEFFICIENTS=0.5, 0.5\n STIFFNESS=1.0E5\n"
BOTH = SLIDING + UPLIFT.removeprefix(CLEAN)
RIGID = CLEAN.partition("*SEABED PROPERTIES")[0] + "*SEABED PROPERTIES\n TYPE=RIGID\n SET=ALL\n"
BOUNDED = CLEAN + "*SEABED PLANES\n PLANE=Shelf\n POINT=0.0, 0.0, 0.0\n SLOPE=0.0\n BOUNDS=-5.0, 15.0, -5.0, 5.0\n"

PULL = """\
time,node,x,y,z
0,1,-0.1,0.0,0.0
0,2,-0.1,10.0,0.0
0,3,0.3,20.0,0.0
1,1,-0.1,0.0,0.1
1,2,-0.1,10.0,0.1
1,3,0.3,20.0,0.1
2,1,0.02,0.0,0.1
2,2,0.02,10.0,0.1
2,3,0.3,20.0,0.1
3,1,0.02,0.0,0.1
3,2,0.02,10.0,0.1
3,3,0.3,20.0,0.1
4,1,0.9,0.0,0.1
4,2,0.9,10.0,0.1
4,3,0.9,20.0,0.1
"""


@pytest.fixture
def pulled(place: Place) -> tuple[str, str, str]:
    return place(BOTH), "--positions", place(PULL, "pull.csv")


def test_json_names_the_states(pulled: tuple[str, ...]) -> None:
    outcome = run("evaluate", *pulled, "--output-format", "json")
    assert outcome.code == 0
    found = outcome.json()
    assert_fits(found, "evaluate")
    first = [step["elements"][0] for step in found["steps"]]
    assert [row["state"] for row in first] == ["compression", "compression", "suction", "hold", "broken"]
    assert first[2]["force"] < 0.0
    assert first[3]["force"] == 0.0
    nodes = [step["nodes"][0] for step in found["steps"]]
    assert [(row["axial_state"], row["lateral_state"]) for row in nodes] == [
        ("stick", "stick"),
        ("stick", "slip"),
        ("open", "open"),
        ("open", "open"),
        ("open", "open"),
    ]
    assert abs(nodes[1]["lateral_force"]) == pytest.approx(0.5 * nodes[1]["normal_force"])
    assert nodes[1]["axial_force"] == pytest.approx(0.0, abs=1e-9)
    assert found["steps"][2]["nodes"][0]["normal_force"] < 0.0


def at_zero(steps: int) -> NDArray[np.float64]:
    """The line at X = 0 in each step."""
    return np.tile([[0.0, 0.0, 0.0], [0.0, 10.0, 0.0], [0.0, 20.0, 0.0]], (steps, 1, 1))


def test_velocities_of_the_file_are_used(place: Place) -> None:
    lines = PULL.splitlines()
    still = [lines[0] + ",vx,vy,vz", *(f"{line},0,0,0" for line in lines[1:])]
    moving = [lines[0] + ",vx,vy,vz", *(f"{line},0.5,0,0" for line in lines[1:])]
    states = []
    for name, text in (("still.csv", still), ("moving.csv", moving)):
        options = ("--positions", place("\n".join(text) + "\n", name), "--output-format", "json")
        found = run("evaluate", place(UPLIFT), *options).json()
        states.append([step["elements"][0]["state"] for step in found["steps"]])
    assert states[0] == ["compression", "compression", "hold", "hold", "hold"]
    assert states[1][2:4] == ["suction", "suction"]


def test_suction_needs_a_clock(place: Place, folder: Path) -> None:
    places = at_zero(3)
    np.save(folder / "p.npy", places)
    name = place(UPLIFT)
    outcome = run("evaluate", name, "--positions", "p.npy")
    assert (outcome.code, outcome.out) == (1, "")
    assert "suction needs velocities, or the times of the steps: the positions have neither" in outcome.err
    assert run("evaluate", name, "--positions", "p.npy", "--time-step", "0.5").code == 0
    np.savez(folder / "p.npz", positions=places, time=[0.0, 2.0, 1.0])
    outcome = run("evaluate", name, "--positions", "p.npz")
    assert (outcome.code, outcome.out) == (1, "")
    assert "ascending times: 1.0 follows 2.0" in outcome.err


@pytest.mark.parametrize("times", [[0.0, 2.0, 1.0], [0.0, 1.0, 1.0]], ids=["fall", "repeat"])
@pytest.mark.parametrize("law", ["suction", "friction", "none"])
def test_times_of_an_archive_rise_for_laws_with_history(
    place: Place, folder: Path, law: str, times: list[float]
) -> None:
    places = at_zero(3)
    np.savez(folder / "p.npz", positions=places, time=times, velocities=0 * places)
    outcome = run(
        "evaluate", place({"suction": UPLIFT, "friction": SLIDING, "none": CLEAN}[law]), "--positions", "p.npz"
    )
    if law == "none":
        assert (outcome.code, outcome.err.count("rise")) == (0, 0)
    else:
        assert (outcome.code, outcome.out) == (1, "")
        assert outcome.err.endswith(f"ascending times: {times[2]} follows {times[1]}\n")


def test_time_step(place: Place, folder: Path) -> None:
    np.save(folder / "p.npy", at_zero(3))
    np.save(folder / "one.npy", at_zero(1)[0])
    options = (place(), "--positions", "p.npy", "--time-step")
    found = run("evaluate", *options, "0.25", "--output-format", "json").json()
    assert [step["time"] for step in found["steps"]] == [0.0, 0.25, 0.5]
    for given in ("0", "-1", "nan", "inf"):
        outcome = run("evaluate", *options, given)
        assert (outcome.code, outcome.out) == (2, "")
        assert "it must be greater than 0" in outcome.err
    assert "one.npy is one state" in run("evaluate", place(), "--positions", "one.npy", "--time-step", "1").err
    timed = run("evaluate", place(), "--positions", place(PULL, "p.csv"), "--time-step", "1")
    assert (timed.code, "p.csv has times of its own" in timed.err) == (2, True)


def test_text_tells_states(place: Place, pulled: tuple[str, ...]) -> None:
    text = run("evaluate", *pulled).out
    assert "suction     nodes" in text
    assert [line.split()[-2:] for line in text.splitlines()[5:10]] == [
        ["0", "0"],
        ["0", "2"],
        ["1", "0"],
        ["1", "0"],
        ["0", "0"],
    ]
    rows = run("evaluate", *pulled, "--output-format", "json").json()["steps"][2]["elements"]
    pull = next(line.split() for line in text.splitlines() if line.startswith("suction force of an element"))
    assert [float(pull[5]), *pull[6:]] == [pytest.approx(-rows[0]["force"], rel=1e-5), "N/m", "2", "1"]
    single = run("evaluate", place(BOTH), "--table", "nodes").out
    assert "axial friction of nodes    stick" in single
    assert "suction of elements        compression" in single
    assert single.splitlines()[-2].split()[-2:] == ["stick", "stick"]
    elements = run("evaluate", place(BOTH)).out.splitlines()
    assert elements[-2].split()[-1] == "compression"


def test_rigid_bed_restrains_nodes(place: Place) -> None:
    found = run("evaluate", place(RIGID), "--output-format", "json").json()
    assert_fits(found, "evaluate")
    assert found["restrained"] == [1, 2]
    assert {row["law"] for row in found["elements"]} == {"rigid"}
    series = run("evaluate", place(RIGID), "--positions", place(PULL, "p.csv"), "--output-format", "json").json()
    assert_fits(series, "evaluate")
    assert [step["restrained"] for step in series["steps"]] == [[1, 2], [1, 2], [], [], []]
    text = run("evaluate", place(RIGID)).out
    assert "rigid seabed  restrained nodes      2" in text
    assert text.splitlines()[5].split()[:4] == ["rigid", "ALL", "2", "1"]
    assert len(text.splitlines()[5].split()) == 5, "no reaction is told, as none is known"
    nodes = run("evaluate", place(RIGID), "--table", "nodes").out
    assert nodes.splitlines()[-2].split()[:3] == ["1", "to", "2"]


def test_no_seabed_is_no_value(place: Place, folder: Path) -> None:
    name = place(BOUNDED)
    outcome = run("evaluate", name, "--output-format", "json")
    assert outcome.code == 0
    found = outcome.json()
    assert_fits(found, "evaluate")
    assert found["nodes"][2]["gap"] is None
    assert found["elements"][1]["depth"] is None
    assert found["elements"][0]["depth"] == 0.1
    rows = list(csv.DictReader(run("evaluate", name, "--output-format", "csv", "--table", "nodes").out.splitlines()))
    assert [row["gap"] for row in rows] == ["-0.1", "-0.1", ""]
    assert run("evaluate", name, "-o", "out.npz", "-q").code == 0
    with np.load(folder / "out.npz") as archive:
        assert np.isnan(archive["gap"][2])
    assert "none" not in run("evaluate", name).out


# ------------------------- mudline evaluate says what is doubtful in its results, and validate counts what a deck lacks


MISSPELT = CLEAN.replace("*SEABED PROPERTIES", "*SEABED PROPERTEIS")
WARNING = (
    "mudline: warning: deck.keyxm:18: SYN009 keyword *SEABED PROPERTEIS is not known (did you mean *SEABED "
    "PROPERTIES?), and element 1 is in contact without a seabed law: correct the name\n"
)
OWN = "mudline: the positions are the deck's own coordinates, not a solved shape\n"


@pytest.mark.parametrize(("options", "code"), [((), 0), (("--fail-on", "error"), 0), (("--fail-on", "warning"), 1)])
def test_warnings_decide_the_exit_code_when_asked_to(place: Place, options: tuple[str, ...], code: int) -> None:
    assert run("evaluate", place(MISSPELT), *options).code == code
    assert run("evaluate", SAMPLES / "flowline-gen.keyxm", *options).code == 0


def test_results_are_written_before_the_exit_code(place: Place, folder: Path) -> None:
    outcome = run("evaluate", place(MISSPELT), "-o", "out.npz", "--fail-on", "warning")
    assert (outcome.code, outcome.err) == (1, f"{WARNING}{OWN}mudline: deck.keyxm -> out.npz\n")
    with np.load(folder / "out.npz", allow_pickle=False) as archive:
        assert archive["contact"].tolist() == [True, False]


def test_json_has_the_warnings(place: Place) -> None:
    found = run("evaluate", place(MISSPELT), "--output-format", "json").json()
    assert_fits(found, "evaluate")
    assert found["positions"] == "deck"
    (warning,) = found["warnings"]
    assert (warning["code"], warning["line"], warning["elements"], warning["first"]) == ("SYN009", 18, 1, 1)
    assert warning["message"] in WARNING


# ------------------------------------------------------------------------------------------------------------ validate


def test_deck_without_a_seabed_has_a_warning(place: Place) -> None:
    names = [place(MISSPELT, "misspelt.keyxm"), place(CLEAN, "clean.keyxm")]
    outcome = run("validate", *names, "--output-format", "json")
    assert outcome.code == 0
    assert_fits(outcome.json(), "validate")
    decks = outcome.json()["decks"]
    rows = [(row["verdict"], row["warnings"], [one["code"] for one in row["findings"]]) for row in decks]
    assert rows == [("no errors found (6 of 7 keywords read)", 1, ["SYN009"]), ("no errors", 0, [])]
    assert outcome.json()["total"]["warnings"] == 1


def test_what_evaluating_adds_is_counted_once(place: Place) -> None:
    slope = CLEAN.partition("*SEABED PROPERTIES")[0] + "*SEABED PROFILE\n TYPE=SLOPING\n SLOPE=2.0\n"
    outcome = run("validate", place(slope), "-v")
    assert "warning SBD006" in outcome.out
    assert "no errors found in 1 deck: 1 warning" in outcome.out
    lacking = CLEAN.replace(" STIFFNESS=Clay\n", " FRICTION=0.3, 0.5\n")
    shown = run("validate", place(lacking), "-v").out
    assert shown.count("SBD006") == 1


def test_suppressed_warning_is_not_counted(place: Place) -> None:
    text = CLEAN.replace(" STIFFNESS=Clay\n", " STIFFNESS=5000.0\n").replace(
        " CURVE=", "C mudline: ignore REF003\n CURVE="
    )
    assert run("validate", place(text), "--output-format", "json").json()["decks"][0]["warnings"] == 0
