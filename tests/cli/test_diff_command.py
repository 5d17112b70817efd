"""`mudline diff`."""

from __future__ import annotations

import os
from html import unescape
from pathlib import Path
from typing import Any

import pytest

import mudline
from mudline.cli import diff_command
from mudline.cli.diff_command import code, fenced
from mudline.editing.comparison import decks
from mudline.language.deck.model import Deck
from tests.cli.conftest import Place
from tests.cli.runner import assert_fits, run
from tests.helpers.builders.decks import BAD_NUMBER, CLEAN

BARE = CLEAN.partition("*SEABED")[0]
OLD = BARE + "*ELASTIC SURFACE\n 20000.0, 0.3, 0.6\n"
NEW = BARE + "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=20000.0\n FRICTION=0.3, 0.6\n"


def test_a_migrated_pair(place: Place) -> None:
    old, new = place(OLD, "old.keyxm"), place(NEW, "new.keyxm")
    ran = run("diff", old, new)
    assert (ran.code, ran.out) == (0, "equivalent: 10 differences of spelling in superseded keywords\n")
    assert run("diff", "-q", old, new).out == ""
    ran = run("diff", old, new, "--output-format", "json")
    assert_fits(ran.json(), "diff")
    assert (ran.code, ran.json()["equivalent"], ran.json()["spelling_differences"]) == (0, True, 10)
    assert ran.json()["differences"] == []


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


@pytest.mark.parametrize("words", [("-", "-"), ("deck.keyxm",), ("deck.keyxm", "no"), ("--tolerance", "2", "-", "a")])
def test_wrong_usage(place: Place, words: tuple[str, ...]) -> None:
    place()
    assert run("diff", *words, stdin=b"").code == 2


def test_text_of_a_deck_does_not_act_on_a_terminal(place: Place) -> None:
    bad = CLEAN + "*PROPERTIES\n a\x1b[31m[red]b\n"
    ran = run("diff", place(), place(bad, "b.keyxm"), "--color", "always", terminal=True)
    assert "\x1b[31m[red]" not in ran.out
    assert "[red]b" in ran.out


# ------------------------------------------------------------------------------------------ mudline diff of two folders


CHANGED = CLEAN.replace("1000.0", "1200.0")
LAYOUT = CLEAN.replace("0.1, 1000.0", "1e-1, 1.0E3")


@pytest.fixture
def folders(place: Place) -> None:
    """A deck of each kind: changed, equal but for layout, removed, added."""
    place(CLEAN, "old/a/changed.keyxm")
    place(CHANGED, "new/a/changed.keyxm")
    place(CLEAN, "old/equal.keyxm")
    place(LAYOUT, "new/equal.keyxm")
    place(CLEAN, "old/gone.keyxm")
    place(CLEAN, "new/here.keyxm")
    place("no deck", "new/readme.txt")


@pytest.mark.usefixtures("folders")
def test_json() -> None:
    ran = run("diff", "old", "new", "--output-format", "json")
    found = ran.json()
    assert_fits(found, "diff")
    assert (ran.code, found["equivalent"]) == (1, False)
    assert found["summary"] == {"changed": 1, "added": 1, "removed": 1, "equal": 1, "failed": 0}
    assert [(one["deck"], one["status"]) for one in found["decks"]] == [
        ("a/changed.keyxm", "changed"),
        ("equal.keyxm", "equal"),
        ("gone.keyxm", "removed"),
        ("here.keyxm", "added"),
    ]
    assert [one["after"] for one in found["decks"][0]["differences"]] == [1200.0]


def test_a_deck_of_a_folder_that_cannot_be_read(place: Place) -> None:
    place(CLEAN, "old/deck.keyxm")
    place(BAD_NUMBER, "new/deck.keyxm")
    ran = run("diff", "old", "new")
    assert (ran.code, ran.out) == (1, "! deck.keyxm: cannot be compared\n1 deck: 1 cannot be compared\n")
    assert ran.err.startswith("new/deck.keyxm:6:11: error: SYN002")
    found = run("diff", "old", "new", "--output-format", "json").json()
    assert_fits(found, "diff")
    assert found["decks"][0]["why"].startswith("new/deck.keyxm:6:11: SYN002")


def test_a_file_of_a_folder_that_cannot_be_opened(place: Place, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("old/deck.keyxm", "new/deck.keyxm", "old/equal.keyxm", "new/equal.keyxm"):
        place(CLEAN, name)
    read = Path.read_bytes

    def refused(path: Path) -> bytes:
        if path.as_posix() == "new/deck.keyxm":
            raise PermissionError(13, "Permission denied", str(path))
        return read(path)

    monkeypatch.setattr(Path, "read_bytes", refused)
    ran = run("diff", "old", "new")
    assert (ran.code, ran.err) == (2, "mudline: new/deck.keyxm: permission denied\n")
    assert ran.out == "! deck.keyxm: cannot be compared\n2 decks: 1 equal, 1 cannot be compared\n"
    (one,) = [each for each in mudline.diff("old", "new").decks if each.status == "failed"]
    assert (one.name, one.why) == ("deck.keyxm", "new/deck.keyxm: permission denied")


def test_a_folder_that_cannot_be_searched_and_a_deck_of_its_name(place: Place, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("old/equal.keyxm", "new/equal.keyxm", "old/x.keyxm/deck.keyxm", "new/old/x.keyxm"):
        place(CLEAN, name)
    scan = os.scandir

    def refused(folder: str) -> object:
        if os.fspath(folder) == "old/x.keyxm":
            raise PermissionError(13, "Permission denied", folder)
        return scan(folder)

    monkeypatch.setattr(os, "scandir", refused)
    ran = run("diff", "old", "new")
    assert (ran.code, ran.err) == (2, "mudline: old/x.keyxm: permission denied\n")
    assert ran.out.splitlines() == [
        "! old/x.keyxm: cannot be compared",
        "+ old/x.keyxm: only in the second folder",
        "3 decks: 1 added, 1 equal, 1 cannot be compared",
    ]


def test_a_fault_of_the_program_in_one_of_two_folders(place: Place, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("old/deck.keyxm", "new/deck.keyxm", "old/equal.keyxm", "new/equal.keyxm"):
        place(CLEAN, name)
    compared = decks.compare_decks

    def failing(first: Deck, *given: Any, **more: Any) -> decks.Comparison:  # noqa: ANN401 - as the function
        if first.file == "old/deck.keyxm":
            raise IndexError("a fault")
        return compared(first, *given, **more)

    monkeypatch.setattr(decks, "compare_decks", failing)
    ran = run("diff", "old", "new", "--output-format", "json")
    found = ran.json()
    assert_fits(found, "diff")
    assert ran.err.startswith("mudline: old/deck.keyxm: internal error, please report it: IndexError: a fault")
    assert (ran.code, found["equivalent"], found["summary"]["failed"]) == (2, False, 1)
    assert found["decks"][0]["why"].startswith("internal error: IndexError: a fault")


def test_folders_without_a_deck(folder: Path, place: Place) -> None:
    for name in ("one", "two"):
        (folder / name).mkdir()
    assert run("diff", "one", "two").code == 2
    place(CLEAN, "two/deck.keyxm")
    ran = run("diff", "one", "two")
    assert (ran.code, ran.out) == (1, "+ deck.keyxm: only in the second folder\n1 deck: 1 added\n")


def test_a_deck_of_a_folder_that_the_configuration_excludes(place: Place) -> None:
    for path in ("A/old.keyxm", "A/deck.keyxm", "B/old.keyxm", "B/deck.keyxm"):
        place(CLEAN.replace("-0.1,", "-0.2,") if path == "B/old.keyxm" else CLEAN, path)
    assert run("diff", "A", "B").code == 1
    place('exclude = ["old*"]\n', "mudline.toml")
    assert run("diff", "A", "B").out == "1 deck: 1 equal\n"


@pytest.mark.usefixtures("folders")
def test_a_folder_and_a_deck_are_not_compared() -> None:
    ran = run("diff", "old", "new/here.keyxm")
    assert ran.code == 2
    assert "give two decks or two folders" in ran.err
    for words in (("old", "nowhere"), ("nowhere", "old")):
        ran = run("diff", *words)
        assert (ran.code, ran.err) == (2, "mudline: nowhere: no such file or directory\n")


@pytest.mark.skipif(os.name != "posix", reason="the null device has another name")
def test_the_null_device_is_an_empty_deck(place: Place) -> None:
    """As git gives it for a file that is new."""
    for words in ((os.devnull, place()), ("deck.keyxm", os.devnull)):
        ran = run("diff", *words)
        assert ran.code == 1
        assert "units" not in ran.out


# ----------------------------------------------------------------------------------------------------------- CommonMark


HOSTILE = ("a|b", "`", "``a`", "*a* _b_ ~~c~~", "<script>alert(1)</script>", "@all #12 $x^2$", "[a](http://b)", "&amp;")
BLOCKS = ("</code></details>", "a\n```\n# b", "````")


def rendered(text: str) -> str:
    """The HTML of a text."""
    return str(pytest.importorskip("markdown_it").MarkdownIt("commonmark").render(text))


@pytest.mark.parametrize("text", [*HOSTILE, *BLOCKS])
def test_text_of_a_deck_is_code_and_nothing_else(text: str) -> None:
    if "\n" not in text:
        assert unescape(rendered(code(text))) == f"<p><code>{text}</code></p>\n"
    html = rendered(fenced([text, "b"]))
    assert html.count("<pre>") == 1
    assert unescape(html) == f'<pre><code class="language-diff">{text}\nb\n</code></pre>\n'


def test_a_text_that_does_not_print_has_marks() -> None:
    assert code("a\x1b[31m\tb") == "`a\ufffd[31m b`"
    assert code("") == ""


def test_two_decks(place: Place) -> None:
    ran = run("diff", place(), place(CLEAN.replace("1000.0", "1200.0"), "b.keyxm"), "--output-format", "markdown")
    assert ran.code == 1
    assert ran.out == (
        "### Differences of decks\n\n`deck.keyxm` → `b.keyxm`: **1 difference**\n\n"
        "```diff\ncurves\n~ Clay/0.1: 1000.0 -> 1200.0  (line -25 +25)\n```\n"
    )
    same = run("diff", "deck.keyxm", "deck.keyxm", "--output-format", "markdown")
    assert (same.code, same.out) == (0, "### Differences of decks\n\n`deck.keyxm` → `deck.keyxm`: **no difference**\n")


def test_two_folders(place: Place) -> None:
    for name, old, new in (("a", CLEAN, CLEAN.replace("1000.0", "1200.0")), ("b", CLEAN, BAD_NUMBER)):
        place(old, f"old/{name}.keyxm")
        place(new, f"new/{name}.keyxm")
    place(CLEAN, "new/c.keyxm")
    place(CLEAN, "old/d.keyxm")
    ran = run("diff", "old", "new", "--output-format", "markdown")
    assert ran.code == 1
    assert ran.out == (
        "### Differences of decks\n\n`old` → `new`: "
        "**4 decks: 1 changed, 1 added, 1 removed, 1 cannot be compared**\n\n```diff\n"
        "--- old/a.keyxm\n+++ new/a.keyxm\ncurves\n~ Clay/0.1: 1000.0 -> 1200.0  (line -25 +25)\n"
        "! b.keyxm: cannot be compared\n+ c.keyxm: only in the second folder\n"
        "- d.keyxm: only in the first folder\n```\n"
    )


def test_what_does_not_fit_a_comment_is_left_out(place: Place, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(diff_command, "COMMENT_LETTERS", 300)
    for number in range(5):
        place(CLEAN, f"old/{number}.keyxm")
        place(CLEAN.replace("1000.0", "1200.0"), f"new/{number}.keyxm")
    out = run("diff", "old", "new", "--output-format", "markdown").out
    assert len(out) < 300 + 100
    assert out.endswith("```\n\n*The rest does not fit here: `mudline diff -v` prints all.*\n")
    whole = run("diff", "-v", "old", "new", "--output-format", "markdown").out
    assert whole.count("Clay/0.1") == 5
    assert whole.endswith("```\n")
