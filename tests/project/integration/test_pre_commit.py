"""The hooks of pre-commit: run by it in a repository of its own, on mudline as it is here."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from tests.helpers.processes import TIMEOUT
from tests.project.integration.recipes import CLEAN, FAULTY, ROOT, SOURCE

HOOKS = {hook["id"]: hook for hook in yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text(encoding="utf-8"))}
PRE_COMMIT = [sys.executable, "-m", "pre_commit"]


@pytest.fixture
def repository(tmp_path: Path) -> Path:
    """A repository whose hooks are ours, run by this Python instead of one that pre-commit installs."""
    entry = f"{sys.executable} -m mudline"
    hooks = [
        {**hook, "language": "system", "entry": hook["entry"].replace("mudline", entry, 1)} for hook in HOOKS.values()
    ]
    folder = tmp_path / "repository"
    folder.mkdir()
    config = {"repos": [{"repo": "local", "hooks": hooks}]}
    (folder / ".pre-commit-config.yaml").write_text(yaml.safe_dump(config))
    subprocess.run(["git", "init", "-q", str(folder)], timeout=TIMEOUT, check=True)  # noqa: S607 - the git of the path
    return folder


def run(folder: Path, hook: str, **files: str) -> subprocess.CompletedProcess[str]:
    """Add files, and run one hook over all that is added."""
    for name, text in files.items():
        (folder / name.replace("__", ".")).write_text(text)
    subprocess.run(["git", "add", "-A"], cwd=folder, timeout=TIMEOUT, check=True)  # noqa: S607 - the git of the path
    env = {**os.environ, "PYTHONPATH": str(SOURCE), "PRE_COMMIT_HOME": str(folder.parent / "home")}
    command = [*PRE_COMMIT, "run", hook, "--all-files", "--color", "never"]
    return subprocess.run(command, cwd=folder, env=env, capture_output=True, text=True, check=False, timeout=60)


@pytest.mark.parametrize("hook", HOOKS.values(), ids=HOOKS)
def test_a_hook_takes_the_files_of_decks(hook: dict[str, str]) -> None:
    taken = [name for name in ("a.keyx", "a.keyxm", "b/a.keyxi", "a.das") if re.search(hook["files"], name)]
    assert len(taken) == 4
    assert not any(re.search(hook["files"], name) for name in ("a.keyxm.bak", "a.txt", "keyxm", "a.keyxx"))


def test_there_are_hooks_to_lint_and_to_format() -> None:
    assert sorted(HOOKS) == ["mudline-format", "mudline-lint"]


@pytest.mark.nightly
def test_format_rewrites_a_deck_and_then_passes(repository: Path) -> None:
    first = run(repository, "mudline-format", deck__keyxm=CLEAN.replace("*OCEAN\n ", "*ocean\n    "))
    assert (first.returncode, "files were modified" in first.stdout) == (1, True), first.stdout + first.stderr
    assert run(repository, "mudline-format").returncode == 0
    assert "*OCEAN\n" in (repository / "deck.keyxm").read_text()


def test_a_commit_is_held_up_by_a_finding_and_by_a_layout(repository: Path) -> None:
    """The hooks as git runs them, over the files that are staged; what was committed before is let be."""
    (repository / "old.keyxm").write_text(FAULTY)
    env = {**os.environ, "PYTHONPATH": str(SOURCE), "PRE_COMMIT_HOME": str(repository.parent / "home")}
    name = ["-c", "user.name=A", "-c", "user.email=a@b.example"]

    def git(*words: str) -> subprocess.CompletedProcess[str]:
        command = ["git", *name, *words]
        return subprocess.run(
            command, cwd=repository, env=env, capture_output=True, text=True, timeout=TIMEOUT, check=False
        )

    assert git("add", "-A").returncode == 0
    assert git("commit", "-q", "-m", "before the hooks").returncode == 0
    subprocess.run([*PRE_COMMIT, "install"], cwd=repository, env=env, capture_output=True, timeout=TIMEOUT, check=True)
    deck = repository / "a new#1.keyxm"
    deck.write_text(FAULTY)
    git("add", deck.name)
    held = git("commit", "-m", "a fault")
    assert held.returncode == 1
    assert f"{deck.name}:3:9: error SYN002" in held.stdout + held.stderr
    assert "old.keyxm" not in held.stdout + held.stderr
    deck.write_text(CLEAN)
    git("add", deck.name)
    assert git("commit", "-m", "mended").returncode == 0
