"""The GitHub action: its scripts run by hand, with the inputs as the variables that it sets."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

import mudline

ROOT = Path(__file__).parents[2]
SOURCE = Path(mudline.__file__).parents[1]
CLEAN = "$MODEL\n*OCEAN\n 100.0, 1025.0, 9.81\n"
FAULTY = "$MODEL\n*OCEAN\n 100.0, l025.0, 9.81\n"
ACTION = yaml.safe_load((ROOT / "action.yml").read_text(encoding="utf-8"))


def script(name: str, folder: Path, **given: str) -> subprocess.CompletedProcess[str]:
    env = {**os.environ, "PYTHONPATH": str(SOURCE), "MUDLINE_PYTHON": sys.executable, **given}
    command = ["bash", str(ROOT / ".github" / name)]  # bash is what the action runs in
    return subprocess.run(command, cwd=folder, env=env, capture_output=True, text=True, check=False, timeout=60)


@pytest.fixture
def decks(tmp_path: Path) -> Path:
    (tmp_path / "good").mkdir()
    (tmp_path / "good" / "deck.keyxm").write_text(CLEAN)
    (tmp_path / "bad.keyxm").write_text(FAULTY)
    return tmp_path


def test_clean_decks_pass(decks: Path) -> None:
    done = script("lint.sh", decks, MUDLINE_PATHS="good", MUDLINE_FORMAT="concise")
    assert (done.returncode, done.stdout) == (0, "")


def test_a_faulty_deck_fails_the_step(decks: Path) -> None:
    done = script("lint.sh", decks, MUDLINE_PATHS="good\nbad.keyxm", MUDLINE_FORMAT="concise")
    assert done.returncode == 1
    assert done.stdout.startswith("bad.keyxm:3:9: SYN002 ")


def test_findings_are_annotations_unless_asked_otherwise(decks: Path) -> None:
    done = script("lint.sh", decks)
    assert done.returncode == 1
    assert done.stdout.startswith("::error ")


def test_more_options_reach_mudline(decks: Path) -> None:
    done = script("lint.sh", decks, MUDLINE_ARGS="--exit-zero --select SYN", MUDLINE_FORMAT="concise")
    assert (done.returncode, done.stdout.count("\n")) == (0, 1)


@pytest.mark.parametrize("name", ["MUDLINE_PATHS", "MUDLINE_ARGS", "MUDLINE_FORMAT"])
def test_an_input_is_never_run(decks: Path, name: str) -> None:
    done = script("lint.sh", decks, **{name: "$(touch run);`touch run`;touch run"})
    assert done.returncode == 2
    assert not (decks / "run").exists()


def test_what_is_installed(tmp_path: Path) -> None:
    """Seen through a Python that only tells what it is asked to do."""
    python = tmp_path / "python"
    python.write_text('#!/bin/sh\necho "$@"\n')
    python.chmod(0o755)
    given = {"MUDLINE_PYTHON": str(python), "GITHUB_ACTION_PATH": "/the/action"}
    install = "-m pip install --quiet --disable-pip-version-check"
    assert script("install.sh", tmp_path, **given).stdout == f"{install} /the/action\n"
    assert script("install.sh", tmp_path, **given, MUDLINE_VERSION="1.2.0").stdout == f"{install} mudline==1.2.0\n"


def test_every_input_reaches_a_step() -> None:
    steps = ACTION["runs"]["steps"]
    used = str(steps)
    assert all(f"inputs.{name}" in used for name in ACTION["inputs"])
    assert not any("${{" in step.get("run", "") for step in steps)
    assert all((ROOT / ".github" / f"{name}.sh").is_file() for name in ("install", "lint"))
