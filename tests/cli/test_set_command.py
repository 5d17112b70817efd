"""`mudline set`."""

from __future__ import annotations

import errno
import os
from pathlib import Path
from unittest.mock import Mock

import pytest

from tests.cli.conftest import Place
from tests.cli.runner import run
from tests.helpers.builders.decks import BAD_NUMBER, CLEAN

DEEP = CLEAN.replace(" 100.0,", " 150.5,")
EQUATION = CLEAN.replace(" 100.0,", " =[90+10],")
NO_OCEAN = "$MODEL\n*UNITS\n UNITS=METRIC\n"


@pytest.fixture
def decks(place: Place) -> None:
    place(CLEAN, "in/a.keyxm")
    place(DEEP, "in/b.keyxm")
    place(NO_OCEAN, "in/c.keyxm")


def text(name: str) -> str:
    return Path(name).read_text(encoding="utf-8")


@pytest.mark.usefixtures("decks")
def test_many_decks() -> None:
    ran = run("set", "OCEAN.depth=200.0", "in")
    assert (ran.code, ran.out, ran.err) == (0, "", "3 decks: 2 changed, 1 without it\n")
    assert text("in/a.keyxm") == CLEAN.replace(" 100.0,", " 200.0,")
    assert text("in/b.keyxm") == CLEAN.replace(" 100.0,", " 200.0,")
    assert text("in/c.keyxm") == NO_OCEAN
    assert run("set", "-q", "OCEAN.depth=200.0", "in").err == ""


@pytest.mark.usefixtures("decks")
def test_a_condition_selects_decks() -> None:
    ran = run("set", "-v", "OCEAN.depth=200.0", "in", "--where", "OCEAN.depth > 120")
    assert ran.code == 0
    assert ran.err == "mudline: in/b.keyxm:3: 150.5 -> 200.0\n3 decks: 1 changed, 2 not selected\n"
    assert text("in/a.keyxm") == CLEAN
    assert run("set", "OCEAN.depth=200.0", "in", "--where", "OCEAN.depth > 1200").code == 0


@pytest.mark.usefixtures("decks")
@pytest.mark.parametrize(("bad", "why"), [(EQUATION, "is given by an equation"), (CLEAN * 2, "is ambiguous")])
def test_one_refused_deck_keeps_all_from_being_written(place: Place, bad: str, why: str) -> None:
    place(bad, "in/z.keyxm")
    ran = run("set", "OCEAN.depth=200.0", "in")
    assert (ran.code, ran.out) == (1, "")
    assert ran.err.startswith("mudline: in/z.keyxm")
    assert why in ran.err
    assert "nothing was written: 2 decks would have changed" in ran.err
    assert ran.err.endswith("\n4 decks: 2 not written, 1 without it, 1 refused\n")
    assert (text("in/a.keyxm"), text("in/b.keyxm"), text("in/z.keyxm")) == (CLEAN, DEEP, bad)


def test_a_new_error_is_shown(place: Place) -> None:
    ran = run("set", "GEOMETRIC SETS.Do=0.4", place())
    assert ran.code == 1
    assert "mudline: deck.keyxm:17: the deck would have a new error\ndeck.keyxm:17:" in ran.err
    assert "error: GEO001" in ran.err


STORM = "$LOAD CASE\n*CURRENT\n TYPE=UNIFORM\n 1.0, 0.0\n"
DENSITY = "density of sea water is 1026.0 slug/ft3, expected 1.75 to 4.85 slug/ft3"


def test_a_value_that_is_unusual_in_the_units_of_the_deck_is_refused(place: Place) -> None:
    imperial = CLEAN.replace(" 100.0, 1025.0, 9.81", " 300.0, 1.99, 32.2")
    for name, written in (("deck.keyxi", imperial), ("deck.keyxm", CLEAN)):
        ran = run("set", "OCEAN.density=1026", place(written, name))
        assert ran.code == (1 if name == "deck.keyxi" else 0)
    assert text("deck.keyxi") == imperial
    assert text("deck.keyxm") == CLEAN.replace("1025.0", "1026")
    ran = run("set", "OCEAN.density=1026", "deck.keyxi")
    refusal = "mudline: deck.keyxi:3: OCEAN.density would be unusual in the units of the deck: correct the value"
    assert ran.err.startswith(refusal)
    assert f"\ndeck.keyxi:3:9: error: UNT004 {DENSITY}" in ran.err
    forced = run("set", "OCEAN.density=1026", "deck.keyxi", "--force")
    assert forced.code == 0
    assert f"deck.keyxi:3:9: warning: UNT004 {DENSITY}" in forced.err
    assert "\n 300.0, 1026, 32.2\n" in text("deck.keyxi")
    assert run("set", "OCEAN.density=1027", "deck.keyxi").code == 1  # as unusual as before


def test_a_remarkable_value_and_new_warnings_are_shown(place: Place) -> None:
    ran = run("set", "CURRENT.uniform.velocity=3.5", place(CLEAN + STORM))
    assert ran.code == 0
    assert "info: UNT008" in ran.err
    ran = run("set", "SEABED STIFFNESS[name=Clay][ratio=0.1].force=4000", "deck.keyxm")
    assert ran.code == 0
    assert "warning: CRV012" in ran.err
    assert "UNT008" not in ran.err  # it was there before
    assert run("set", "-q", "SEABED STIFFNESS[name=Clay][ratio=0.1].force=4100", "deck.keyxm").err == ""


def test_faults_elsewhere_in_a_deck_do_not_matter(place: Place) -> None:
    assert run("set", "OCEAN.depth=200.0", place(BAD_NUMBER)).code == 0
    assert text("deck.keyxm") == BAD_NUMBER.replace(" 100.0,", " 200.0,")


def test_standard_input_is_printed() -> None:
    ran = run("set", "OCEAN.depth=5", "-", stdin=CLEAN.encode())
    assert (ran.code, ran.out) == (0, CLEAN.replace(" 100.0,", " 5,"))
    ran = run("set", "TIME.step=5", "-", "--where", "OCEAN.depth < 1", stdin=CLEAN.encode())
    assert (ran.code, ran.out) == (0, CLEAN)


@pytest.mark.usefixtures("decks")
def test_a_path_that_cannot_be_read_keeps_all_from_being_written() -> None:
    assert run("set", "OCEAN.depth=1", "in", "missing.keyxm").code == 2
    assert text("in/a.keyxm") == CLEAN


@pytest.mark.usefixtures("decks")
@pytest.mark.skipif(os.name != "posix" or os.geteuid() == 0, reason="this user may write everywhere")
def test_a_file_that_may_not_be_written_keeps_all_from_being_written() -> None:
    Path("in/b.keyxm").chmod(0o444)
    ran = run("set", "OCEAN.depth=1", "in")
    assert ran.code == 2
    assert text("in/a.keyxm") == CLEAN


@pytest.mark.usefixtures("decks")
def test_what_cannot_be_written_is_not_counted_as_changed(monkeypatch: pytest.MonkeyPatch) -> None:
    full = OSError(errno.ENOSPC, "No space left on device")
    monkeypatch.setattr("mudline.cli.inputs.write_atomically", Mock(side_effect=full))
    ran = run("set", "OCEAN.depth=200.0", "in")
    assert ran.code == 2
    assert "mudline: in/a.keyxm: cannot be written: no space left on device\n" in ran.err
    assert ran.err.endswith("3 decks: 2 not written, 1 without it\n")
    assert text("in/a.keyxm") == CLEAN
