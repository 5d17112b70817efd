"""Files of numbers that decks name: what is wrong in them is told with its line."""

from __future__ import annotations

from pathlib import Path

import pytest

from mudline.checks.engine import lint_bytes
from mudline.checks.registry import rules
from mudline.language.keywords.values import DataFile
from mudline.model.scene.data_files import fault_of, has_uneven_times

SIX = "1, 0, 0, 0, 0, 2\n"
MCS = f"C heave, surge, sway, yaw, roll, pitch\nHEADING=0\n0.1\n{SIX}{SIX}0.2\n{SIX}{SIX}HEADING=90\n0.1\n{SIX}{SIX}"
LINE = f"0 0.1 {SIX.strip()} {SIX}0 0.2 {SIX.strip()} {SIX}".replace(",", "")

CASES = [
    (DataFile.OPERATORS, MCS, ""),
    (DataFile.OPERATORS, LINE, ""),
    (DataFile.OPERATORS, MCS.replace("HEADING=90", "HEADING=190"), "line 9: the heading 190 must lie"),
    (DataFile.OPERATORS, MCS.replace("0.2\n", "0.2, 0.3\n"), "line 6: expected 1 number, found 2"),
    (DataFile.OPERATORS, MCS.replace(SIX, "1, 0, 0\n", 1), "line 4: expected 6 numbers, found 3"),
    (DataFile.OPERATORS, MCS.replace(f"0.2\n{SIX}", "0.2\n"), "line 8: a frequency above it lacks"),
    (DataFile.OPERATORS, MCS.removesuffix(SIX), "line 11: the last frequency lacks"),
    (DataFile.OPERATORS, MCS.replace("HEADING=0\n", "HEADING=N\n"), "line 2: 'N' is not a number"),
    (DataFile.OPERATORS, MCS.replace("0.1\n", "\t0.1\n"), "line 3: a TAB is not allowed"),
    (DataFile.OPERATORS, LINE + "90 0.1 1\n", "line 3: expected 14 numbers, found 3"),
    (DataFile.OPERATORS, LINE + LINE.replace("0 0.1", "90 0.1", 1)[: LINE.index("\n") + 2], "the headings 0 and 90"),
    (DataFile.OPERATORS, LINE + LINE, "the heading 0 has the frequency 0.1 twice"),
    (DataFile.OPERATORS, "C nothing\n", "the file has no operators"),
    (DataFile.MOTIONS, "0 1 2 3 4 5 6\n1, 1, 2, 3, 4, 5, 6\n", ""),
    (DataFile.MOTIONS, "0 1 2 3 4 5\n", "line 1: expected 7 numbers, found 6"),
    (DataFile.MOTIONS, "0 1 2 3 4 5 6\n0 1 2 3 4 5 6\n", "line 2: the time 0 does not come after 0"),
    (DataFile.MOTIONS, "", "the file has no line of numbers"),
    (DataFile.ELEVATIONS, "0.0, 1.0\n0.5, 1.O\n", "line 2: '1.O' is not a number"),
    (DataFile.NUMBERS, "C matrix\nTYPE=CONSTANT\n1 2 3\n", ""),
    (DataFile.NUMBERS, "1 2 x\n", "line 1: 'x' is not a number"),
    (DataFile.NUMBERS, "PK\0\0\x03", "line 1: "),
]


@pytest.mark.parametrize(("contents", "text", "fault"), CASES)
def test_the_first_fault_is_told_with_its_line(tmp_path: Path, contents: DataFile, text: str, fault: str) -> None:
    path = tmp_path / "data.txt"
    path.write_text(text, encoding="utf-8")
    found = fault_of(path, contents)
    assert found.startswith(fault) if fault else found == ""


def test_the_layout_that_a_deck_names(tmp_path: Path) -> None:
    path = tmp_path / "fpso.rao"
    path.write_text(LINE, encoding="utf-8")
    assert fault_of(path, DataFile.OPERATORS, layout="LINE") == ""
    assert (
        fault_of(path, DataFile.OPERATORS, layout="MCS") == "line 1: expected HEADING=angle before the first frequency"
    )


def test_uneven_times(tmp_path: Path) -> None:
    path = tmp_path / "sea.txt"
    for text, uneven in (("0 1\n0.5 2\n1.0 3\n", False), ("0 1\n0.5 2\n1.1 3\n", True), ("0 1\n", False)):
        path.write_text(text, encoding="utf-8")
        assert has_uneven_times(path) is uneven


DECK = """\
$PREPROCESSOR
*PARAMETERS
 Name, "fpso"
$MODEL
*VESSEL,INTEGRATED
 VESSEL=FPSO
 INITIAL POSITION=100.0, 0.0, 0.0
 RAO=%Name%.rao
$LOAD CASE
*WAVE-TIME-HISTORY
 FILE=sea.txt
 0.0, ENSEMBLES=2
"""


def told(text: str, folder: Path | None) -> list[tuple[str, int, str]]:
    found = lint_bytes(text.encode(), "deck.keyxm", rules(), folder=folder)
    return [(one.code, one.line, one.message) for one in found if one.code in ("DAT002", "REF015")]


def test_files_that_a_deck_names(tmp_path: Path) -> None:
    assert [code for code, _, _ in told(DECK, tmp_path)] == ["REF015", "REF015"]
    (tmp_path / "fpso.rao").write_text(MCS.replace("0.2\n", "O.2\n"), encoding="utf-8")
    (tmp_path / "sea.txt").write_text("0 1\n0.5 2\n1.1 3\n", encoding="utf-8")
    assert told(DECK, tmp_path) == [
        ("DAT002", 8, "'fpso.rao' cannot be used: line 6: 'O.2' is not a number"),
        ("DAT002", 11, "'sea.txt' cannot be used: its times are uneven: give a time step in the deck"),
    ]
    assert told(DECK, None) == []
    other = DECK.replace(".rao\n", ".rao, FORMAT=WAMIT\n").replace(" 0.0, ENS", " 0.0, 0.0, 0.0, 0.1, ENS")
    assert told(other, tmp_path) == []


def test_a_file_that_is_not_there_is_an_info_where_nothing_of_its_kind_is(tmp_path: Path) -> None:
    def severities() -> list[str]:
        found = lint_bytes(DECK.encode(), "deck.keyxm", rules(), folder=tmp_path)
        return [one.severity.value for one in found if one.code == "REF015"]

    (tmp_path / "deck.keyxm").touch()
    assert severities() == ["info", "info"]
    (tmp_path / "barge.RAO").write_text(MCS, encoding="utf-8")
    assert severities() == ["warning", "info"]
