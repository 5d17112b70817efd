"""The settings of docs/diff.md that make git compare decks, in a real repository."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.cli.runner import ROOT
from tests.helpers.builders.decks import BAD_NUMBER, CLEAN
from tests.helpers.processes import TIMEOUT

pytestmark = [
    pytest.mark.skipif(shutil.which("git") is None, reason="git is missing"),
    pytest.mark.skipif(os.name != "posix", reason="the settings are lines for a POSIX shell"),
]

LINES: list[str] = re.findall(r"^git .*$", (ROOT / "docs/diff.md").read_text(encoding="utf-8"), re.MULTILINE)


class Repository:
    """A repository with decks, and this mudline on the path."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder / "repository"
        self.folder.mkdir()
        programs = folder / "bin"
        programs.mkdir()
        program = programs / "mudline"
        program.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m mudline "$@"\n', encoding="utf-8")
        program.chmod(0o755)
        self.env = {
            **os.environ,
            "HOME": str(folder),
            "XDG_CONFIG_HOME": str(folder / "none"),
            "GIT_CONFIG_NOSYSTEM": "1",
            "GIT_PAGER": "cat",
            "PATH": f"{programs}{os.pathsep}{os.environ['PATH']}",
            **{f"GIT_{who}_{what}": "a@b" for who in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")},
        }
        self.sh("git init -q -b main .")

    def put(self, name: str, text: str) -> None:
        (self.folder / name).write_text(text, encoding="utf-8")

    def commit(self) -> None:
        self.sh("git add . && git commit -q -m decks")

    def sh(self, line: str) -> str:
        ran = subprocess.run(
            ["/bin/sh", "-c", line],
            cwd=self.folder,
            env=self.env,
            capture_output=True,
            text=True,
            timeout=TIMEOUT,
            check=False,
        )
        assert ran.returncode == 0, ran.stderr
        return str(ran.stdout)


@pytest.fixture
def repository(tmp_path: Path) -> Repository:
    made = Repository(tmp_path)
    made.put("deck.keyxm", CLEAN)
    made.put("broken.keyxm", BAD_NUMBER)
    made.commit()
    made.put("deck.keyxm", CLEAN.replace("0.1, 1000.0", "1e-1,   1200.0"))
    return made


def line_with(word: str) -> str:
    """The line of the page that has a word."""
    (found,) = (line for line in LINES if word in line)
    return found


def test_difftool(repository: Repository) -> None:
    repository.sh(line_with("difftool.mudline.cmd"))
    shown = repository.sh(line_with("git difftool"))
    assert "curves\n  ~ Clay/0.1: 1000.0 -> 1200.0  (line -25 +25)\n1 difference\n" in shown
    repository.put("new.keyxm", CLEAN)
    repository.sh("git add new.keyxm")
    assert repository.sh("git difftool -d -t mudline main").endswith("2 decks: 1 changed, 1 added\n")


def test_textconv(repository: Repository) -> None:
    repository.sh(line_with("textconv"))
    repository.put(".gitattributes", "*.keyx* diff=mudline\n")
    changed = [line for line in repository.sh("git diff -- deck.keyxm").splitlines() if re.match(r"[-+] ", line)]
    assert [line[1:].strip() for line in changed] == ["- [0.1, 1000.0]", "- [0.1, 1200.0]"]
    repository.put("broken.keyxm", BAD_NUMBER.replace("C ", "C  ") + "C the end\n")
    assert "+C the end\n" in repository.sh("git diff -- broken.keyxm")
