"""`mudline expand`: looking first, writing, what stands in the way."""

from __future__ import annotations

from pathlib import Path

from tests.cli.conftest import Place
from tests.cli.runner import assert_fits, run
from tests.helpers.builders.decks import CLEAN

STUDY = f"""\
$PREPROCESSOR
*PARAMETERS
 Depth, 100.0
 Side, Mean
*VARIATION
 NAME=Depths
 PARA=Depth, GEN=50, 100, 50
 NAME=Sides
 PARA=Side, VALUE=Near, Far
*COMBINATIONS
 DESCRIPTION=all, SUBDIRECTORY=%Side%, FILENAME=at %Depth%
{CLEAN}"""

FILES = ["Far/at 100.keyxm", "Far/at 50.keyxm", "Near/at 100.keyxm", "Near/at 50.keyxm", "manifest.json"]


def files(folder: Path) -> list[str]:
    return sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file())


def test_the_list_is_printed_as_it_is_written(place: Place, folder: Path) -> None:
    name = place(STUDY)
    dry = run("expand", name, "--dry-run", "--output-format", "json")
    done = run("expand", name, "-q", "-o", "out", "--output-format", "json")
    assert done.err == ""
    assert dry.output == done.output == (folder / "out/manifest.json").read_bytes()
    assert_fits(dry.json(), "expand")


def test_files_that_are_there_stay_unless_forced(place: Place, folder: Path) -> None:
    name = place(STUDY)
    place("mine", "out/Far/at 50.keyxm")
    place("mine", "out/manifest.json")
    outcome = run("expand", name, "-o", "out")
    assert outcome.code == 2
    assert outcome.err.splitlines() == [
        "mudline: out/Far/at 50.keyxm: exists already: --force overwrites it",
        "mudline: out/manifest.json: exists already: --force overwrites it",
        "mudline: nothing is written",
    ]
    assert files(folder / "out") == ["Far/at 50.keyxm", "manifest.json"]
    dry = run("expand", name, "-o", "out", "--dry-run")
    assert dry.code == 0
    assert dry.err == "".join(f"{line}\n" for line in outcome.err.splitlines()[:2])
    assert run("expand", name, "-o", "out", "--force").code == 0
    assert files(folder / "out") == FILES
    assert (folder / "out/Far/at 50.keyxm").read_bytes() != b"mine"


def test_files_that_the_deck_names_are_not_copied_and_that_is_told(place: Place) -> None:
    lines = '$TITLES\n*PLAN\n FILE=beds/a.txt\n FILE=b.txt\n FILE=../b.txt\n*LINK\n LAST="c d"\n'
    name = place(STUDY + lines)
    place("0, 0\n1, 0\n", "beds/a.txt")
    place("", "c d")
    outcome = run("expand", name, "-o", "out")
    assert outcome.err.splitlines()[:-1] == [
        "mudline: beds/a.txt: this file, which the deck names, is not copied: put it next to the new decks",
        "mudline: c d: this file, which the deck names, is not copied: put it next to the new decks",
    ]
    for side in ("Near", "Far"):
        place("", f"out/{side}/c d")
    assert "c d: the deck" not in run("expand", name, "-o", "out", "--force").err


def test_the_deck_itself_is_never_overwritten(place: Place, folder: Path) -> None:
    name = place(STUDY.partition("*VARIATION")[0] + "*COMBINATIONS\n DESCRIPTION=d, FILENAME=deck\n" + CLEAN)
    before = (folder / name).read_bytes()
    outcome = run("expand", name, "-o", ".", "--force")
    assert outcome.code == 2
    assert "deck.keyxm: this run reads the file, which is not overwritten" in outcome.err
    assert (folder / name).read_bytes() == before


def test_a_folder_where_a_file_is_wanted(place: Place, folder: Path) -> None:
    name = place(STUDY)
    (folder / "out/Far/at 100.keyxm").mkdir(parents=True)
    outcome = run("expand", name, "-o", "out", "--force")
    assert outcome.code == 2
    assert "out/Far/at 100.keyxm: exists already and is not a regular file: it is not overwritten" in outcome.err
    assert files(folder) == ["deck.keyxm"]


def test_standard_input_and_notes() -> None:
    text = STUDY.replace(
        "*VARIATION", "*EXCEL VARIATIONS\n FILENAME=a\n EXCEL=book.xlsx, RANGE=A1:B2\n*VARIATION"
    ).encode()
    outcome = run("expand", "-", "--dry-run", stdin=text, terminal=True)
    assert outcome.code == 0
    assert "*EXCEL VARIATIONS is not expanded" in outcome.err
    assert "Near/at 50.keyx " in outcome.out
    named = run("expand", "-", "--dry-run", "--stdin-filename", "a/b.keyxi", "--output-format", "json", stdin=text)
    assert named.json()["source"] == "b.keyxi"
    assert named.json()["decks"][0]["file"] == "Near/at 50.keyxi"
