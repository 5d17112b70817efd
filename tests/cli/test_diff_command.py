"""`mudline diff`."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.builders.decks import BAD_NUMBER, CLEAN, LINEAR
from tests.cli.conftest import Place
from tests.cli.runner import assert_fits, run

BARE = CLEAN.partition("*SEABED")[0]
OLD = BARE + "*ELASTIC SURFACE\n 20000.0, 0.3, 0.6\n"
NEW = BARE + "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=20000.0\n FRICTION=0.3, 0.6\n"


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


def test_a_migrated_pair(place: Place) -> None:
    old, new = place(OLD, "old.keyxm"), place(NEW, "new.keyxm")
    ran = run("diff", old, new)
    assert (ran.code, ran.out) == (0, "equivalent: 10 differences of spelling in superseded keywords\n")
    assert run("diff", "-q", old, new).out == ""
    ran = run("diff", old, new, "--output-format", "json")
    assert_fits(ran.json(), "diff")
    assert (ran.code, ran.json()["equivalent"], ran.json()["spelling_differences"]) == (0, True, 10)
    assert ran.json()["differences"] == []


def test_a_migrated_pair_strictly(place: Place) -> None:
    old, new = place(OLD, "old.keyxm"), place(NEW, "new.keyxm")
    ran = run("diff", "--strict", old, new)
    assert ran.code == 1
    assert ran.out == (
        "--- old.keyxm\n+++ new.keyxm\n"
        "*ELASTIC SURFACE\n"
        "  - *ELASTIC SURFACE  (line -18)\n"
        "  - properties/stiffness: 20000.0  (line -19)\n"
        "  - properties/longitudinal: 0.3  (line -19)\n"
        "  - properties/transverse: 0.6  (line -19)\n"
        "*SEABED PROPERTIES\n"
        "  + *SEABED PROPERTIES  (line +18)\n"
        "  + ALL  (line +20)\n"
        "  + ALL/type: ELASTIC  (line +19)\n"
        "  + ALL/stiffness: 20000.0  (line +21)\n"
        "  + ALL/friction/longitudinal: 0.3  (line +22)\n"
        "  + ALL/friction/transverse: 0.6  (line +22)\n"
        "10 differences\n"
    )
    found = run("diff", "--strict", old, new, "--output-format", "json").json()
    assert (found["equivalent"], found["spelling_differences"], len(found["differences"])) == (False, 0, 10)


def test_a_difference_beside_the_spelling(place: Place) -> None:
    old, new = place(OLD, "old.keyxm"), place(NEW.replace("0.3, 0.6", "0.3, 0.7"), "new.keyxm")
    ran = run("diff", old, new)
    assert ran.code == 1
    assert ran.out == (
        "--- old.keyxm\n+++ new.keyxm\n"
        "bed of elements\n"
        "  ~ elements 1-2/bed/transverse friction: 0.6 -> 0.7  (line -19 +20)\n"
        "1 difference, and 10 differences of spelling in superseded keywords (--strict lists them)\n"
    )


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
