"""`mudline validate`: a verdict on each deck."""

from __future__ import annotations

import pytest

from tests.cli.conftest import Place
from tests.cli.runner import assert_fits, run
from tests.helpers.builders.decks import CLEAN, ILLEGAL, UNUSED

COLUMNS = ["file", "sections", "keywords", "curves", "elements", "errors", "warnings", "verdict"]
READ = {"total": 7, "read": 7, "partly": {}, "unread": {}}
PARTLY = CLEAN + "$LOAD CASE\n*BOUNDARY\n TYPE=VESSEL\n 1, Semi\n*GUIDE\n x\n*GUIDE\n y\n"
AS_FAR = "7 of 10 keywords, 1 in part; not read: *GUIDE (2)"


def test_legal_deck(place: Place) -> None:
    outcome = run("validate", place())
    assert (outcome.code, outcome.err) == (0, "")
    assert outcome.out.splitlines() == [
        "Decks",
        "                 warn-   sec-  keywords           ele-",
        "verdict  errors   ings  tions      read  curves  ments  file",
        "──────────────────────────────────────────────────────────────────",
        "legal         0      0      1         7       1      2  deck.keyxm",
        "",
        "1 of 1 deck legal",
    ]


def test_errors_come_before_the_table(place: Place) -> None:
    names = [place(CLEAN, "good.keyxm"), place(ILLEGAL, "bad.keyxm")]
    outcome = run("validate", *names)
    assert outcome.code == 1
    lines = outcome.out.splitlines()
    assert lines[0].startswith("bad.keyxm:20:6: error REF001")
    assert lines[-1] == "1 of 2 decks legal: 1 illegal, 1 error"
    assert [line.split()[0] for line in lines[-4:-2]] == ["legal", "illegal"]


def test_json(place: Place) -> None:
    names = [place(CLEAN, "good.keyxm"), place(ILLEGAL, "bad.keyxm")]
    outcome = run("validate", *names, "--output-format", "json")
    found = outcome.json()
    assert_fits(found, "validate")
    assert_fits(found["decks"][1]["findings"], "lint")
    assert outcome.code == 1
    assert found["total"] == {
        "decks": 2,
        "legal": 1,
        "illegal": 1,
        "empty": 0,
        "errors": 1,
        "warnings": 0,
        "unreadable": 0,
        "keywords": {"total": 14, "read": 14, "partly": {}, "unread": {}},
    }
    good, bad = found["decks"]
    assert good == dict(zip(COLUMNS, ["good.keyxm", 1, READ, 1, 2, 0, 0, "legal"], strict=True)) | {"findings": []}
    assert [each["code"] for each in bad["findings"]] == ["REF001"]
    assert (bad["errors"], bad["verdict"]) == (1, "illegal")


def test_a_deck_is_legal_as_far_as_it_was_read(place: Place) -> None:
    name = place(PARTLY)
    found = run("validate", name, "--output-format", "json").json()
    assert_fits(found, "validate")
    (row,) = found["decks"]
    assert row["keywords"] == {"total": 10, "read": 7, "partly": {"BOUNDARY": 1}, "unread": {"GUIDE": 2}}
    assert row["verdict"] == f"legal as far as read: {AS_FAR}"
    lines = run("validate", name).out.splitlines()
    assert lines[4].split()[:7] == ["as", "far", "as", "read", "0", "0", "2"]
    assert lines[-2] == "1 of 1 deck legal as far as read"
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
def test_file_without_a_section_is_no_deck(place: Place, text: str) -> None:
    outcome = run("validate", place(text), "--output-format", "json")
    assert outcome.code == 1
    assert outcome.json()["decks"][0]["verdict"] == "empty"


def test_path_that_is_missing_beats_a_deck_that_is_illegal(place: Place) -> None:
    outcome = run("validate", place(ILLEGAL), "nowhere")
    assert outcome.code == 2
    assert "illegal" in outcome.out


def test_a_deck_of_misspelt_keywords_alone_is_illegal(place: Place) -> None:
    """As a spreadsheet saves it, with separators behind the names: nothing of it was read, so nothing is legal."""
    exported = "".join(f"{line};;\n" if line[0] in "$*" else f"{line}\n" for line in CLEAN.splitlines())
    outcome = run("validate", place(exported), "--output-format", "json")
    (deck,) = outcome.json()["decks"]
    assert outcome.code == 1
    assert (deck["verdict"], deck["keywords"]["read"], deck["warnings"]) == ("illegal", 0, 0)
    assert [each["code"] for each in deck["findings"]] == ["SYN010", *["SYN009"] * deck["keywords"]["total"]]
    assert {each["severity"] for each in deck["findings"]} == {"error"}


def test_keywords_without_a_near_name_leave_a_deck_legal_as_far_as_read(place: Place) -> None:
    outcome = run("validate", place("$MODEL\n*GUIDE\n x\n"), "--output-format", "json")
    assert (outcome.code, outcome.json()["decks"][0]["verdict"]) == (
        0,
        "legal as far as read: 0 of 1 keyword; not read: *GUIDE",
    )
