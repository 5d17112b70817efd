"""Findings with others under them: the same from any number of processes, from the cache, and with a baseline."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from mudline import cache_folder
from mudline.diagnostics import Diagnostic
from mudline.linting.engine import lint_bytes
from mudline.linting.registry import rules
from mudline.running import executors
from tests.cli.runner import run
from tests.linting.test_recovery import changed

ROWS = changed((" 0.0, 0.0\n 0.5, 20000.0\n", " 1, 0.0, 0.0\n 2, 0.1, 8000.0\n 3, 0.3, 15000.0\n 4, 0.5, 20000.0\n"))
STARLESS = changed(("*ELEMENT\n", "ELEMENT\n"))


def test_jobs_cache_and_baseline_agree(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(executors, "PAYS", dict.fromkeys(executors.PAYS, 0.0))
    monkeypatch.setenv(cache_folder.PLACE, str(folder / "cache"))
    for name, text in (("a", ROWS), ("b", STARLESS)):
        (folder / f"{name}.keyxm").write_text(text, encoding="utf-8")
    asked = ("lint", "a.keyxm", "b.keyxm", "-v")
    plain = run(*asked, "--no-cache")
    assert "and 3 more rows of this block" in plain.out
    assert plain.out.count("follows: ") == sum(map(len, map(_following, ("a", "b")))) > 0
    assert run(*asked, "--no-cache", "--jobs", "2").out == plain.out
    assert run(*asked).out == plain.out  # fills the cache
    assert run(*asked).out == plain.out
    run(*asked, "--baseline", "known.json", "--write-baseline")
    recorded = json.loads((folder / "known.json").read_text(encoding="utf-8"))
    assert recorded
    for more in ((), ("--jobs", "2"), ("--no-cache",)):
        assert run(*asked, "--baseline", "known.json", "--output-format", "json", *more).out == "[]\n"


def _following(name: str) -> list[Diagnostic]:
    data = Path(f"{name}.keyxm").read_bytes()
    return [each for one in lint_bytes(data, f"{name}.keyxm", rules()) for each in one.following]
