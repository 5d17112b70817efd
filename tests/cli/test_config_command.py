from __future__ import annotations

import json
from pathlib import Path

from tests.cli.runner import run


def test_it_shows_values_and_their_origins(tmp_path: Path) -> None:
    config = tmp_path / "mudline.toml"
    config.write_text('# ours\nignore = ["LEG"]\n', encoding="utf-8")
    for path in (tmp_path, tmp_path / "deck.keyxm"):
        lines = run("config", str(path)).out.splitlines()
        assert f'ignore = ["LEG"]  # {config.as_posix()}:2' in lines
        assert 'fail-on = "warning"  # default' in lines
    rows = json.loads(run("config", str(tmp_path), "--output-format", "json").out)
    assert {"key": "ignore", "value": ["LEG"], "from": f"{config.as_posix()}:2"} in rows
    assert "ignore = []  # default" in run("config", str(tmp_path), "--isolated").out


def test_it_shows_which_file_set_a_value(tmp_path: Path) -> None:
    (tmp_path / "mudline.toml").write_text('extend = "base.toml"\n', encoding="utf-8")
    (tmp_path / "base.toml").write_text('\nfail-on = "error"\n', encoding="utf-8")
    lines = run("config", str(tmp_path)).out.splitlines()
    assert f'extend = "base.toml"  # {tmp_path.as_posix()}/mudline.toml:1' in lines
    assert f'fail-on = "error"  # {tmp_path.as_posix()}/base.toml:2' in lines


def test_a_wrong_configuration_is_wrong_usage(tmp_path: Path) -> None:
    (tmp_path / "mudline.toml").write_text("ignore = 3\n", encoding="utf-8")
    outcome = run("config", str(tmp_path))
    assert outcome.code == 2
    assert "mudline.toml:1: ignore must be a list of texts" in outcome.err
