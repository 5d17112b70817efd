from __future__ import annotations

import re
from pathlib import Path

import pytest

from mudline.checks.configuration import ConfigurationError, Configured, read_configuration
from mudline.checks.registry import code_fault


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("\nselct = []", ":2: unknown key 'selct': did you mean select?"),
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
    search = Configured()
    assert search.of(str(deep / "-")).path == tmp_path / "mudline.toml"
    assert search.of(str(tmp_path / "a" / "-")).value("ignore") == ["LEG"]
    (tmp_path / "a" / "pyproject.toml").write_text('x = 1\n[tool.mudline]\nselect = ["REF"]\n', encoding="utf-8")
    found = Configured().of(str(deep / "-"))
    path = tmp_path / "a" / "pyproject.toml"
    assert (found.path, found.value("select"), found.origins) == (path, ["REF"], {"select": (path, 3)})


def _write(folder: Path, **texts: str) -> Path:
    """Put files into a folder; returns the first."""
    for name, text in texts.items():
        path = folder / f"{name.replace('__', '/')}.toml"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return folder / f"{next(iter(texts)).replace('__', '/')}.toml"


def test_a_base_gives_what_a_file_does_not_set(tmp_path: Path) -> None:
    path = _write(
        tmp_path,
        a__b__mudline='extend = "../team.toml"\nignore = ["LEG"]\n[severity]\nCRV002 = "error"\n',
        a__team='fail-on = "error"\nextend-select = ["UNT"]\nextend = "../all.toml"\n',
        all='ignore = ["SYN"]\nselect = ["REF"]\nfail-on = "info"\nextend-select = ["STY"]\n'
        '[severity]\nCRV002 = "info"\nLEG001 = "off"\n',
    )
    found = read_configuration(path, code_fault=code_fault)
    assert found is not None
    assert found.path == path
    assert found.values == {
        "extend": "../team.toml",
        "ignore": ["LEG"],
        "select": ["REF"],
        "fail-on": "error",
        "extend-select": ["STY", "UNT"],
        "severity": {"CRV002": "error", "LEG001": "off"},
    }
    assert found.origins["select"] == (tmp_path / "all.toml", 2)
    assert found.origins["fail-on"] == (tmp_path / "a/team.toml", 1)
    assert found.origins["ignore"] == (path, 2)


def test_a_pyproject_may_be_a_base(tmp_path: Path) -> None:
    path = _write(tmp_path, mudline='extend = "pyproject.toml"\n', pyproject='[tool.mudline]\nselect = ["REF"]\n')
    found = read_configuration(path)
    assert found is not None
    assert found.value("select") == ["REF"]


@pytest.mark.parametrize(
    ("texts", "message"),
    [
        ({"a": 'extend = "a.toml"'}, "a.toml:1: extend leads back to itself: {0}/a.toml -> {0}/a.toml"),
        (
            {"a": '\nextend = "b.toml"', "b": 'extend = "sub/../a.toml"'},
            "b.toml:1: extend leads back to itself: {0}/a.toml -> {0}/b.toml -> {0}/a.toml",
        ),
        (
            {"a": 'extend = "b.toml"', "b": 'extend = "c.toml"', "c": '\n\nextend = "b.toml"'},
            "c.toml:3: extend leads back to itself: {0}/b.toml -> {0}/c.toml -> {0}/b.toml",
        ),
        ({"a": '\nextend = "b.toml"'}, "a.toml:2: extend: {0}/b.toml cannot be read: no such file or directory"),
        ({"a": 'extend = "b.toml"', "b": "\nselct = []"}, "b.toml:2: unknown key 'selct'"),
        ({"a": 'extend = "b.toml"', "b": "="}, "b.toml: this is not TOML"),
        ({"a": "extend = []"}, 'a.toml:1: extend must be the path of a file, such as "../base.toml", not []'),
    ],
)
def test_a_base_that_cannot_be_used(tmp_path: Path, texts: dict[str, str], message: str) -> None:
    path = _write(tmp_path, **texts)
    place = f"{tmp_path.as_posix()}/{message.format(tmp_path.as_posix())}"
    with pytest.raises(ConfigurationError, match=re.escape(place)):
        read_configuration(path, code_fault=code_fault)
