"""What `mudline lint` takes from a folder: decks in every form; -v names what it skips."""

from __future__ import annotations

from tests.cli.conftest import Place
from tests.cli.runner import run
from tests.helpers.builders.decks import CLEAN


def test_decks_in_json_and_yaml_are_taken_from_a_folder(place: Place) -> None:
    name = place(CLEAN, "decks/a.keyxm")
    for form in ("json", "yaml"):
        assert run("convert", name, "-o", f"decks/b.{form}").code == 0
    place('{"other": 1}', "decks/c.json")
    place("notes", "decks/d.txt")
    outcome = run("lint", "decks")
    assert (outcome.out, outcome.err) == ("No findings in 3 files.\nAll 21 keywords read.\n", "")
    lines = run("lint", "decks", "-v").err.splitlines()
    skipped = [line.removeprefix("mudline: ").partition(", ")[0] for line in lines if "skipped" in line]
    assert skipped == ["decks/c.json: skipped", "decks/d.txt: skipped"]
    assert any("with the format mudline-deck/" in line for line in lines)
