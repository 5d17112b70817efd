"""The cache of `mudline lint`: what it spares, and that it never tells what is not so."""

from __future__ import annotations

import copy
import json
import math
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from mudline.basics.outside import project_of
from mudline.checks.configuration import Configured
from mudline.checks.engine import LintSettings
from mudline.checks.fixing import lint_one
from mudline.checks.output import form_names
from mudline.checks.registry import rules
from mudline.checks.report import FileReport
from mudline.cli import lint_run
from mudline.cli.inputs import Input
from mudline.language.diagnostics import Coverage, Diagnostic, Severity
from mudline.tools.running import executors, remembered
from tests.checks.corpus import CORPUS
from tests.cli.conftest import Place
from tests.cli.runner import SAMPLES, Json, run
from tests.helpers.builders.decks import BAD_NUMBER, CLEAN, UNSORTED

Linted = list[str]


@pytest.fixture
def linted(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Linted:
    """The files that were really linted; the cache stands in the folder."""
    names: Linted = []

    def lint(name: str, data: bytes, settings: LintSettings, place: Path | None = None) -> FileReport:
        names.append(name)
        return lint_one(name, data, settings, place)

    monkeypatch.setenv(remembered.PLACE, str(folder / "cache"))
    monkeypatch.setattr(remembered, "_COARSE", 0.0)  # files of a test are as young as its runs
    monkeypatch.setattr(lint_run, "lint_one", lint)
    monkeypatch.setattr(executors, "TRIED", math.inf)  # never in other processes, however slow this one is
    return names


@pytest.mark.parametrize(
    "words", [["--ignore", "SYN"], ["--units", "imperial"], ["--dialect", "flexcom"], ["--no-cache"], ["--fix"]]
)
def test_other_settings_are_other_runs(place: Place, linted: Linted, words: list[str]) -> None:
    run("lint", place(BAD_NUMBER))
    run("lint", "deck.keyxm", *words)
    assert linted == ["deck.keyxm"] * 2


def test_a_base_of_a_configuration_counts(place: Place, linted: Linted) -> None:
    place("extend = 'base.toml'\n", "mudline.toml")
    place("fail-on = 'error'\n", "base.toml")
    assert run("lint", place(UNSORTED)).code == 0
    place("severity = { CRV002 = 'error' }\n", "base.toml")
    assert run("lint", "deck.keyxm").code == 1
    assert len(linted) == 2


def test_changed_content_is_linted_again_though_size_and_time_stay(place: Place, linted: Linted) -> None:
    run("lint", place(CLEAN))
    assert run("lint", place(CLEAN.replace("10.0\n", "1x.0\n"))).code == 1
    assert len(linted) == 2


# ------------------------------------------------------------------------------------------------ what a deck names

RESTART = "$LOAD CASE\n*RESTART\n LAST=static\n*TIME\n STEP=FIXED\n 0.0, 120.0, 0.05\n"


def test_a_deck_is_linted_again_when_a_file_that_it_lacked_is_there(folder: Path, place: Place, linted: Linted) -> None:
    (folder / "cache").mkdir()
    words = ("lint", place(RESTART, "wave.keyxm"), "--output-format", "concise")
    first = run(*words)
    assert "REF015" in first.out
    assert run(*words) == first
    assert len(linted) == 1
    place(name="STATIC.keyxm")
    assert "REF015" not in run(*words).out
    assert len(linted) == 2


def test_a_deck_is_linted_again_when_a_file_that_it_names_has_changed_or_gone(
    folder: Path, place: Place, linted: Linted
) -> None:
    place(name="static.keyxm")
    words = ("lint", place(RESTART, "wave.keyxm"))
    assert run(*words) == run(*words)
    assert len(linted) == 1
    place("C nothing\n", "static.keyxm")
    assert run(*words).code == 1
    assert run(*words).code == 1
    assert len(linted) == 2
    (folder / "static.keyxm").unlink()
    assert "REF015" in run(*words, "--output-format", "concise").out
    assert len(linted) == 3


# -------------------------------------------------------------------------------------------- decks without findings


LIBRARIES = """
import sys
from mudline.__main__ import main
from mudline.tools.running import remembered

remembered._COARSE = 0.0
print(main(["lint", *sys.argv[1:]]), sorted({"lark", "numpy", "pydantic", "rich"} & sys.modules.keys()))
"""


def twice(folder: Path, *words: str) -> list[str]:
    """What two runs print, each in a process of its own; the last line is the exit code and the libraries."""
    command = [sys.executable, "-c", LIBRARIES, *words]
    environment = {**os.environ, remembered.PLACE: str(folder / "cache")}
    return [
        subprocess.run(command, env=environment, capture_output=True, text=True, check=True).stdout for _ in range(2)
    ]


# ----------------------------------------------------------------------------------------------- remembered findings


@pytest.mark.parametrize("form", ["text", "json", "markdown"])
def test_findings_are_printed_again_without_what_found_them(folder: Path, place: Place, form: str) -> None:
    first, second = twice(folder, place(BAD_NUMBER), place(name="b.keyxm"), "--output-format", form)
    assert "SYN002" in first
    assert first.endswith("1 ['lark', 'numpy', 'pydantic']\n")
    assert second == first.replace("1 ['lark', 'numpy', 'pydantic']\n", "1 []\n")


def test_all_faulty_decks_are_the_same_from_the_cache_in_every_form(folder: Path, linted: Linted) -> None:
    forms = [word for name in form_names() for word in ("--output-format", f"{name}={folder / name}")]
    command: list[str | Path] = ["lint", SAMPLES, CORPUS, *forms]
    first = run(*command)
    files = {name: (folder / name).read_bytes() for name in form_names()}
    assert len(linted) > 100
    linted.clear()
    assert run(*command) == first
    assert {name: (folder / name).read_bytes() for name in form_names()} == files
    assert not linted


@pytest.mark.parametrize("words", [["-v"], ["-q"], ["--statistics"], ["--color", "always"]])
def test_findings_are_the_same_from_the_cache_in_every_view(linted: Linted, words: list[str]) -> None:
    command: list[str | Path] = ["lint", SAMPLES / "broken.keyxm", SAMPLES / "legacy-flowline.keyxm", *words]
    first = run(*command)
    assert len(linted) == 2
    assert run(*command) == first
    assert len(linted) == 2


def test_a_run_on_remembered_findings_fails_as_the_first(place: Place, linted: Linted) -> None:
    del linted
    name = place(UNSORTED)  # an info
    words = [[], ["--fail-on", "info"], ["--fail-on", "info", "--exit-zero"]]
    assert [run("lint", name, *each).code for each in (*words, *words)] == [0, 1, 0, 0, 1, 0]
    place("fail-on = 'info'\n", "mudline.toml")
    assert [run("lint", name).code for _ in range(2)] == [1, 1]
    assert run("lint", name, "missing.keyxm").code == 2


def test_standard_input_asks_nothing(folder: Path, linted: Linted) -> None:
    run("lint", "-", stdin=CLEAN.encode())
    assert linted
    assert not (folder / "cache").exists()


def test_a_file_that_is_missing_is_reported_beside_known_ones(place: Place, linted: Linted) -> None:
    words = ("lint", place(), "missing.keyxm")
    first = run(*words)
    assert first.code == 2
    assert run(*words) == first
    assert len(linted) == 1


def test_findings_come_back_whole(tmp_path: Path, linted: Linted) -> None:
    follows = Diagnostic("a", "REF006", "undefined-node", Severity.WARNING, "m", 2, 1, 2, 2)
    cause = Diagnostic("a", "SYN009", "unknown-keyword", Severity.ERROR, "m", 1, 1, 1, 2, None, True, (follows,))
    found = (*lint_one("a", UNSORTED.encode() + BAD_NUMBER.encode(), LintSettings(rules())).found, cause)
    assert any(one.fix for one in found)
    memory = remembered.Memory(tmp_path / "memory")
    key = lint_run.key_of(memory, Configured(None, True), Input("a", "a"), b"")
    report = FileReport("a", found, coverage=Coverage(3, 1, {"NODE": 1}, {"A\x1b": 1}))
    lint_run.remember(memory, key, report)
    assert lint_run.remembered(memory.get(key), "a") == report
    assert not linted


# ----------------------------------------------------------------------------------- entries that others have written


def leaves(value: Json, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """The paths of all values in what JSON holds, those of lists and objects too."""
    yield path
    for key, one in value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ():
        yield from leaves(one, (*path, key))


def put(value: Json, path: tuple[Any, ...], new: Json) -> Json:
    if not path:
        return new
    twin = copy.copy(value)
    twin[path[0]] = put(value[path[0]], path[1:], new)
    return twin


FORGED: list[Any] = ["x", None, [], True, 7, {}, -1, [[]], 1.5, {"x": []}]


def test_a_forged_entry_is_used_or_not_but_never_ends_the_run(place: Place) -> None:
    """Results lie in a folder that others may write into."""
    words = ["batch", place(UNSORTED), "-o", "out", "--form", "json", "--jobs", "1", "-q"]
    first = run(*words)
    file = Path("out/.mudline-batch")
    key, _, held = file.read_bytes().partition(b"\n")[2].decode().strip().partition(" ")
    entry = json.loads(held)
    for number, path in enumerate(leaves(entry)):
        body = f"{key} {json.dumps(put(entry, path, FORGED[number % len(FORGED)]))}\n".encode()
        file.write_bytes(remembered._head(body) + b"\n" + body)
        outcome = run(*words)
        assert outcome.code in {0, 1}, (path, outcome.err)
        assert "Traceback" not in outcome.err
    file.write_bytes(b"")
    assert run(*words) == first


def test_entries_of_another_user_are_not_read(place: Place, linted: Linted, monkeypatch: pytest.MonkeyPatch) -> None:
    run("lint", place())
    run("lint", "deck.keyxm")
    assert len(linted) == 1
    monkeypatch.setattr(os, "getuid", lambda: 12345, raising=False)
    run("lint", "deck.keyxm")
    assert len(linted) == 2


def test_another_project_is_another_run(place: Place, folder: Path, linted: Linted) -> None:
    """A file beside the folder of the deck is outside once the repository above both is gone."""
    (folder / "work" / ".git").mkdir(parents=True)
    place("0.0, 0.0\n", "work/other/named.csv")
    name = place(CLEAN + "*SEABED PROFILE\n FILE=../other/named.csv\n", "work/decks/deck.keyxm")
    words = ("lint", name, "--no-outside", "--output-format", "concise")
    assert "outside of the project" not in run(*words).out
    (folder / "work" / ".git").rmdir()
    project_of.cache_clear()
    assert "outside of the project" in run(*words).out
    assert len(linted) == 2
