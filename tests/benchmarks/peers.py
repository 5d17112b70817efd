"""The programs that mudline is compared with, each in an environment of its own made from exact versions."""

from __future__ import annotations

import platform
import shutil
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

from tests.benchmarks.runner import ROOT

FOLDER = ROOT / ".bench"

_LONGEST = 900
"""Seconds for the installation of a peer."""


class Peer(NamedTuple):
    """A program: what pip installs, and what is compared."""

    name: str
    requirements: tuple[str, ...]
    compared: str


PEERS = (
    Peer("meshio", ("meshio==5.3.5", "numpy==2.4.6"), "`*NODE` of an Abaqus file"),
    Peer(
        "opm",
        ("opm==2026.4", "numpy==2.4.6"),
        "`Parser().parse` of a table keyword: RSVD for 2 columns, SWOF for 4; the values stay where OPM keeps them",
    ),
    Peer(
        "yamllint", ("yamllint==1.38.0", "pyyaml==6.0.3"), "decks as YAML, line for line, in its default configuration"
    ),
)


class Environment(NamedTuple):
    """Where a peer is installed; or why it is not."""

    peer: Peer
    reason: str = ""

    @property
    def folder(self) -> Path:
        """Its environment."""
        return FOLDER / self.peer.name

    def program(self, name: str) -> Path:
        """One of its programs."""
        scripts, suffix = ("Scripts", ".exe") if platform.system() == "Windows" else ("bin", "")
        return self.folder / scripts / f"{name}{suffix}"


def installed(peer: Peer) -> Environment:
    """Make the environment of a peer, unless it is there already."""
    place = Environment(peer)
    stamp, wanted = place.folder / "requirements.txt", "\n".join(peer.requirements)
    if stamp.exists() and stamp.read_text(encoding="utf-8") == wanted:
        return place
    sys.stderr.write(f"installing {wanted.replace(chr(10), ', ')}\n")
    shutil.rmtree(place.folder, ignore_errors=True)
    reason = _install(place)
    if reason:
        shutil.rmtree(place.folder, ignore_errors=True)
        return Environment(peer, reason)
    stamp.write_text(wanted, encoding="utf-8")
    return place


def _install(place: Environment) -> str:
    """Why the environment could not be made; empty if it could."""
    pip = [str(place.program("python")), "-m", "pip", "--disable-pip-version-check", "install", "--quiet"]
    for words in ([sys.executable, "-m", "venv", str(place.folder)], [*pip, *place.peer.requirements]):
        try:
            done = subprocess.run(words, capture_output=True, text=True, check=False, timeout=_LONGEST)
        except (OSError, subprocess.TimeoutExpired) as error:
            return f"installation failed ({type(error).__name__})"
        if done.returncode:
            sys.stderr.write(done.stderr[-2000:])
            missing = "No matching distribution" in done.stderr
            return f"no distribution for Python {platform.python_version()}" if missing else "installation failed"
    return ""
