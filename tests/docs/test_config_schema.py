"""The schema of the configuration: fresh, and of one mind with the program that reads it."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest

from mudline.checks.configuration import DEFAULTS, ConfigurationError, read_configuration
from mudline.cli.schema_command import MEANINGS, configuration_schema
from tests.docs.blocks import Page
from tests.docs.commands import output
from tests.docs.make import CONFIG_SCHEMA, ROOT

Draft7Validator = pytest.importorskip("jsonschema").Draft7Validator
SCHEMA = configuration_schema()
PAGE = Page.read(ROOT / "docs" / "configuration.md")

GOOD = (
    "",
    *(block.text for block in PAGE.blocks if block.language == "toml"),
    'extend = "base.toml"\n',
    'select = ["SYN", "ref001", "unsorted-points"]\ninclude = ["*.txt"]\ndialect = "flexcom"\n',
    '[severity]\nLEG = "off"\n"unsorted-points" = "error"\n',
)
BAD = (
    *("selct = []", 'extend = ["base.toml"]', 'extend = " "', 'select = "SYN"', "ignore = [1]", 'exclude = [" "]'),
    *('fail-on = "warn"', "dialect = 3", "severity = 1", '[severity]\nLEG001 = "loud"'),
    '[per-file-ignores]\n"*.das" = "LEG"',
)


def test_it_is_fresh() -> None:
    Draft7Validator.check_schema(SCHEMA)
    assert (ROOT / CONFIG_SCHEMA).read_text(encoding="utf-8") == output("mudline schema config"), "run make docs"


def test_every_key_is_described_here_and_on_the_page() -> None:
    assert MEANINGS.keys() == DEFAULTS.keys()
    assert (
        set(re.findall(r"`([a-z-]+)`", "".join(re.findall(r"^\|(.+?)\|", PAGE.prose, re.MULTILINE)))) == DEFAULTS.keys()
    )


@pytest.mark.parametrize("text", GOOD)
def test_both_take_what_is_right(tmp_path: Path, text: str) -> None:
    path = tmp_path / "mudline.toml"
    path.write_text(text, encoding="utf-8")
    (tmp_path / "base.toml").touch()
    found = read_configuration(path)
    assert found is not None
    assert [error.message for error in Draft7Validator(SCHEMA).iter_errors(tomllib.loads(text))] == []
    assert found.values == tomllib.loads(text)


@pytest.mark.parametrize("text", BAD)
def test_both_refuse_what_is_wrong(tmp_path: Path, text: str) -> None:
    path = tmp_path / "mudline.toml"
    path.write_text(text, encoding="utf-8")
    assert not Draft7Validator(SCHEMA).is_valid(tomllib.loads(text))
    with pytest.raises(ConfigurationError):
        read_configuration(path)
