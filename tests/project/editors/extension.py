"""The extension for VS Code, and what its tests need."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest

from tests.cli.runner import ROOT
from tests.helpers.processes import TIMEOUT

EXTENSION = ROOT / "editors" / "vscode"

needs_node = pytest.mark.skipif(
    shutil.which("node") is None or not (EXTENSION / "node_modules" / "vscode-textmate").is_dir(),
    reason="node, or editors/vscode/node_modules, is missing: npm install --prefix editors/vscode",
)


def node(*words: str | Path, **env: str) -> str:
    """Run a program of the extension; returns what it printed."""
    ran = subprocess.run(
        list(map(str, words)),
        cwd=EXTENSION,
        env={**os.environ, "NO_UPDATE_NOTIFIER": "1", **env},
        capture_output=True,
        text=True,
        timeout=TIMEOUT,
        check=False,
    )
    assert ran.returncode == 0, ran.stdout + ran.stderr
    return ran.stdout
