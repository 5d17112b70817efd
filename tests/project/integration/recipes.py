"""Recipes of pipelines, run as the servers run them; `python`, `pip` and `mudline` stand in for installed ones."""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import mudline

ROOT = Path(__file__).parents[3]
SOURCE = Path(mudline.__file__).parents[1]
BASH = shutil.which("bash") or "bash"
CLEAN = "$MODEL\n*OCEAN\n 100.0, 1025.0, 9.81\n"
FAULTY = "$MODEL\n*OCEAN\n 100.0, l025.0, 9.81\n"

_PYTHON = f"""#!/bin/sh
if [ "$1" = "-P" ]; then shift; fi
if [ "$1 $2" = "-m pip" ]; then shift 2; exec pip "$@"; fi
exec {shlex.quote(sys.executable)} -P "$@"
"""
_PIP = '#!/bin/sh\necho "pip $*" >>"$INSTALLED"\n'
_MUDLINE = f'#!/bin/sh\nexec {shlex.quote(sys.executable)} -m mudline "$@"\n'


def checkout(folder: Path) -> Path:
    """A checkout with a clean and a faulty deck, and beside it the programs that the recipes call."""
    programs = folder / "programs"
    programs.mkdir()
    for name, text in (("python", _PYTHON), ("pip", _PIP), ("mudline", _MUDLINE)):
        (programs / name).write_text(text)
        (programs / name).chmod(0o755)
    decks = folder / "checkout" / "decks"
    decks.mkdir(parents=True)
    (decks / "good.keyxm").write_text(CLEAN)
    (decks / "bad.keyxm").write_text(FAULTY)
    return folder / "checkout"


def shell(script: str, folder: Path, **given: str) -> subprocess.CompletedProcess[str]:
    """Run a script in a checkout as the servers do: bash, which ends at the first command that fails."""
    path = f"{folder.parent / 'programs'}{os.pathsep}{os.environ['PATH']}"
    env = {**os.environ, "PATH": path, "PYTHONPATH": str(SOURCE), "INSTALLED": str(folder.parent / "installed")}
    command = [BASH, "--noprofile", "--norc", "-eo", "pipefail", "-c", script]
    return subprocess.run(command, cwd=folder, env=env | given, capture_output=True, text=True, check=False, timeout=60)


def installed(folder: Path) -> str:
    """What pip was asked for."""
    return (folder.parent / "installed").read_text()
