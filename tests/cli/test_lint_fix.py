"""`mudline lint --fix`, `--diff`, `--baseline`, `--output-format FORM=FILE`: files, streams and exit codes."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.cli.conftest import Place
from tests.cli.runner import assert_fits, run
from tests.helpers.builders.decks import BAD_NUMBER, CLEAN

IDLE = CLEAN.replace(" CURVE=Clay", "C mudline: ignore CRV005\n CURVE=Clay")
"""A STY010 (warning) with a safe fix at 24:19, and nothing else."""
GUESS = CLEAN.replace(" CURVE=Clay", "C mudline: ignore CRVV05\n CURVE=Clay")
"""A STY010 with an unsafe fix."""

READ = "All 7 keywords read.\n"


def read(name: str) -> str:
    return Path(name).read_text(encoding="utf-8")


def test_fixes_are_made_in_place_and_do_not_count(place: Place) -> None:
    outcome = run("lint", place(IDLE), "--fix")
    assert (outcome.code, outcome.out, outcome.err) == (
        0,
        f"Found 1 finding (1 fixed, 0 remaining) in 1 file.\n{READ}",
        "",
    )
    assert read("deck.keyxm") == CLEAN
    assert run("lint", "deck.keyxm", "--fix").out == f"No findings in 1 file.\n{READ}"


def test_what_is_not_fixed_counts(place: Place) -> None:
    outcome = run("lint", place(GUESS.replace(" CURVE", "C mudline: ignore CRV005\n CURVE")), "--fix")
    assert outcome.code == 1
    assert outcome.out.endswith(
        f"Found 2 findings (1 fixed, 1 remaining) in 1 file.\n1 fixable with --fix --unsafe-fixes.\n{READ}"
    )


def test_unsafe_fixes_have_to_be_asked_for(place: Place) -> None:
    assert run("lint", place(GUESS), "--unsafe-fixes").code == 1
    assert read("deck.keyxm") == GUESS
    outcome = run("lint", "deck.keyxm", "--fix", "--unsafe-fixes", "--select", "STY010")
    assert (outcome.code, "CRVV05" in read("deck.keyxm")) == (0, False)


def test_what_could_be_fixed_is_told(place: Place) -> None:
    assert run("lint", place(IDLE)).out.endswith(f"in 1 file.\n1 fixable with --fix.\n{READ}")
    both = IDLE.replace("CRV005", "CRV005, CRVV05")
    assert run("lint", place(both)).out.endswith(f"\n1 fixable with --fix, 1 more with --unsafe-fixes.\n{READ}")


def test_diff_prints_and_writes_nothing(place: Place) -> None:
    outcome = run("lint", place(IDLE), "--diff")
    assert outcome.code == 1
    assert outcome.out.startswith("--- deck.keyxm\n+++ deck.keyxm\n@@ ")
    assert "\n-C mudline: ignore CRV005\n" in outcome.out
    assert outcome.err == "Found 1 finding (1 fixed, 0 remaining) in 1 file.\n"
    assert read("deck.keyxm") == IDLE
    assert run("lint", "deck.keyxm", "--diff", "--exit-zero").code == 0
    assert run("lint", place(CLEAN), "--diff").output == b""


def test_standard_input_is_printed_fixed_and_findings_go_to_standard_error() -> None:
    outcome = run("lint", "-", "--stdin-filename", "deck.keyxm", "--fix", stdin=IDLE.encode())
    assert (outcome.code, outcome.out) == (0, CLEAN)
    outcome = run("lint", "-", "--fix", "--stdin-filename", "deck.keyxm", stdin=BAD_NUMBER.encode())
    assert (outcome.code, outcome.out) == (1, BAD_NUMBER)
    assert outcome.err.startswith("deck.keyxm:6:11: SYN002 ")
    outcome = run("lint", "-", "--fix", "--output-format", "json", stdin=BAD_NUMBER.encode())
    assert [one["code"] for one in json.loads(outcome.err)] == ["SYN002"]


def test_a_file_that_cannot_be_read_is_not_fixed(place: Place) -> None:
    broken = IDLE.replace(" 2, -0.1, 10.0", " 2, -0.1, ten")
    outcome = run("lint", place(broken), "--fix")
    assert (outcome.code, read("deck.keyxm")) == (1, broken)
    assert outcome.err == "mudline: deck.keyxm: not fixed: correct what cannot be read first, SYN002 in line 6\n"
    assert "(0 fixed, 2 remaining)" in outcome.out


def test_documents_are_told_once(place: Place) -> None:
    text = run("convert", place(IDLE), "--to", "json").out
    outcome = run("lint", place(text, "a.json"), place(text, "b.json"), "--fix")
    assert (outcome.code, read("a.json")) == (1, text)
    assert outcome.err == "mudline: 2 decks in JSON or YAML not fixed: only keyword text is\n"


def test_a_file_that_cannot_be_written_keeps_its_findings(place: Place, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(path: Path, data: bytes) -> None:
        raise PermissionError(13, "Permission denied", str(path), len(data))

    monkeypatch.setattr("mudline.cli.inputs.write_atomically", refuse)
    outcome = run("lint", place(IDLE), "--fix")
    assert outcome.code == 2
    assert outcome.err == "mudline: deck.keyxm: cannot be written: permission denied\n"
    assert "(0 fixed, 1 remaining)" in outcome.out


def test_a_baseline_hides_what_was_there_when_it_was_written(place: Place) -> None:
    outcome = run("lint", place(BAD_NUMBER, "decks/a.keyxm"), "--baseline", "known.json", "--write-baseline")
    assert (outcome.code, outcome.err) == (0, "mudline: known.json: 1 finding recorded\n")
    assert_fits(json.loads(read("known.json")), "baseline")
    before = read("known.json")
    run("lint", "decks", "--baseline", "known.json", "--write-baseline", "-q")
    assert read("known.json") == before
    place("C\n" + BAD_NUMBER, "decks/a.keyxm")
    assert run("lint", "decks", "--baseline", "known.json", "--output-format", "json").out == "[]\n"
    place(BAD_NUMBER.replace("ten", "tan"), "decks/a.keyxm")
    outcome = run("lint", "decks", "--baseline", "known.json", "-v")
    assert outcome.code == 1
    assert "known.json: 1 recorded finding no longer there" in outcome.err
    assert "no longer" not in run("lint", "decks", "--baseline", "known.json").err


def test_a_baseline_that_cannot_be_used_is_wrong_usage(place: Place) -> None:
    missing = run("lint", place(), "--baseline", "nowhere.json")
    assert (missing.code, missing.out) == (2, "")
    assert "nowhere.json: the baseline cannot be read: no such file" in missing.err
    broken = run("lint", place(), "--baseline", place("[]", "known.json"))
    assert broken.code == 2
    assert "not a baseline" in broken.err
    assert "needs --baseline" in run("lint", place(), "--write-baseline").err


def test_several_outputs_at_once(place: Place) -> None:
    outcome = run("lint", place(BAD_NUMBER), "--output-format", "concise", "--output-format", "json=found.json")
    assert outcome.out.startswith("deck.keyxm:6:11: SYN002")
    assert [one["code"] for one in json.loads(read("found.json"))] == ["SYN002"]
    assert "Found 1 error" in run("lint", "deck.keyxm", "--output-format", "jsonl=found.jsonl").out


def test_statistics_and_quiet_beside_a_fixed_deck() -> None:
    outcome = run("lint", "-", "--fix", "--statistics", "-q", stdin=BAD_NUMBER.encode())
    assert (outcome.out, outcome.err) == (BAD_NUMBER, "     1  SYN002  bad-number\n")
