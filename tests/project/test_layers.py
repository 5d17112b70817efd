"""The import contracts of pyproject.toml hold."""

from __future__ import annotations

from pathlib import Path

import pytest

lint_imports = pytest.importorskip("importlinter.cli", reason="import-linter is not installed").lint_imports

ROOT = Path(__file__).parents[2]


def test_packages_import_only_lower_layers_and_never_in_a_circle(capsys: pytest.CaptureFixture[str]) -> None:
    exit_code = lint_imports(config_filename=str(ROOT / "pyproject.toml"), no_cache=True, no_logo=True)
    report = capsys.readouterr().out
    assert exit_code == 0, report
    assert "0 broken" in report
