from __future__ import annotations

import re
from pathlib import Path

import pytest

from mudline.linting.configuration import ConfigurationError, Search, read_configuration
from mudline.linting.registry import code_fault


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("\nselct = []", ":2: there is no key 'selct': did you mean select?"),
        ('select = [\n "REF",\n "REF9999"]', ":3: select: 'REF9999' names no rule"),
        ('fail-on = "warn"', ":1: fail-on cannot be 'warn': choose from error, warning, info"),
        ('fail-on = "warnign"', ":1: fail-on cannot be 'warnign': did you mean warning?"),
        ("dialect = 3", ":1: dialect cannot be 3: write one of mudline, flexcom"),
        ('exclude = "old"', ":1: exclude must be a list of texts"),
        ("severity = 1", ":1: severity must be a table, not 1"),
        ('[severity]\nLEG001 = "loud"', ":2: LEG001 cannot be 'loud'"),
        ('[per-file-ignores]\n"*.das" = ["NO"]', ":2: *.das: 'NO' names no rule"),
        ("select = ", ": this is not TOML"),
        (f"dialect = {'9' * 5000}", ": a whole number in this file is too large"),
    ],
)
def test_a_wrong_configuration_is_told_with_its_line(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "mudline.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ConfigurationError, match=re.escape(f"{path.as_posix()}{message}")):
        read_configuration(path, code_fault=code_fault)


def test_the_nearest_file_counts_and_one_without_a_table_does_not(tmp_path: Path) -> None:
    deep = tmp_path / "a" / "b"
    deep.mkdir(parents=True)
    (tmp_path / "mudline.toml").write_text('ignore = ["LEG"]\n', encoding="utf-8")
    (tmp_path / "a" / "pyproject.toml").write_text("[tool.other]\nx = 1\n", encoding="utf-8")
    search = Search()
    assert search.nearest(deep).path == tmp_path / "mudline.toml"
    assert search.nearest(tmp_path / "a").words("ignore") == ["LEG"]
    (tmp_path / "a" / "pyproject.toml").write_text('x = 1\n[tool.mudline]\nselect = ["REF"]\n', encoding="utf-8")
    found = Search().nearest(deep)
    assert (found.path, found.words("select"), found.lines) == (
        tmp_path / "a" / "pyproject.toml",
        ["REF"],
        {"select": 3},
    )
