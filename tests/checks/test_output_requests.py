"""Names of output variables: a word that is nearly a usual one is told, another one is not."""

from __future__ import annotations

import pytest

from tests.checks.findings import found, messages

FORCE = "$SUMMARY POSTPROCESSING\n*PARA FORCE\n DATA1=1\n DATA2=1\n DATA3={}\n"
STATISTICS = "$DATABASE POSTPROCESSING\n*STATISTICS\n {}\n"


@pytest.mark.parametrize("name", ["EFFECTIVE TENSON", "Efective Tension", "LOCAL Y BENDNG MOMENT", "TORQE"])
def test_a_misspelt_variable(name: str) -> None:
    assert found(FORCE.format(name), "REF021") == [("REF021", 5, 8)]
    assert found(STATISTICS.format(f"{name}, SET=ALL"), "REF021") == [("REF021", 3, 2)]


def test_the_message_names_the_word_that_is_meant() -> None:
    (message,) = messages(FORCE.format("EFFECTIVE TENSON"), "REF021")
    assert "'TENSON' is no usual word (did you mean TENSION?)" in message


@pytest.mark.parametrize(
    "name", ["Effective Tension", "AXIAL FORCES", "LOCAL SHEAR-Y", "TEMPERATURE", "VON MISES STRESSES", "SET=TENSON"]
)
def test_other_words_are_no_fault(name: str) -> None:
    assert found(STATISTICS.format(name), "REF021") == []
