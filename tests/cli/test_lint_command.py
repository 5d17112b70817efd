"""`mudline lint`: what it finds, tells and answers."""

from __future__ import annotations

import json
import multiprocessing
from pathlib import Path

import pytest

from mudline.checks.engine import lint_bytes
from mudline.checks.registry import rules
from mudline.language.diagnostics import Diagnostic
from mudline.tools.running import executors, remembered
from tests.checks.test_recovery import changed
from tests.cli.conftest import Place
from tests.cli.runner import Outcome, run
from tests.helpers.builders.decks import BAD_NUMBER, CLEAN, UNSORTED
from tests.helpers.builders.decks import UNUSED as SOFT

UNUSED = SOFT.replace(" 0.1, 1.0\n", " 0.1, 100.0\n")
"""A REF003 (warning), and nothing else."""

MANY = UNUSED.replace(" 2, -0.1, 10.0\n", " 2, -0.1, ten\n").replace(
    " 0.0, 0.0\n 0.1, 1000.0\n", " 0.1, 1000.0\n 0.0, 0.0\n"
)
"""One error, one warning, one info."""


def codes(outcome: Outcome) -> list[str]:
    return [found["code"] for found in outcome.json()]


def lint(deck: str, *options: str) -> Outcome:
    return run("lint", "-", "--stdin-filename", "deck.keyxm", *options, stdin=deck.encode())


@pytest.mark.parametrize(
    ("deck", "limit", "code"),
    [
        (UNSORTED, "info", 1),
        (UNSORTED, "warning", 0),
        (UNSORTED, "error", 0),
        (UNUSED, "info", 1),
        (UNUSED, "warning", 1),
        (UNUSED, "error", 0),
        (BAD_NUMBER, "error", 1),
        (CLEAN, "info", 0),
    ],
)
def test_fail_on(deck: str, limit: str, code: int) -> None:
    assert lint(deck, "--fail-on", limit).code == code


def test_exit_zero() -> None:
    outcome = lint(BAD_NUMBER, "--exit-zero")
    assert outcome.code == 0
    assert "SYN002" in outcome.out


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        ((), ["SYN002", "CRV002", "REF003"]),
        (("--select", "SYN"), ["SYN002"]),
        (("--select", "unsorted-points"), ["CRV002"]),
        (("--select", "REF003,SYN002"), ["SYN002", "REF003"]),
        (("--select", "SYN", "--select", "CRV002"), ["SYN002", "CRV002"]),
        (("--ignore", "SYN"), ["CRV002", "REF003"]),
        (("--ignore", "SYN,CRV002"), ["REF003"]),
        (("--select", "SYN", "--extend-select", "REF003"), ["SYN002", "REF003"]),
        (("--select", "SYN", "--ignore", "SYN002"), []),
    ],
)
def test_selection(options: tuple[str, ...], expected: list[str]) -> None:
    assert codes(lint(MANY, "--output-format", "json", *options)) == expected


def test_statistics_count_instead_of_listing() -> None:
    outcome = lint(MANY + " CURVE=Gravel\n 0.0, 0.0\n 0.1, 100.0\n", "--statistics")
    assert outcome.code == 1
    assert outcome.out.split("\n") == [
        "     2  REF003  unused-curve",
        "     1  CRV002  unsorted-points",
        "     1  SYN002  bad-number",
        "",
    ]


def test_summary_counts_by_severity() -> None:
    assert "\nFound 1 error, 1 warning, 1 info in 1 file.\n" in lint(MANY).out


# ------------------------------------------------------------------------------------------------------ configuration


DECK = "$MODEL\n*ELASTIC SURFACE\n1000\n"


def severities(*arguments: str) -> dict[str, str]:
    out = run("lint", *arguments, "--output-format", "json", "--exit-zero").out
    return {found["code"]: found["severity"] for found in json.loads(out)}


def test_the_file_decides_and_the_command_line_wins(tmp_path: Path) -> None:
    deck = tmp_path / "d.keyxm"
    deck.write_text(DECK, encoding="utf-8")
    assert severities(str(deck))["LEG001"] == "info"
    config = tmp_path / "mudline.toml"
    config.write_text('select = ["LEG"]\n[severity]\nLEG001 = "error"\n', encoding="utf-8")
    assert severities(str(deck)) == {"LEG001": "error"}
    assert severities(str(deck), "--isolated")["LEG001"] == "info"
    assert severities(str(deck), "--ignore", "LEG001") == {}
    config.write_text('[per-file-ignores]\n"*.keyxm" = ["LEG001"]\n', encoding="utf-8")
    assert "LEG001" not in severities(str(deck))
    config.write_text('[severity]\nLEG001 = "off"\n', encoding="utf-8")
    assert "LEG001" not in severities(str(deck))


def test_a_wrong_file_is_wrong_usage(tmp_path: Path) -> None:
    deck, config = tmp_path / "d.keyxm", tmp_path / "other.toml"
    deck.write_text(DECK, encoding="utf-8")
    config.write_text("selct = []\n", encoding="utf-8")
    outcome = run("lint", str(deck), "--config", str(config))
    assert outcome.code == 2
    assert "other.toml:1: unknown key 'selct': did you mean select?" in outcome.err
    assert run("lint", str(deck), "--config", str(tmp_path / "none.toml")).code == 2
    assert run("lint", str(deck), "--config", str(config), "--isolated").code == 2


def test_a_directory_search_includes_and_excludes(tmp_path: Path) -> None:
    for name in ("a.keyxm", "b.txt", "old/c.keyxm"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(DECK, encoding="utf-8")
    (tmp_path / "mudline.toml").write_text('include = ["*.txt"]\nexclude = ["/old"]\n', encoding="utf-8")
    found = json.loads(run("lint", str(tmp_path), "--output-format", "json", "--exit-zero").out)
    assert {Path(one["file"]).name for one in found} == {"a.keyxm", "b.txt"}


# ------------------------------------------- the same from any number of processes, from the cache, and with a baseline


ROWS = changed((" 0.0, 0.0\n 0.5, 20000.0\n", " 1, 0.0, 0.0\n 2, 0.1, 8000.0\n 3, 0.3, 15000.0\n 4, 0.5, 20000.0\n"))
STARLESS = changed(("*ELEMENT\n", "ELEMENT\n"))


def test_jobs_cache_and_baseline_agree(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(executors, "PAYS", dict.fromkeys(executors.PAYS, 0.0))
    monkeypatch.setenv(remembered.PLACE, str(folder / "cache"))
    for name, text in (("a", ROWS), ("b", STARLESS)):
        (folder / f"{name}.keyxm").write_text(text, encoding="utf-8")
    asked = ("lint", "a.keyxm", "b.keyxm", "-v")
    plain = run(*asked, "--no-cache")
    assert "and 3 more rows of this block" in plain.out
    assert plain.out.count("follows: ") == sum(map(len, map(_following, ("a", "b")))) > 0
    assert run(*asked, "--no-cache", "--jobs", "2").out == plain.out
    assert run(*asked).out == plain.out  # fills the cache
    assert run(*asked).out == plain.out
    run(*asked, "--baseline", "known.json", "--write-baseline")
    recorded = json.loads((folder / "known.json").read_text(encoding="utf-8"))
    assert recorded
    for more in ((), ("--jobs", "2"), ("--no-cache",)):
        assert run(*asked, "--baseline", "known.json", "--output-format", "json", *more).out == "[]\n"


def _following(name: str) -> list[Diagnostic]:
    data = Path(f"{name}.keyxm").read_bytes()
    return [each for one in lint_bytes(data, f"{name}.keyxm", rules()) for each in one.following]


# ------------------------------------------------------------------------- the same output from any number of processes


@pytest.fixture
def decks(place: Place, monkeypatch: pytest.MonkeyPatch) -> str:
    """Processes are used behind the first file, whatever there is to do."""
    monkeypatch.setattr(executors, "PAYS", dict.fromkeys(executors.PAYS, 0.0))
    monkeypatch.setattr(executors, "TRIED", 0.0)
    for i in range(60):
        place((CLEAN, BAD_NUMBER, UNSORTED)[i % 3], f"decks/{i:02}.keyxm")
    return "decks"


def test_output_is_the_same_whatever_the_number_of_processes(
    decks: str, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    words = (decks, "missing.keyxm", "--jobs")
    assert run("validate", *words, "2") == run("validate", *words, "1")
    alone = run("lint", *words, "1", "--no-cache")
    assert run("lint", *words, "2", "--no-cache") == alone
    assert multiprocessing.active_children() == []
    assert alone.out.startswith("decks/01.keyxm:6:11")
    monkeypatch.setenv("MUDLINE_CACHE_DIR", str(folder / "cache"))
    assert [run("lint", *words, "2") for _ in range(2)] == [alone] * 2
    assert len(list((folder / "cache").iterdir())) == 1


def test_fixing_stays_in_one_process(decks: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(executors, "_processes", None)
    assert "20 fixed" in run("lint", decks, "--fix", "--jobs", "2").out


def test_findings_of_one_rule_of_style_are_one_entry_in_text_alone(place: Place) -> None:
    name = place(CLEAN.replace("*NODE", "*node").replace("*ELEMENT\n", "*element\n").replace("$MODEL", "$model"))
    text = run("lint", name).out
    assert text.count("STY006") == 1
    assert "; 2 more in lines 4, 8 [keyword-case]" in text
    assert "Found 3 info" in text
    for words in (("-v",), ("--output-format", "concise")):
        assert run("lint", name, *words).out.count("STY006") == 3
