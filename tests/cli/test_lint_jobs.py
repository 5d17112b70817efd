"""`mudline lint --jobs`: the same output from any number of processes."""

from __future__ import annotations

import multiprocessing
import os
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest

from mudline.cli import lint_run, processes
from mudline.cli.inputs import Input
from mudline.linting.engine import LintSettings
from mudline.linting.fixing import FileReport
from mudline.linting.registry import rules
from tests.builders.decks import BAD_NUMBER, CLEAN, UNSORTED
from tests.cli.conftest import Place
from tests.cli.runner import run
from tests.processes import TIMEOUT


@pytest.fixture
def eager(monkeypatch: pytest.MonkeyPatch) -> None:
    """Processes are used behind the first file, whatever there is to do."""
    monkeypatch.setattr(processes, "PAYS", dict.fromkeys(processes.PAYS, 0.0))
    monkeypatch.setattr(lint_run, "TRIED", 0.0)


@pytest.fixture
def decks(place: Place) -> str:
    for i in range(60):
        place((CLEAN, BAD_NUMBER, UNSORTED)[i % 3], f"decks/{i:02}.keyxm")
    return "decks"


@pytest.mark.usefixtures("eager")
def test_output_is_the_same_whatever_the_number_of_processes(decks: str, folder: Path) -> None:
    alone = run("lint", decks, "--jobs", "1", "--no-cache")
    assert run("lint", decks, "--jobs", "2", "--no-cache") == alone
    assert multiprocessing.active_children() == []
    assert alone.out.startswith("decks/01.keyxm:6:11")
    cache = {"MUDLINE_CACHE_DIR": str(folder / "cache")}
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(*next(iter(cache.items())))
        assert [run("lint", decks, "--jobs", "2") for _ in range(2)] == [alone] * 2
    assert len(list((folder / "cache").iterdir())) == 1


COPIES = """
import sys
from mudline.__main__ import main

sys.argv[0] = "mudline"
from mudline.cli import lint_run, processes

processes.PAYS, lint_run.TRIED = dict.fromkeys(processes.PAYS, 0.0), 0.0
start_method, used = processes.start_method, []
processes.start_method = lambda: used.append(start_method()) or used[-1]
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


@pytest.mark.parametrize(("platform", "method"), [("win32", "spawn"), ("darwin", "spawn"), ("freebsd", "forkserver")])
def test_systems_start_processes_in_their_own_way(monkeypatch: pytest.MonkeyPatch, platform: str, method: str) -> None:
    def listdir(_: str) -> list[str]:
        raise FileNotFoundError

    monkeypatch.setattr("sys.platform", platform)
    monkeypatch.setattr(os, "listdir", listdir)
    assert processes.start_method() == method


def test_a_process_with_threads_is_not_copied(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.platform", "linux")
    monkeypatch.setattr(os, "listdir", lambda _: ["1", "2"])
    assert processes.start_method() == "forkserver"


@pytest.mark.usefixtures("eager")
def test_known_decks_do_not_count_as_work_that_was_done(
    decks: str, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("MUDLINE_CACHE_DIR", str(folder / "cache"))
    first = run("lint", decks, "--jobs", "1")
    for name in ("57", "58", "59"):  # behind 57 decks that are known
        path = folder / decks / f"{name}.keyxm"
        path.write_text(path.read_text(encoding="utf-8") + "C\n", encoding="utf-8")
    estimates: list[float] = []
    monkeypatch.setattr(lint_run, "pays", lambda estimate, _: estimates.append(estimate))
    assert run("lint", decks).code == first.code
    assert len(estimates) == 3
    assert estimates[0] > 0.0


def end(orders: Sequence[object]) -> list[FileReport]:
    """A worker that dies."""
    os._exit(len(orders))


@pytest.mark.usefixtures("eager")
def test_process_that_dies_is_told(decks: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lint_run, "lint_orders", end)
    outcome = run("lint", decks, "--jobs", "2", "--no-cache", "-q")
    assert outcome.code == 2
    assert "a process that linted decks has ended early" in outcome.err
    assert "Traceback" not in outcome.err
    assert multiprocessing.active_children() == []


@pytest.mark.usefixtures("eager")
def test_run_that_ends_early_ends_its_processes(decks: str, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupt(*_: object) -> None:
        if multiprocessing.active_children():
            raise KeyboardInterrupt

    monkeypatch.setattr("mudline.cli.lint_run.Run._take", interrupt)
    assert run("lint", decks, "--jobs", "2", "--no-cache").code == 130
    assert multiprocessing.active_children() == []


@pytest.mark.usefixtures("eager")
def test_fixing_stays_in_one_process(decks: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lint_run, "pool", None)
    assert "20 fixed" in run("lint", decks, "--fix", "--jobs", "2").out


def test_small_runs_stay_in_one_process(decks: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lint_run, "pool", None)
    monkeypatch.setattr(processes, "PAYS", dict.fromkeys(processes.PAYS, float("inf")))
    assert run("lint", decks, "--jobs", "2", "--no-cache").code == 1


def test_workers_do_what_is_done_here(place: Place) -> None:
    name = place(BAD_NUMBER)
    one = lint_run.Task(Input(name, name), BAD_NUMBER.encode(), LintSettings(rules()))
    order, codes = lint_run.order_of(one, {})
    assert order.settings.rules == ()
    assert lint_run.lint_orders([(order, codes)]) == [one.lint()]


def test_number_of_processes() -> None:
    assert processes.Effort(3).processes == 3
    assert 1 <= processes.Effort().processes <= (os.cpu_count() or 1)


def test_number_that_is_none(place: Place) -> None:
    assert run("lint", place(), "--jobs", "-1").code == 2
