"""Completion in a bash that a user types into."""

from __future__ import annotations

import os
import pty
import select
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.helpers.processes import TIMEOUT, end
from tests.project.integration.recipes import BASH, ROOT, SOURCE, checkout

SOURCED = 'eval "$(_MUDLINE_COMPLETE=bash_source mudline)"'


class Terminal:
    """An interactive bash at the other end of a terminal."""

    def __init__(self, folder: Path) -> None:
        self.end, inner = pty.openpty()
        path = f"{folder.parent / 'programs'}{os.pathsep}{os.environ['PATH']}"
        env = {"PATH": path, "PYTHONPATH": str(SOURCE), "PS1": "> ", "TERM": "dumb", "HOME": str(folder)}
        command = [BASH, "--noprofile", "--norc", "-i"]
        self.bash = subprocess.Popen(
            command, cwd=folder, env=env, stdin=inner, stdout=inner, stderr=inner, start_new_session=True
        )
        os.close(inner)

    def type(self, keys: str, until: str) -> str:
        """Type keys; returns what the terminal shows from then until a text has come."""
        os.write(self.end, keys.encode())
        shown = ""
        last = time.monotonic() + TIMEOUT
        while until not in shown:
            ready, _, _ = select.select([self.end], [], [], max(0.0, last - time.monotonic()))
            assert ready, f"{keys!r} gave {shown!r}"
            shown += os.read(self.end, 4096).decode()
        return shown

    def close(self) -> None:
        end(self.bash)
        os.close(self.end)


@pytest.fixture
def terminal(tmp_path: Path) -> Iterator[Terminal]:
    opened = Terminal(checkout(tmp_path))
    try:
        opened.type("bind 'set enable-bracketed-paste off'; PS1='ready> '\n", "\nready> ")
        opened.type(f"{SOURCED}; echo so''urced\n", "sourced\r\nready> ")
        yield opened
    finally:
        opened.close()


def test_tab_completes_commands_options_words_and_paths(terminal: Terminal) -> None:
    assert terminal.type("mudline li\t", "lint ").endswith("mudline lint ")
    assert terminal.type("--fail-on w\t", "warning ").endswith("--fail-on warning ")
    assert terminal.type("--stat\t", "--statistics ").endswith("--statistics ")
    assert terminal.type("decks/b\t", "bad.keyxm ").endswith("decks/bad.keyxm ")
    assert "     1  SYN002  bad-number\r\n" in terminal.type("\n", "ready> ")


def test_the_lines_of_the_page_are_those_that_are_tried() -> None:
    page = (ROOT / "docs" / "ci.md").read_text(encoding="utf-8")
    assert f"`{SOURCED}`" in page
    assert "_MUDLINE_COMPLETE=zsh_source mudline" in page
    assert "_MUDLINE_COMPLETE=fish_source mudline" in page
