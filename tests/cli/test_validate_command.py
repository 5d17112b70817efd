"""`mudline validate`: a verdict on each deck."""

from __future__ import annotations

import csv

import pytest

from tests.cli.conftest import Place
from tests.cli.runner import assert_fits, run
from tests.helpers.builders.decks import CLEAN, ILLEGAL, UNUSED

COLUMNS = ["file", "ok", "verdict", "errors", "warnings", "unread", "sections", "curves", "elements"]
PARTLY = CLEAN + "$LOAD CASE\n*BOUNDARY\n TYPE=VESSEL\n 1, Semi\n*GUIDE\n x\n*GUIDE\n y\n"
AS_FAR = "7 of 10 keywords, 1 in part; not read: *GUIDE (2)"


def test_errors_come_before_the_table(place: Place) -> None:
    names = [place(CLEAN, "good.keyxm"), place(ILLEGAL, "bad.keyxm")]
    outcome = run("validate", *names)
    assert outcome.code == 1
    lines = outcome.out.splitlines()
    assert lines[0].startswith("bad.keyxm:20:6: error REF001")
    assert lines[-1] == "1 of 2 decks has errors: 1 error"
    assert [line.split()[0] for line in lines[-4:-2]] == ["no", "1"]


def test_csv(place: Place) -> None:
    names = [place(CLEAN, "good.keyxm"), place(ILLEGAL, 'b"a,d.keyxm')]
    rows = list(csv.reader(run("validate", *names, "--output-format", "csv").out.splitlines()))
    assert rows == [
        [*COLUMNS, "keywords", "read", "partly"],
        ["good.keyxm", "true", "no errors", "0", "0", "0", "1", "1", "2", "7", "7", "0"],
        ['b"a,d.keyxm', "false", "1 error", "1", "0", "0", "1", "1", "2", "7", "7", "0"],
    ]


def test_the_verdict_says_how_many_keywords_were_read(place: Place) -> None:
    name = place(PARTLY)
    found = run("validate", name, "--output-format", "json").json()
    assert_fits(found, "validate")
    (row,) = found["decks"]
    assert row["keywords"] == {"total": 10, "read": 7, "partly": {"BOUNDARY": 1}, "unread": {"GUIDE": 2}}
    assert (row["ok"], row["verdict"], row["unread"]) == (True, "no errors found (7 of 10 keywords read)", 3)
    lines = run("validate", name).out.splitlines()
    assert lines[4].split()[:5] == ["no", "errors", "found", "0", "2"]
    assert lines[-2] == "no errors found in 1 deck"
    assert " 7 of 10 " in lines[4]
    assert lines[-1] == f"Read {AS_FAR}."
    assert run("lint", name).out.splitlines()[-1] == f"Read {AS_FAR}."


@pytest.mark.parametrize(
    ("text", "codes"), [(CLEAN, (0, 0, 0)), (UNUSED, (0, 1, 0)), (PARTLY, (0, 0, 1)), (ILLEGAL, (1, 1, 1))]
)
def test_what_fails(place: Place, text: str, codes: tuple[int, ...]) -> None:
    name = place(text)
    assert tuple(run("validate", name, "--fail-on", word).code for word in ("error", "warning", "unread")) == codes


@pytest.mark.parametrize("text", ["", "C only a comment\n"])
def test_file_without_a_section_has_an_error(place: Place, text: str) -> None:
    outcome = run("validate", place(text), "--output-format", "json")
    assert outcome.code == 1
    assert outcome.json()["decks"][0]["verdict"] == "1 error"


def test_document_that_is_none(place: Place) -> None:
    outcome = run("validate", place("{", "deck.json"))
    assert outcome.code == 1
    assert outcome.out.startswith("deck.json:1:2: error DOC001 ")
    assert outcome.out.splitlines()[-3].split() == ["1", "error", *"00000", "deck.json"]


def test_path_that_is_missing_beats_a_deck_with_errors(place: Place) -> None:
    outcome = run("validate", place(ILLEGAL), "nowhere")
    assert outcome.code == 2
    assert "1 of 1 deck has errors: 1 error, 1 file unreadable" in outcome.out


def test_nothing_to_validate_prints_no_table() -> None:
    assert run("validate", "nowhere").out == ""


def test_a_deck_of_misspelt_keywords_alone_has_errors(place: Place) -> None:
    """Each name of a spreadsheet's export, with separators behind the names, is an error; nothing is read."""
    exported = "".join(f"{line};;\n" if line[0] in "$*" else f"{line}\n" for line in CLEAN.splitlines())
    outcome = run("validate", place(exported), "--output-format", "json")
    (deck,) = outcome.json()["decks"]
    assert outcome.code == 1
    assert (deck["ok"], deck["keywords"]["read"], deck["warnings"]) == (False, 0, 0)
    assert [each["code"] for each in deck["findings"]] == ["SYN010", *["SYN009"] * deck["keywords"]["total"]]
    assert {each["severity"] for each in deck["findings"]} == {"error"}


def test_an_unread_keyword_is_named_with_its_section_where_its_name_is_read_elsewhere(place: Place) -> None:
    name = place("$MODEL\n*TIME\n x\n*GUIDE\n x\n")
    (row,) = run("validate", name, "--output-format", "json").json()["decks"]
    assert row["keywords"]["unread"] == {"TIME in $MODEL": 1, "GUIDE": 1}
