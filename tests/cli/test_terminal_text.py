"""What reaches a terminal: colours when they are wanted, deck text as plain text, a mark under the right column."""

from __future__ import annotations

import io
import json
import re
import sys

import pytest
from rich.cells import cell_len

from mudline.basics.limits import LONGEST_MESSAGE
from mudline.checks.output import form_module, visible
from mudline.cli import streams
from mudline.cli.lint_report import excerpt
from mudline.language.diagnostics import Diagnostic, Edit, Fix, Severity
from mudline.language.syntax.source import Source
from tests.cli.conftest import Place
from tests.cli.runner import SAMPLES, Outcome, assert_fits, process, run
from tests.helpers.builders.decks import BAD_NUMBER, CLEAN

ESCAPE = re.compile(r"\x1b\[[0-9;]*m")


def plain(text: str) -> str:
    return ESCAPE.sub("", text)


def bad_line(line: str, *options: str, name: str = "deck.keyxm") -> Outcome:
    deck = CLEAN.replace(" 2, -0.1, 10.0", line)
    return run("lint", "-", "--stdin-filename", name, *options, stdin=deck.encode())


def marked(outcome: Outcome) -> tuple[str, str]:
    """The source line of the first finding and what stands under it."""
    lines = plain(outcome.out).splitlines()
    return lines[1], lines[2]


# -------------------------------------------------------------------------------------------------------------- colours


@pytest.mark.parametrize("command", ["lint", "validate", "rules"])
def test_colours_on_a_terminal_only(place: Place, command: str) -> None:
    arguments = [command, *([] if command == "rules" else [place(BAD_NUMBER)])]
    assert "\x1b[" in run(*arguments, terminal=True).out
    assert "\x1b" not in run(*arguments).out
    assert "\x1b" not in run(*arguments, "--color", "never", terminal=True).out
    assert "\x1b[" in run(*arguments, "--color", "always").out


def test_no_color_is_respected_unless_overruled(place: Place, monkeypatch: pytest.MonkeyPatch) -> None:
    name = place(BAD_NUMBER)
    monkeypatch.setenv("NO_COLOR", "1")
    assert "\x1b" not in run("lint", name, terminal=True).out
    assert "\x1b[" in run("lint", name, "--color", "always").out
    monkeypatch.setenv("NO_COLOR", "")
    assert "\x1b[" in run("lint", name, terminal=True).out


@pytest.mark.parametrize("form", ["json", "jsonl", "concise"])
def test_machine_formats_have_no_colours(place: Place, form: str) -> None:
    outcome = run("lint", place(BAD_NUMBER), "--output-format", form, "--color", "always", terminal=True)
    assert "\x1b" not in outcome.out


# ------------------------------------------------------------------------------------------------ text that looks alive


@pytest.mark.parametrize("text", ["\x1b[31m", "\x9b31m", "\u202e"])
@pytest.mark.parametrize("form", ["json", "yaml", "keyword"])
def test_conversion_is_harmless_on_a_terminal_and_exact_in_a_pipe(place: Place, form: str, text: str) -> None:
    name = place(CLEAN.replace("Clay", f"Cl{text}ay"))
    shown = run("convert", name, "--to", form, terminal=True)
    assert all(char.isprintable() or char == "\n" for char in shown.out)
    piped = run("convert", name, "--to", form)
    assert (
        run("convert", "-", "--from", form, "--to", "json", stdin=piped.output).json()["sections"]
        == (run("convert", name, "--to", "json").json()["sections"])
    )


# ------------------------------------------------------------------------------------------------ the mark and its line


@pytest.mark.parametrize("line", [" 2, -0.1, ten", "\t2,\t-0.1,\tten", " 2, -0.1,\t\t ten"])
def test_mark_stands_under_the_fault(line: str) -> None:
    source, under = marked(bad_line(line, "--select", "SYN002"))
    assert source == f" 6 | {line}".replace("\t", " ")
    assert under == f"   | {' ' * line.index('ten')}^^^"


def test_mark_counts_the_columns_of_wide_characters() -> None:
    outcome = bad_line(" \u6f22\u5b57, -0.1, ten")
    lines = outcome.out.splitlines()
    under = [lines[i + 1] for i, line in enumerate(lines) if line.startswith(" 6 | ")]
    source = next(line for line in lines if line.startswith(" 6 | "))
    column = cell_len(source[: source.index("ten")])
    assert any(cell_len(line[: line.index("^")]) == column and line.endswith("^^^") for line in under)
    first = source.index("\u6f22")
    assert any(line[: line.index("^")] == "   | " + " " * (first - 5) and line.endswith("^^^^") for line in under)


def test_mark_counts_what_is_escaped(place: Place) -> None:
    name = place(CLEAN.replace(" 2, -0.1, 10.0", " 2, \u00e4\u6f22, 10.0"))
    outcome = process("lint", name, env={"PYTHONIOENCODING": "ascii"})
    source, under = marked(outcome)
    assert source == " 6 |  2, \\xe4\\u6f22, 10.0"
    assert under == "   |     ^^^^^^^^^^"


@pytest.mark.parametrize("at", [0, 10, 60, 300, 5000])
def test_long_line_is_cut_around_the_fault(at: int) -> None:
    line = f" 2, {' ' * at}ten, {'9' * 4000}"
    source, under = marked(bad_line(line))
    assert len(source) <= 120
    assert source.endswith("...")
    assert source[under.index("^") :].startswith("ten,")
    assert ("| ..." in source) == (at >= 60)
    assert under.count("^") == 3


@pytest.mark.parametrize("width", [40, 80, 100, 200])
def test_lines_fit_the_terminal(place: Place, monkeypatch: pytest.MonkeyPatch, width: int) -> None:
    monkeypatch.setenv("COLUMNS", str(width))
    name = place(CLEAN.replace(" 2, -0.1, 10.0", f" 2, -0.1, {'9' * 50} {'8' * 200}, ten"))
    lines = plain(run("lint", name, terminal=True).out).splitlines()
    assert max(map(cell_len, lines)) <= width


# --------------------------------------------------------------------------------------------------------------- tables


def test_message_is_not_broken_in_a_pipe(place: Place, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "20")
    assert run("lint", place(BAD_NUMBER)).out.splitlines()[0].endswith(" [bad-number]")


@pytest.mark.parametrize(("terminal", "width"), [(True, 72), (False, 100)])
def test_table_folds_its_texts(place: Place, monkeypatch: pytest.MonkeyPatch, *, terminal: bool, width: int) -> None:
    monkeypatch.setenv("COLUMNS", "72")
    name = place(CLEAN.replace("Pipe", "The whole of the pipe " * 8))
    text = plain(run("show", name, terminal=terminal).out)
    assert max(map(len, text.splitlines())) <= width
    assert " ".join(text.split()).count("The whole of the pipe") >= 8


def test_a_table_of_numbers_stands_closer_where_it_would_not_fit(monkeypatch: pytest.MonkeyPatch) -> None:
    heads = {}
    for width in (80, 100):
        monkeypatch.setenv("COLUMNS", str(width))
        text = plain(run("evaluate", SAMPLES / "scr-touchdown.keyxm", "-q", terminal=True).out)
        assert max(map(len, text.splitlines())) <= width
        heads[width] = next(line for line in text.splitlines() if line.startswith("line"))
    assert heads[100].split() == heads[80].split()
    assert "line  elements  " in heads[100]
    assert "line elements " in heads[80]


def test_number_is_never_cut(place: Place, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "20")
    deck = CLEAN.replace(" 0.1, 1000.0", " 0.123456, 123456.0")
    text = plain(run("curves", place(deck), terminal=True).out)
    assert "0.123456" in text
    assert "123456" in text


# ---------------------------------------------------------------- forms of findings, for what no deck makes yet: fixes,


WIDTH = 80
TEXT = Source.from_bytes(b"first\n second, x\n", "deck.keyxm")


def found(line: int = 2, column: int = 2, end_line: int = 2, end_column: int = 8, fix: Fix | None = None) -> Diagnostic:
    place = (line, column, end_line, end_column)
    return Diagnostic("deck.keyxm", "SYN004", "unknown-setting", Severity.ERROR, "no such setting", *place, fix)


def lines(diagnostic: Diagnostic, source: Source = TEXT) -> list[str]:
    pieces = excerpt(diagnostic, source, WIDTH)
    return ["".join(part if isinstance(part, str) else part[0] for part in line) for line in pieces]


@pytest.mark.parametrize(
    ("diagnostic", "under"),
    [
        (found(end_column=2), "   |  ^"),
        (found(column=10, end_column=11), "   |          ^"),
        (found(column=99, end_column=120), "   |           ^"),
        (found(end_line=3, end_column=1), "   |  ^^^^^^^^^"),
    ],
    ids=["empty", "last", "beyond", "to the next line"],
)
def test_mark(diagnostic: Diagnostic, under: str) -> None:
    assert lines(diagnostic)[1] == under


@pytest.mark.parametrize(
    ("text", "encoding", "shown"),
    [
        ("plain [x]", "utf-8", "plain [x]"),
        ("a\tb\x1bc\x9bd\x7f\u202e", "utf-8", "a b\ufffdc\ufffdd\ufffd\ufffd"),
        ("\u00e4\u6f22", "utf-8", "\u00e4\u6f22"),
        ("\u00e4\u6f22", "latin-1", "\u00e4\\u6f22"),
        ("\u00e4\x07", "ascii", "\\xe4\\ufffd"),
        ("\udcff", "utf-8", "\ufffd"),
    ],
)
def test_visible_text(text: str, encoding: str, shown: str) -> None:
    assert visible(text, encoding) == shown


def test_text_that_nobody_reads_to_its_end_is_cut() -> None:
    assert visible("x" * LONGEST_MESSAGE) == "x" * LONGEST_MESSAGE
    assert visible("x" * (LONGEST_MESSAGE + 1)) == "x" * (LONGEST_MESSAGE - 3) + "..."
    assert len(visible("\x1b" * 10_000_000)) == LONGEST_MESSAGE


def test_fix_in_json() -> None:
    fix = Fix("unsafe", "write SET=", (Edit((2, 2), (2, 8), "SET"), Edit((3, 1), (3, 1), "\n")))
    objects = json.loads("".join(form_module("json").write([found(fix=fix), found()], [])))
    assert_fits(objects, "lint")
    assert objects[0]["fix"] == {
        "applicability": "unsafe",
        "message": "write SET=",
        "edits": [
            {"start": [2, 2], "end": [2, 8], "text": "SET"},
            {"start": [3, 1], "end": [3, 1], "text": "\n"},
        ],
    }
    assert [json.loads(line) for line in form_module("jsonl").write([found(fix=fix), found()], [])] == objects


def test_a_bar_is_erased_before_what_waits_is_written(monkeypatch: pytest.MonkeyPatch) -> None:
    """Otherwise a line that waits would be written behind the bar."""
    memory = io.BytesIO()
    out = io.TextIOWrapper(io.BufferedWriter(memory), encoding="utf-8")
    monkeypatch.setattr(out, "isatty", lambda: True)
    seen: list[bytes] = []
    monkeypatch.setattr(streams, "DRAWN", [lambda: seen.append(memory.getvalue())])
    monkeypatch.setattr(sys, "stdout", out)
    streams.emit(["first\n"])
    streams.emit(["second\n"])
    out.flush()
    assert (seen, memory.getvalue()) == ([b"", b""], b"first\nsecond\n")
