"""`mudline diff`."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.builders.decks import BAD_NUMBER, CLEAN, LINEAR
from tests.cli.conftest import Place
from tests.cli.runner import assert_fits, run


def test_equal_decks(place: Place) -> None:
    ran = run("diff", place(), place(CLEAN.replace("0.1, 1000.0", "1e-1, 1.0E3"), "b.keyxm"))
    assert (ran.code, ran.out, ran.err) == (0, "no difference\n", "")


def test_a_change_in_text(place: Place) -> None:
    ran = run("diff", place(), place(CLEAN.replace("1000.0", "1200.0"), "b.keyxm"))
    assert ran.code == 1
    assert ran.out == (
        "--- deck.keyxm\n+++ b.keyxm\ncurves\n  ~ Clay/0.1: 1000.0 -> 1200.0  (line -25 +25)\n1 difference\n"
    )


def test_a_change_in_json(place: Place) -> None:
    ran = run("diff", place(), place(LINEAR, "b.keyxm"), "--output-format", "json")
    assert ran.code == 1
    assert_fits(ran.json(), "diff")
    found = [one for one in ran.json()["differences"] if one["group"] == "*SEABED PROPERTIES"]
    assert [(one["before"], one["after"]) for one in found] == [("Clay", 20000.0)]


def test_no_change_in_json(place: Place) -> None:
    ran = run("diff", place(), "deck.keyxm", "--output-format", "json")
    assert_fits(ran.json(), "diff")
    assert (ran.code, ran.json()["differences"]) == (0, [])


def test_one_deck_from_standard_input(place: Place) -> None:
    assert run("diff", place(), "-", "--units", "metric", stdin=CLEAN.encode()).code == 0
    assert run("diff", "-", place(), "--stdin-filename", "x.keyxm", stdin=LINEAR.encode()).code == 1


@pytest.mark.parametrize("words", [("-", "-"), ("deck.keyxm",), ("deck.keyxm", "no"), ("--tolerance", "2", "-", "a")])
def test_wrong_usage(place: Place, words: tuple[str, ...]) -> None:
    place()
    assert run("diff", *words, stdin=b"").code == 2


def test_tolerance_that_is_no_number(place: Place) -> None:
    assert run("diff", place(), "deck.keyxm", "--tolerance", "nan").code == 2


def test_a_deck_that_cannot_be_read(place: Place) -> None:
    ran = run("diff", place(), place(BAD_NUMBER, "b.keyxm"))
    assert (ran.code, ran.out) == (1, "")
    assert ran.err.startswith("b.keyxm:6:11: error: SYN002")


def test_many_differences_are_counted(place: Place) -> None:
    nodes = "".join(f" {number}, 0, {number}\n" for number in range(100, 130))
    more = place(CLEAN.replace("*ELEMENT\n", f"*NODE\n{nodes}*ELEMENT\n"), "b.keyxm")
    assert "nodes\n  + 100-129: 30 nodes\n30 differences\n" in run("diff", place(), more).out
    assert "nodes\n  - 100-129: 30 nodes\n" in run("diff", more, "deck.keyxm").out
    assert run("diff", "-v", "deck.keyxm", more).out.count("  + ") == 30
    moved = place(Path(more).read_text(encoding="utf-8").replace(", 0, ", ", 1, "), "c.keyxm")
    assert "  and 10 more (-v shows all)\n" in run("diff", more, moved).out


def test_text_of_a_deck_does_not_act_on_a_terminal(place: Place) -> None:
    bad = CLEAN + "*HYDRODYNAMIC SETS\n a\x1b[31m[red]b\n"
    ran = run("diff", place(), place(bad, "b.keyxm"), "--color", "always", terminal=True)
    assert "\x1b[31m[red]" not in ran.out
    assert "[red]b" in ran.out
