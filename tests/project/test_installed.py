"""Packages beside mudline: those that may declare entry points, as importlib.metadata finds them."""

from __future__ import annotations

import sys
from importlib.abc import MetaPathFinder
from importlib.metadata import entry_points
from pathlib import Path

import pytest

from mudline.basics.installed import may_declare

GROUP = "anchors.rules"
METADATA = "Metadata-Version: 2.1\nName: chain\nVersion: 1.0\n"
DECLARED = f"[console_scripts]\na = b:c\n\n[{GROUP}]\nd = e\n"


@pytest.fixture
def site(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The only place where packages are looked for."""
    monkeypatch.setattr(sys, "path", [str(tmp_path), str(tmp_path / "not-there"), str(tmp_path)])
    monkeypatch.setattr(sys, "meta_path", [one for one in sys.meta_path if not hasattr(one, "find_distributions")])
    return tmp_path


def found() -> bool:
    return bool(entry_points(group=GROUP))


@pytest.mark.parametrize("folder", ["chain-1.0.dist-info", "chain-1.0.egg-info", "Chain-1.0.DIST-INFO"])
def test_a_package_that_declares_them(site: Path, folder: str, monkeypatch: pytest.MonkeyPatch) -> None:
    (site / folder).mkdir()
    (site / folder / ("PKG-INFO" if "egg" in folder else "METADATA")).write_text(METADATA)
    assert not may_declare(GROUP)
    (site / folder / "entry_points.txt").write_text("[console_scripts]\na = b:c\n")
    assert not may_declare(GROUP)
    (site / folder / "entry_points.txt").write_text(DECLARED)
    assert may_declare(GROUP)
    monkeypatch.undo()
    monkeypatch.syspath_prepend(site)
    assert found()
    monkeypatch.chdir(site)
    monkeypatch.setattr(sys, "path", [""])
    assert may_declare(GROUP)


def test_a_finder_of_another_kind_may_know_a_package(site: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    class Elsewhere(MetaPathFinder):
        def find_distributions(self) -> None:
            """Somewhere else."""

    assert site.exists()
    monkeypatch.setattr(sys, "meta_path", [Elsewhere(), *sys.meta_path])
    assert may_declare(GROUP)
