"""A static deck and a dynamic one that continues it, from the command line."""

from __future__ import annotations

from tests.cli.conftest import Place
from tests.cli.runner import run
from tests.helpers.builders.decks import ILLEGAL

DYNAMIC = "$LOAD CASE\n*RESTART\n LAST=static\n$MODEL\n*ELEMENT SETS\n SET=First\n SUBSET=Pipe\n"


def test_errors_of_the_static_deck_are_told_with_their_file(place: Place) -> None:
    place(ILLEGAL, "static.keyxm")
    name = place(DYNAMIC, "dynamic.keyxm")
    assert run("validate", name).code == 0
    assert run("lint", name).code == 0
    found = run("evaluate", name)
    assert found.code == 1
    assert "static.keyxm:20:6: error: REF001" in found.err
    assert "dynamic.keyxm:" not in found.err
    shown = run("show", name)
    assert (shown.code, shown.err) == (1, "mudline: static.keyxm has 1 error: see mudline lint\n")
