"""Names of sections and keywords that are not known, and what they were to be."""

from __future__ import annotations

import pytest

from mudline.language.diagnostics import Severity
from mudline.language.keywords.catalogue import meant_section, suggest_keyword
from tests.helpers.builders.scenes import deck_of

TABLE = "$MODEL\n*OCEAN\n 350.0, 1025.0, 9.81\n"


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("OCAEN", "OCEAN"),
        ("SEABED PROPERTY", "SEABED PROPERTIES"),
        ("GEOMETRIC SET DATA", ""),
        ("NODE (6 NODES)", "NODE"),
        ("ELEMENT,PIPE", "ELEMENT"),
        ("ELEMENT SETS OF KP 3", "ELEMENT SETS"),
        ("CURRENT PROFILE", "CURRENT"),
        ("NODES", "NODE"),
        ("NODELIST", ""),
        ("SOMETHING ELSE", ""),
        ("", ""),
    ],
)
def test_the_keyword_that_was_meant(written: str, meant: str) -> None:
    assert suggest_keyword(written) == meant


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("MODLE", "MODEL"),
        ("MODEL ---- KP 3 ----", "MODEL"),
        ("LOAD CASE 2", "LOAD CASE"),
        ("DATABASE POSTPROC", ""),
        ("DATABASE POSTPROCESS", "DATABASE POSTPROCESSING"),
        ("MODES POSTPROCESSING TWO", "MODES POSTPROCESSING"),
        ("OTHER", ""),
    ],
)
def test_the_section_that_was_meant(written: str, meant: str) -> None:
    assert meant_section(written) == meant


def test_words_behind_a_name_are_told_and_can_be_removed() -> None:
    deck = deck_of(f"{TABLE}*NODE  (6 nodes)\n 1, 0.0, 0.0\n")
    (found,) = [problem for problem in deck.problems if problem.code.code == "SYN009"]
    assert found.weight is Severity.WARNING
    assert "(did you mean NODE, with nothing after the name?)" in found.message
    assert found.repair is not None
    assert [text for _, text in found.repair.edits] == ["*NODE"]


@pytest.mark.parametrize(
    ("lines", "told", "severity"),
    [
        ("$LOAD CASE\n*TIMES\n STEP=FIXED\n 0.0, 60.0, 0.1\n", " (did you mean TIME?)", Severity.WARNING),
        ("$LOAD CASE\n*TIME SPLITTING\n TYPE=NEWMARK, BETA=0.25\n", "", Severity.INFO),
        ("$CODE CHECKING\n*MODE\n 1, 0.0, 0.0\n", "", Severity.INFO),
        ("$MODEL\n*LABLE\n TYPE=NODE\n 1, LABEL=Top\n", " (did you mean LABEL?)", Severity.WARNING),
        ("$MODEL\n*CABEL\n 1, 1, 2, 250.0\n", " (did you mean CABLE?)", Severity.WARNING),
        (
            "$MODEL\n*NODE SPRINGS\n 1, two, 3\n 2, 1, 4.0\n 3, 1, 4.0\n",
            " (did you mean NODE SPRING?)",
            Severity.WARNING,
        ),
        (
            "$LOAD CASE\n*BOUNDRY\n TYPE=VESSEL\n VESSEL=Semi\n 1, 1\n 2, 1\n 3, 1\n",
            " (did you mean BOUNDARY?)",
            Severity.WARNING,
        ),
        ("$LOAD CASE\n*TEMPERATURES\n 4.0\n", " (did you mean TEMPERATURE?)", Severity.INFO),
        ("$MODEL\n*NODES\n", " (did you mean NODE?)", Severity.WARNING),
    ],
)
def test_a_keyword_is_meant_whose_lines_these_may_be(lines: str, told: str, severity: Severity) -> None:
    (found,) = deck_of(lines).problems
    keyword = lines.splitlines()[1]
    assert found.message == f"keyword {keyword} is not known{told}: it is passed through unchanged"
    assert found.weight is severity
    assert (found.repair is not None) == (severity is Severity.WARNING)


@pytest.mark.parametrize("number", ["85 000.0", "1 250", "-2'500.5", "1_000_000"])
def test_groups_of_digits_are_no_name_of_a_curve(number: str) -> None:
    text = f"{TABLE}*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS={number}\n"
    (found,) = deck_of(text).problems
    plain = number.translate({ord(mark): None for mark in " '_"})
    assert found.code.code == "SYN002"
    assert f"write {plain} for STIFFNESS=" in found.message


@pytest.mark.parametrize("name", ["Clay 100", "85 00", "5 to 6", "1 2345"])
def test_other_names_stay_names(name: str) -> None:
    assert deck_of(f"{TABLE}*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS={name}\n").problems == []
