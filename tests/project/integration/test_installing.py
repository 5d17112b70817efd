"""Wheel and source archive, installed without a network into an empty environment; what a release has to hold."""

from __future__ import annotations

import base64
import hashlib
import os
import re
import shutil
import subprocess
import venv
import zipfile
from importlib import metadata
from pathlib import Path

import pytest
import yaml

import mudline
from tests.helpers.processes import TIMEOUT
from tests.helpers.shared import shared
from tests.project.integration.recipes import BASH

ROOT = Path(__file__).parents[3]
BUILD = "hatchling"


def needed(names: set[str]) -> set[str]:
    """The installed distributions that some need, they included; what only an extra or another system needs is not."""
    found: set[str] = set()
    waiting = [*names]
    while waiting:
        name = waiting.pop().lower()
        if name in found:
            continue
        found.add(name)
        for line in metadata.requires(name) or []:
            requirement, _, marker = line.partition(";")
            wanted = re.match(r"[A-Za-z0-9._-]+", requirement)
            if "extra" in marker or "platform" in marker or "version" in marker or wanted is None:
                continue
            waiting.append(wanted[0])
    return found


def packed(name: str, folder: Path) -> None:
    """Write an installed distribution as the wheel that it came from; programs stay behind."""
    distribution = metadata.distribution(name)
    files = [path for path in distribution.files or [] if ".." not in path.parts and "__pycache__" not in path.parts]
    (info,) = {path.parts[0] for path in files if path.name == "METADATA" and path.parts[0].endswith(".dist-info")}
    tag = re.search(r"^Tag: (\S+)", distribution.read_text("WHEEL") or "", re.MULTILINE)
    assert tag is not None
    record = []
    with zipfile.ZipFile(folder / f"{info.removesuffix('.dist-info')}-{tag[1]}.whl", "w") as wheel:
        for path in files:
            if path.name in {"RECORD", "INSTALLER", "REQUESTED", "direct_url.json"} and path.parts[0] == info:
                continue
            content = Path(distribution.locate_file(path)).read_bytes()  # type: ignore[arg-type]
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).decode().rstrip("=")
            wheel.writestr(path.as_posix(), content)
            record.append(f'"{path.as_posix()}",sha256={digest},{len(content)}\n')
        wheel.writestr(f"{info}/RECORD", "".join([*record, f'"{info}/RECORD",,\n']))


@pytest.fixture(scope="session")
def wheels(packages: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with wheel and source archive of mudline, and wheels of what installing them needs."""

    def pack(folder: Path) -> None:
        shutil.copytree(packages, folder, dirs_exist_ok=True)
        core = {re.match(r"[a-z0-9-]+", line)[0] for line in metadata.requires("mudline") or [] if "extra" not in line}  # type: ignore[index]
        for name in needed({*core, BUILD, "typing-extensions"}):
            packed(name, folder)

    return shared(tmp_path_factory, "wheels", pack)


@pytest.mark.nightly
def test_it_installs_without_a_network(wheels: Path, tmp_path: Path) -> None:
    """From the source archive, of which a wheel is built on the way; a wheel is installed for the container."""
    (archive,) = wheels.glob("mudline-*.tar.gz")
    home = tmp_path / "empty"
    venv.create(home, with_pip=True)
    programs = home / ("Scripts" if os.name == "nt" else "bin")
    environment = {
        name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "PIP_", "VIRTUAL_ENV"))
    }
    environment |= {"PIP_NO_INDEX": "1", "PIP_FIND_LINKS": str(wheels), "PIP_DISABLE_PIP_VERSION_CHECK": "1"}
    environment["MUDLINE_CACHE_DIR"] = str(tmp_path / "cache")

    def run(*words: str) -> subprocess.CompletedProcess[str]:
        command = [str(programs / words[0]), *words[1:]]
        return subprocess.run(
            command, cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=TIMEOUT, check=False
        )

    installed = run("python", "-m", "pip", "install", "--quiet", "--no-compile", str(archive))
    assert installed.returncode == 0, installed.stderr
    assert run("mudline", "--version").stdout == f"mudline {mudline.__version__}\n"
    clean = run("mudline", "lint", str(ROOT / "samples/flowline-gen.keyxm"))
    assert (clean.returncode, clean.stderr) == (0, "")
    broken = run("mudline", "lint", str(ROOT / "samples/broken.keyxm"))
    assert broken.returncode == 1
    assert "SYN002" in broken.stdout


def test_a_release_needs_its_version_in_the_changelog(tmp_path: Path) -> None:
    text = (ROOT / ".github/workflows/release.yml").read_text(encoding="utf-8")
    steps = yaml.safe_load(text)["jobs"]["build"]["steps"]
    (check,) = [step["run"] for step in steps if step.get("name") == "The changelog has the version"]
    for version, code in (("v0.1.0", 0), ("v0.2.0", 1), ("v0x1.0", 1)):
        (tmp_path / "CHANGELOG.md").write_text("# Changelog\n\n## 0.1.0, first release\n", encoding="utf-8")
        environment = {**os.environ, "GITHUB_REF_NAME": version}
        found = subprocess.run(
            [BASH, "-c", check], cwd=tmp_path, env=environment, capture_output=True, timeout=TIMEOUT, check=False
        )
        assert found.returncode == code, version
