"""The GitHub action: its scripts run by hand, with the inputs as the variables that it sets."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import yaml

from tests.integration.recipes import BASH, ROOT

ACTION = yaml.safe_load((ROOT / "action.yml").read_text(encoding="utf-8"))


def script(name: str, folder: Path, **given: str) -> subprocess.CompletedProcess[str]:
    env = {**os.environ, "MUDLINE_PYTHON": str(telling(folder)), **given}
    command = [BASH, str(ROOT / ".github" / name)]  # bash is what the action runs in
    return subprocess.run(command, cwd=folder, env=env, capture_output=True, text=True, check=False, timeout=60)


def telling(folder: Path) -> Path:
    """A Python that only tells what it is asked to do."""
    python = folder / "python"
    python.write_text('#!/bin/sh\necho "$@"\n')
    python.chmod(0o755)
    return python


def test_an_input_is_never_run(tmp_path: Path) -> None:
    bad = "$(touch run);`touch run`;touch run *"
    given = dict.fromkeys(("MUDLINE_PATHS", "MUDLINE_ARGS", "MUDLINE_FORMAT"), bad)
    (tmp_path / "deck.keyxm").write_text("")
    done = script("lint.sh", tmp_path, **given)
    assert done.stdout == f"-m mudline lint --output-format {bad} {bad} -- {bad}\n"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["deck.keyxm", "python"]


def test_nothing_given_is_the_whole_checkout_as_annotations(tmp_path: Path) -> None:
    done = script("lint.sh", tmp_path)
    assert done.stdout == "-m mudline lint --output-format github -- .\n"


def test_what_is_installed(tmp_path: Path) -> None:
    given = {"GITHUB_ACTION_PATH": "/the/action"}
    install = "-m pip install --quiet --disable-pip-version-check"
    assert script("install.sh", tmp_path, **given).stdout == f"{install} /the/action\n"
    assert script("install.sh", tmp_path, **given, MUDLINE_VERSION="1.2.0").stdout == f"{install} mudline==1.2.0\n"


def test_every_input_reaches_a_step() -> None:
    steps = ACTION["runs"]["steps"]
    used = str(steps)
    assert all(f"inputs.{name}" in used for name in ACTION["inputs"])
    assert not any("${{" in step.get("run", "") for step in steps)
    assert all((ROOT / ".github" / f"{name}.sh").is_file() for name in ("install", "lint"))
