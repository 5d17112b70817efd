"""`mudline evaluate` says what is doubtful in its results, and `validate` counts what a deck lacks."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.builders.decks import CLEAN
from tests.cli.conftest import Place
from tests.cli.runner import SAMPLES, assert_fits, run

MISSPELT = CLEAN.replace("*SEABED PROPERTIES", "*SEABED PROPERTEIS")
WARNING = (
    "mudline: warning: deck.keyxm:18: SYN009 keyword *SEABED PROPERTEIS is not known (did you mean *SEABED "
    "PROPERTIES?), and element 1 is in contact without a seabed law: correct the name\n"
)
OWN = "mudline: the positions are the deck's own coordinates, not a solved shape\n"
ABOVE = "time,node,x,y,z\n" + "".join(f"{step},{node},{5 - step},{node},0\n" for step in (0, 1) for node in (1, 2, 3))


def test_misspelt_keyword_is_said_in_the_place_of_zeros(place: Place) -> None:
    outcome = run("evaluate", place(MISSPELT))
    assert (outcome.code, outcome.err) == (0, WARNING + OWN)
    message = "Contact of deck.keyxm (metric units): none of 2 elements has a seabed law, so there are no forces\n"
    assert outcome.out == message
    everything = run("evaluate", place(MISSPELT), "-v").out
    assert everything.startswith(message)
    assert "none              2        1      0.1         0" in everything


def test_steps_without_a_law_are_no_table_of_zeros(place: Place) -> None:
    outcome = run("evaluate", place(MISSPELT), "--positions", place(ABOVE.replace(",5", ",-5"), "below.csv"))
    assert "none of 2 elements has a seabed law" in outcome.out
    assert len(outcome.out.splitlines()) == 1


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


def test_json_of_time_steps(place: Place) -> None:
    options = ("--positions", place(ABOVE, "above.csv"), "--output-format", "json")
    found = run("evaluate", place(), *options).json()
    assert_fits(found, "evaluate")
    assert found["positions"] == "file"
    assert [(each["code"], each["elements"], each["first"]) for each in found["warnings"]] == [("GEO005", 2, 1)]
    assert "the smallest clearance is 4 m, of node 1 at time 1" in found["warnings"][0]["message"]


def test_refused_deck_has_no_warnings(place: Place) -> None:
    outcome = run("evaluate", place(CLEAN.replace("*SEABED STIFFNESS", "*SEABED STIFNES")))
    assert outcome.code == 1
    assert "SYN009" in outcome.err
    assert "warning: deck" not in outcome.err


def test_plot_has_a_line_under_its_title(place: Place, folder: Path) -> None:
    run("evaluate", place(MISSPELT), "--plot", "p.svg")
    run("evaluate", SAMPLES / "flowline-gen.keyxm", "--plot", "q.svg")
    assert "1 warning: 1 element in contact without a seabed law" in (folder / "p.svg").read_text(encoding="utf-8")
    assert "warning" not in (folder / "q.svg").read_text(encoding="utf-8")


# ------------------------------------------------------------------------------------------------------------ validate


def test_deck_without_a_seabed_is_legal_with_a_warning(place: Place) -> None:
    names = [place(MISSPELT, "misspelt.keyxm"), place(CLEAN, "clean.keyxm")]
    outcome = run("validate", *names, "--output-format", "json")
    assert outcome.code == 0
    assert_fits(outcome.json(), "validate")
    rows = [(row["verdict"], row["warnings"], row["findings"]) for row in outcome.json()["decks"]]
    assert rows == [("legal, 1 warning", 1, []), ("legal", 0, [])]
    assert outcome.json()["total"]["warnings"] == 1
    assert run("validate", *names).out.splitlines()[3].startswith("legal, 1 warning       0         1  ")


def test_what_evaluating_adds_is_counted_once(place: Place) -> None:
    slope = CLEAN.partition("*SEABED PROPERTIES")[0] + "*SEABED PROFILE\n TYPE=SLOPING\n SLOPE=2.0\n"
    outcome = run("validate", place(slope), "-v")
    assert "warning SBD006" in outcome.out
    assert "1 of 1 deck legal: 1 warning" in outcome.out
    lacking = CLEAN.replace(" STIFFNESS=Clay\n", " FRICTION=0.3, 0.5\n")
    shown = run("validate", place(lacking), "-v").out
    assert shown.count("SBD006") == 1


def test_suppressed_warning_is_not_counted(place: Place) -> None:
    text = CLEAN.replace(" STIFFNESS=Clay\n", " STIFFNESS=5000.0\n").replace(
        " CURVE=", "C mudline: ignore REF003\n CURVE="
    )
    assert run("validate", place(text), "--output-format", "json").json()["decks"][0]["verdict"] == "legal"
