from __future__ import annotations

import json
from pathlib import Path

from tests.cli.runner import run

DECK = "$MODEL\n*ELASTIC SURFACE\n1000\n"


def codes(*arguments: str) -> dict[str, str]:
    out = run("lint", *arguments, "--output-format", "json", "--exit-zero").out
    return {found["code"]: found["severity"] for found in json.loads(out)}


def test_the_file_decides_and_the_command_line_wins(tmp_path: Path) -> None:
    deck = tmp_path / "d.keyxm"
    deck.write_text(DECK, encoding="utf-8")
    assert codes(str(deck))["LEG001"] == "info"
    config = tmp_path / "mudline.toml"
    config.write_text('select = ["LEG"]\n[severity]\nLEG001 = "error"\n', encoding="utf-8")
    assert codes(str(deck)) == {"LEG001": "error"}
    assert codes(str(deck), "--isolated")["LEG001"] == "info"
    assert codes(str(deck), "--ignore", "LEG001") == {}
    config.write_text('[per-file-ignores]\n"*.keyxm" = ["LEG001"]\n', encoding="utf-8")
    assert "LEG001" not in codes(str(deck))
    config.write_text('[severity]\nLEG001 = "off"\n', encoding="utf-8")
    assert "LEG001" not in codes(str(deck))


def test_a_wrong_file_is_wrong_usage(tmp_path: Path) -> None:
    deck, config = tmp_path / "d.keyxm", tmp_path / "other.toml"
    deck.write_text(DECK, encoding="utf-8")
    config.write_text("selct = []\n", encoding="utf-8")
    outcome = run("lint", str(deck), "--config", str(config))
    assert outcome.code == 2
    assert "other.toml:1: unknown key 'selct': did you mean select?" in outcome.err
    assert run("lint", str(deck), "--config", str(tmp_path / "none.toml")).code == 2
    assert run("lint", str(deck), "--config", str(config), "--isolated").code == 2


def test_a_directory_search_includes_and_excludes(tmp_path: Path) -> None:
    for name in ("a.keyxm", "b.txt", "old/c.keyxm"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(DECK, encoding="utf-8")
    (tmp_path / "mudline.toml").write_text('include = ["*.txt"]\nexclude = ["/old"]\n', encoding="utf-8")
    found = json.loads(run("lint", str(tmp_path), "--output-format", "json", "--exit-zero").out)
    assert {Path(one["file"]).name for one in found} == {"a.keyxm", "b.txt"}
