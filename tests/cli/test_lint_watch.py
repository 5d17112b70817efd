"""`mudline lint --watch`."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator, Sequence
from itertools import count
from pathlib import Path
from types import SimpleNamespace

import pytest

import mudline
from mudline.cli import lint_command
from tests.cli.conftest import Place
from tests.cli.runner import Outcome, run
from tests.helpers.builders.decks import BAD_NUMBER, CLEAN

Steps = list[tuple[str, str | None]]

IN_JSON = mudline.from_keyword(CLEAN, units="metric").to_json()

LOOKS = 5000
"""More than any test needs: who looks so often waits for a change that will not be seen."""


@pytest.fixture(autouse=True)
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    looks = count(1)

    def sleep(seconds: float) -> None:
        if next(looks) > LOOKS:
            pytest.fail("a change was not seen")
        time.sleep(min(seconds, 0.01))

    clock = SimpleNamespace(perf_counter=time.perf_counter, strftime=time.strftime, sleep=sleep)
    monkeypatch.setattr(lint_command, "time", clock)


def watch(folder: Path, steps: Steps, *words: str, terminal: bool = False) -> Outcome:
    """Run with one change of a file at each wait (None: it is removed), and Ctrl-C at the end."""
    left: Iterator[tuple[str, str | None]] = iter(steps)

    def wait(paths: Sequence[str], before: lint_command.State) -> None:
        assert lint_command.state(paths) == before
        name, text = next(left, ("", ""))
        if not name:
            raise KeyboardInterrupt
        path = folder / name
        if text is None:
            path.unlink()
        else:
            path.write_text(text, encoding="utf-8")
        real(paths, before)

    real = lint_command.wait_for_change
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(lint_command, "wait_for_change", wait)
        return run("lint", *words, "--watch", terminal=terminal)


def test_changed_new_and_removed_decks(folder: Path, place: Place) -> None:
    place(name="decks/a.keyxm")
    outcome = watch(
        folder,
        [("decks/a.keyxm", BAD_NUMBER), ("decks/b.keyxm", CLEAN), ("decks/a.keyxm", None)],
        "decks",
        "--output-format",
        "text",
    )
    assert outcome.code == 130
    ends = [line for line in outcome.out.splitlines() if line.startswith(("No", "Found"))]
    assert ends == [
        "No findings in 1 file.",
        "Found 1 error in 1 file.",
        "Found 1 error in 2 files.",
        "No findings in 1 file.",
    ]
    assert outcome.err.count("waiting for changes") == 4
    assert "\x1b" not in outcome.out


def test_wrong_configuration_is_told_and_waited_out(folder: Path, place: Place) -> None:
    place()
    steps: Steps = [("mudline.toml", "select = 3\n"), ("mudline.toml", "select = ['SYN']\n")]
    outcome = watch(folder, steps, "deck.keyxm", "-q")
    assert outcome.code == 130
    assert outcome.err.count("mudline.toml") == 1
    assert "waiting" not in outcome.err


def test_deck_beside_the_one_watched(folder: Path, place: Place) -> None:
    outcome = watch(folder, [("base.keyxm", CLEAN), ("base.json", IN_JSON)], place())
    assert outcome.out.count("No findings in 1 file.") == 3


def test_decks_in_json_also_in_a_new_folder(folder: Path, place: Place) -> None:
    place(IN_JSON, "decks/a.json")
    (folder / "decks" / "more").mkdir()
    steps: Steps = [("decks/a.json", f"{IN_JSON}\n"), ("decks/more/b.json", IN_JSON), ("decks/a.json", None)]
    outcome = watch(folder, steps, "decks")
    assert [line for line in outcome.out.splitlines() if line.startswith("No")] == [
        "No findings in 1 file.",
        "No findings in 1 file.",
        "No findings in 2 files.",
        "No findings in 1 file.",
    ]


def test_change_is_seen_while_waiting(folder: Path, place: Place) -> None:
    files = (place(), "nowhere/deck.keyxm", "\0")
    before = lint_command.state(files)
    threading.Timer(0.1, lambda: place(BAD_NUMBER)).start()
    lint_command.wait_for_change(files, before)
    assert lint_command.state(files) != before
    assert (folder / "deck.keyxm").exists()
