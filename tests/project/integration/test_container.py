"""The Dockerfile: its steps are run by a shell, as there may be no engine; the image itself is not built here."""

from __future__ import annotations

import json
import os
import re
import subprocess
import venv
from pathlib import Path

import pytest

from tests.helpers.processes import TIMEOUT
from tests.project.integration.recipes import BASH, FAULTY, ROOT
from tests.project.integration.test_installing import wheels as wheels  # noqa: PLC0414 - a fixture

TEXT = (ROOT / "Dockerfile").read_text(encoding="utf-8").replace("\\\n", " ")
STEPS = [(line.split()[0], line.split(maxsplit=1)[1]) for line in TEXT.splitlines() if line and line[0] != "#"]


def of(word: str) -> list[str]:
    return [" ".join(rest.split()) for step, rest in STEPS if step == word]


def test_it_is_slim_holds_the_wheel_alone_and_runs_as_nobody_special() -> None:
    assert [image for image in of("FROM") if re.fullmatch(r"python:3\.\d+-slim", image)] == of("FROM")
    assert of("COPY") == of("ADD") == []
    (user,) = of("USER")
    assert user != "root"
    assert [word for word, _ in STEPS].index("USER") > max(at for at, (word, _) in enumerate(STEPS) if word == "RUN")
    assert f"useradd --create-home --uid 1000 {user}" in of("RUN")
    assert (ROOT / ".dockerignore").read_text(encoding="utf-8").split("\n")[1:] == ["*", "!dist/mudline-*.whl", ""]


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="the steps are those of a Unix shell")
def test_what_it_installs_lints(wheels: Path, tmp_path: Path) -> None:
    """Its installation, with the folder of wheels for the index, then its entry point on a mounted folder."""
    (install,) = [run for run in of("RUN") if "pip install" in run]
    mount, _, command = install.partition(" ")
    assert mount == "--mount=type=bind,source=dist,target=/dist"
    venv.create(tmp_path / "image", with_pip=True)
    path = f"{tmp_path / 'image/bin'}{os.pathsep}{os.environ['PATH']}"
    kept = {name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "PIP_", "VIRTUAL"))}
    env = {**kept, "PATH": path, "PIP_FIND_LINKS": str(wheels), "HOME": str(tmp_path)}
    env |= {"PIP_NO_INDEX": "1", "PIP_NO_COMPILE": "1"}
    script = command.replace("/dist/", f"{wheels}/")
    subprocess.run([BASH, "-ec", script], env=env, cwd=tmp_path, capture_output=True, timeout=TIMEOUT, check=True)
    (tmp_path / "decks").mkdir()
    (tmp_path / "decks/bad.keyxm").write_text(FAULTY, encoding="utf-8")
    (entry,) = of("ENTRYPOINT")
    words = [*json.loads(entry), "lint", "."]
    ran = subprocess.run(
        words, env=env, cwd=tmp_path / "decks", capture_output=True, text=True, timeout=TIMEOUT, check=False
    )
    assert (ran.returncode, ran.stderr) == (1, "")
    assert ran.stdout.startswith("bad.keyxm:3:9: error SYN002 ")
