"""`mudline lint --jobs` and `validate --jobs`: the same output from any number of processes."""

from __future__ import annotations

import multiprocessing
import os
import subprocess
import sys
from pathlib import Path

import pytest

from mudline.running import executors
from tests.builders.decks import BAD_NUMBER, CLEAN, UNSORTED
from tests.cli.conftest import Place
from tests.cli.runner import run
from tests.processes import TIMEOUT


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


COPIES = """
import sys
from mudline.__main__ import main

sys.argv[0] = "mudline"
from mudline.running import executors

executors.PAYS, executors.TRIED = dict.fromkeys(executors.PAYS, 0.0), 0.0
start_method, used = executors.start_method, []
executors.start_method = lambda: used.append(start_method()) or used[-1]
code = main(sys.argv[1:])
print(*set(used), code, file=sys.stderr)
"""


def test_copies_of_a_process_without_threads_say_the_same(decks: str) -> None:
    alone = run("lint", decks, "--jobs", "1", "--no-cache")
    words = [sys.executable, "-c", COPIES, "lint", decks, "--jobs", "2", "--no-cache"]
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}
    done = subprocess.run(words, env=environment, capture_output=True, text=True, timeout=TIMEOUT, check=True)
    assert done.stdout == alone.out
    assert done.stderr in ("fork 1\n", "forkserver 1\n", "spawn 1\n")
    assert done.stderr.startswith("fork ") or not sys.platform.startswith("linux")


def test_run_that_ends_early_ends_its_processes(decks: str, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupt(*_: object) -> None:
        if multiprocessing.active_children():
            raise KeyboardInterrupt

    monkeypatch.setattr("mudline.cli.lint_report.Report.add", interrupt)
    assert run("lint", decks, "--jobs", "2", "--no-cache").code == 130
    assert multiprocessing.active_children() == []


def test_fixing_stays_in_one_process(decks: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(executors, "_processes", None)
    assert "20 fixed" in run("lint", decks, "--fix", "--jobs", "2").out


def test_number_that_is_none(place: Place) -> None:
    assert run("lint", place(), "--jobs", "-1").code == 2
