"""`mudline format`: in place, from standard input, or only saying what would change."""

from __future__ import annotations

import errno
import re
from pathlib import Path
from unittest.mock import Mock

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.cli.changes import unified_diff
from mudline.editing.formatting import document
from mudline.editing.formatting.document import formatted
from tests.cli.conftest import Place
from tests.cli.runner import SAMPLES, run
from tests.helpers.builders.decks import BAD_NUMBER, CLEAN
from tests.helpers.growth import FOURFOLD, growth
from tests.helpers.samples import FAULTY

UGLY = "$model\n*ocean\n100 1025\t9.81\nC note  \n\n\n*NODE\n1,0,0\n10,0,100.5\n"
PRETTY = "$MODEL\n*OCEAN\n 100, 1025, 9.81\nC note\n\n*NODE\n  1, 0,   0\n 10, 0, 100.5\n"
NO_END = b"\\ No newline at end of file\n"
DIFF = """\
--- deck.keyxm
+++ deck.keyxm
@@ -1,9 +1,8 @@
-$model
-*ocean
-100 1025\t9.81
-C note\x20\x20
-
+$MODEL
+*OCEAN
+ 100, 1025, 9.81
+C note
\x20
 *NODE
-1,0,0
-10,0,100.5
+  1, 0,   0
+ 10, 0, 100.5
"""


def content(name: str) -> str:
    return Path(name).read_bytes().decode()


def test_in_place(place: Place) -> None:
    outcome = run("format", place(UGLY))
    assert (outcome.code, outcome.out, outcome.err) == (0, "", "1 file reformatted\n")
    assert content("deck.keyxm") == PRETTY
    outcome = run("format", "deck.keyxm")
    assert (outcome.code, outcome.out, outcome.err) == (0, "", "1 file left unchanged\n")
    assert content("deck.keyxm") == PRETTY


def test_several_files_and_directories(place: Place) -> None:
    place(UGLY, "decks/a.keyxm")
    place(UGLY, "decks/deep/b.das")
    place(PRETTY, "decks/c.keyx")
    outcome = run("format", "decks", "-v")
    assert outcome.code == 0
    assert outcome.err == (
        "mudline: decks/a.keyxm: reformatted\nmudline: decks/deep/b.das: reformatted\n"
        "2 files reformatted, 1 file left unchanged\n"
    )
    assert {content(f"decks/{name}") for name in ("a.keyxm", "deep/b.das", "c.keyx")} == {PRETTY}


def test_a_file_that_does_not_change_is_not_written(place: Place, monkeypatch: pytest.MonkeyPatch) -> None:
    written = Mock()
    monkeypatch.setattr("mudline.cli.inputs.write_atomically", written)
    assert run("format", place(PRETTY)).code == 0
    assert written.call_count == 0


def test_diff(place: Place) -> None:
    outcome = run("format", "--diff", place(UGLY))
    assert (outcome.code, outcome.out, outcome.err) == (1, DIFF, "1 file would be reformatted\n")
    assert content("deck.keyxm") == UGLY
    outcome = run("format", "--diff", place(PRETTY))
    assert (outcome.code, outcome.out, outcome.err) == (0, "", "1 file would be left unchanged\n")


def test_colours_only_on_a_terminal(place: Place, monkeypatch: pytest.MonkeyPatch) -> None:
    name = place("$MODEL\n*ocean\n 5\nC \x1b[31m\n")
    assert "\x1b" not in run("format", "--diff", name).out.replace("C \x1b[31m", "")
    coloured = run("format", "--diff", name, "--color", "always").out
    assert "\x1b[31m-*ocean\x1b[0m" in coloured
    assert "\x1b[32m+*OCEAN\x1b[0m" in coloured
    assert "C \x1b" not in coloured
    monkeypatch.setenv("NO_COLOR", "1")
    assert "\x1b" not in run("format", "--diff", name, terminal=True).out


def test_standard_input(place: Place) -> None:
    place(UGLY)
    outcome = run("format", "-", stdin=UGLY.encode())
    assert (outcome.code, outcome.out, outcome.err) == (0, PRETTY, "")
    outcome = run("format", "-", stdin=PRETTY.encode())
    assert (outcome.code, outcome.out, outcome.err) == (0, PRETTY, "")
    outcome = run("format", "-", "--check", stdin=UGLY.encode(), terminal=True)
    assert (outcome.code, outcome.out) == (1, "would reformat: <stdin>\n")
    outcome = run("format", "-", "--diff", "--stdin-filename", "deck.keyxm", stdin=UGLY.encode())
    assert (outcome.code, outcome.out) == (1, DIFF)
    assert content("deck.keyxm") == UGLY


def test_standard_input_keeps_its_encoding() -> None:
    data = b"\xef\xbb\xbf" + "$model\r\nC \u00e9 \r\n".encode()
    assert run("format", "-", stdin=data).output == b"\xef\xbb\xbf" + "$MODEL\r\nC \u00e9\r\n".encode()
    assert run("format", "-", stdin=b"$model\nC \xe9\x80 \n").output == b"$MODEL\nC \xe9\x80\n"
    shown = run("format", "-", stdin=b"$model\nC \xe9 \x1b \n", terminal=True).out
    assert shown == "$MODEL\nC \u00e9 \ufffd\n"


def test_a_deck_with_an_error_is_told_and_the_others_go_on(place: Place) -> None:
    place(UGLY, "z.keyxm")
    outcome = run("format", place(BAD_NUMBER), "z.keyxm")
    assert (outcome.code, outcome.out) == (1, "")
    assert outcome.err.splitlines() == [
        "deck.keyxm:6:11: error: SYN002 'ten' is not a number: expected a number or an equation =[...] for y",
        "1 file reformatted, 1 file not formatted",
    ]
    assert content("deck.keyxm") == BAD_NUMBER
    assert content("z.keyxm") == PRETTY
    outcome = run("format", "-", stdin=BAD_NUMBER.encode())
    assert (outcome.code, outcome.out) == (1, "")


def test_paths_that_cannot_be_read_or_written(place: Place, monkeypatch: pytest.MonkeyPatch) -> None:
    place(UGLY, "z.keyxm")
    outcome = run("format", "gone.keyxm", "z.keyxm")
    assert outcome.code == 2
    assert "gone.keyxm: no such file or directory" in outcome.err
    assert content("z.keyxm") == PRETTY
    full = OSError(errno.ENOSPC, "No space left on device")
    monkeypatch.setattr("mudline.cli.inputs.write_atomically", Mock(side_effect=full))
    outcome = run("format", place(UGLY), place(UGLY, "b.keyxm"))
    assert outcome.code == 2
    assert "mudline: deck.keyxm: cannot be written: no space left on device\n" in outcome.err
    assert "2 files not formatted" in outcome.err


def test_a_text_that_would_mean_something_else_is_not_written(place: Place, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(document, "same_meaning", lambda _one, _other: False)
    outcome = run("format", place(UGLY))
    assert (outcome.code, content("deck.keyxm")) == (1, UGLY)
    assert outcome.err == (
        "mudline: deck.keyxm: formatting would change its meaning, so it is left unchanged: "
        "please report this fault of mudline\n"
        "1 file not formatted\n"
    )


def test_yaml_comments_are_not_lost(place: Place) -> None:
    text = "# mine\n" + run("convert", place(CLEAN), "--to", "yaml").out
    outcome = run("format", place(text, "deck.yaml"))
    assert (outcome.code, content("deck.yaml")) == (1, text)
    assert "deck.yaml: its YAML comments (#) would be lost" in outcome.err


@pytest.mark.covered
@pytest.mark.parametrize("end", ["\n", "\r\n"], ids=["LF", "CRLF"])
@pytest.mark.parametrize("cut", [False, True])
@pytest.mark.parametrize("name", sorted(path.name for path in SAMPLES.glob("*.key*") if path.name not in FAULTY))
def test_a_diff_is_a_patch(folder: Path, name: str, end: str, cut: bool) -> None:
    text = (SAMPLES / name).read_text(encoding="utf-8").replace("\n*", "\n\n\n*").replace("\n", end)
    data = (text.rstrip() if cut else text).encode()
    (folder / name).write_bytes(data)
    assert patched(data, run("format", "--diff", name).output) == formatted(data, name)


def patched(data: bytes, diff: bytes) -> bytes:
    """The content after a unified diff, whose context and old lines must be those of the content."""
    old = re.findall(rb"[^\n]*\n|[^\n]+", data)
    new: list[bytes] = []
    at = 0
    lines = re.findall(rb"[^\n]*\n", diff)[2:]
    for number, line in enumerate(lines):
        text = line[1:].removesuffix(b"\n") if lines[number + 1 : number + 2] == [NO_END] else line[1:]
        if line.startswith(b"@@"):
            start = int(line.split()[1].lstrip(b"-").partition(b",")[0]) - 1
            new += old[at:start]
            at = start
        elif line != NO_END:
            if line[:1] in b" -":
                assert old[at] == text
                at += 1
            new += [text] if line[:1] in b" +" else []
    return b"".join(new + old[at:])


def test_a_line_end_that_changes_is_a_change() -> None:
    assert list(unified_diff("a\nb\r\n", "a\nb\n", "x.keyxm")) == [
        "--- x.keyxm\n",
        "+++ x.keyxm\n",
        "@@ -1,2 +1,2 @@\n",
        " a\n",
        "-b\r\n",
        "+b\n",
    ]


_TEXTS = st.lists(st.sampled_from(["a\n", "b\n", "\n", " \n", "1\r\n", "2\n", "3\rx\n"])).map("".join)


@given(_TEXTS, _TEXTS, st.sampled_from(["", "x", "7"]), st.sampled_from(["", "x", "8"]))
def test_a_diff_of_any_texts_is_a_patch(old: str, new: str, last: str, new_last: str) -> None:
    one, other = (old + last).encode(), (new + new_last).encode()
    assert patched(one, "".join(unified_diff(old + last, new + new_last, "x.keyxm")).encode()) == other


@pytest.mark.untraced
def test_every_second_row_of_a_long_table_changes_in_little_time() -> None:
    def texts(count: int) -> tuple[str, str]:
        old = "".join(f"{number},0\n{number}, 1\n" for number in range(count))
        return old, old.replace(",0", ", 0")

    def added(texts: tuple[str, str]) -> int:
        return sum(line.startswith("+") for line in unified_diff(*texts, "x.keyxm"))

    assert growth(added, texts(4_000), texts(16_000)) < FOURFOLD
    assert added(texts(20_000)) == 20_001
