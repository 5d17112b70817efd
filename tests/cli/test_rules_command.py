"""`mudline rules` and `mudline schema`: what the program says about itself."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from mudline.checks.registry import rules
from tests.cli.runner import SAMPLES, assert_fits, run
from tests.helpers.samples import FAULTY

CODES = [rule.code.code for rule in rules()]

if TYPE_CHECKING:
    from jsonschema import Draft202012Validator


def test_list_has_a_line_for_every_rule() -> None:
    outcome = run("rules")
    assert (outcome.code, outcome.err) == (0, "")
    lines = outcome.out.splitlines()
    assert lines[0] == f"{len(CODES)} rules"
    assert [line.split()[0] for line in lines[3:-1] if line[0] != " "] == CODES
    assert "SYN002 error bad-number A field that needs a number does not hold a number." in [
        " ".join(line.split()) for line in lines
    ]


@pytest.mark.parametrize("word", ["SYN002", "syn002", "bad-number"])
def test_one_rule_is_explained(word: str) -> None:
    outcome = run("rules", word)
    assert outcome.code == 0
    lines = outcome.out.splitlines()
    assert lines[:3] == ["SYN002 bad-number (error)", "", "A field that needs a number does not hold a number."]
    assert any(line.startswith("Bad (found at line ") for line in lines)
    assert "Good:" in lines
    assert "    $MODEL" in lines


def test_json() -> None:
    found = run("rules", "--output-format", "json").json()
    assert_fits(found, "rules")
    assert [rule["code"] for rule in found] == CODES
    (one,) = run("rules", "SYN002", "--output-format", "json").json()
    assert one == next(rule for rule in found if rule["code"] == "SYN002")


@pytest.fixture(scope="module")
def validator() -> Draft202012Validator:
    """The schema that the program prints."""
    outcome = run("schema")
    assert (outcome.code, outcome.err) == (0, "")
    schema = outcome.json()
    draft = pytest.importorskip("jsonschema").Draft202012Validator
    draft.check_schema(schema)
    found: Draft202012Validator = draft(schema)
    return found


@pytest.mark.covered
@pytest.mark.parametrize("name", sorted(path.name for path in SAMPLES.glob("*.key*") if path.name not in FAULTY))
@pytest.mark.parametrize("options", [(), ("--sorted",)], ids=["as-is", "sorted"])
def test_schema_describes_what_convert_writes(
    name: str, options: tuple[str, ...], validator: Draft202012Validator
) -> None:
    validator.validate(run("convert", SAMPLES / name, "--to", "json", *options).json())


# ---------------------------------------------------------------------------------------------------------------------


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
