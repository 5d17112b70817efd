"""Standard output of `mudline lint` in every form: the result only, and quiet when nobody reads on."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Sequence
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from mudline.checks.output import form_names
from tests.cli.runner import run
from tests.helpers.builders.decks import BAD_NUMBER, CLEAN

COUNTED: dict[str, Callable[[str], int]] = {
    "concise": lambda text: lines(text, r"bad\.keyxm:6:11: SYN002 .+"),
    "json": lambda text: len(json.loads(text)),
    "jsonl": lambda text: len([json.loads(line) for line in text.splitlines()]),
    "github": lambda text: lines(text, r"::error file=bad\.keyxm,.+::.+"),
    "gitlab": lambda text: len(json.loads(text)),
    "junit": lambda text: int(ET.fromstring(text.encode()).attrib["failures"]),  # noqa: S314 - our own text
    "markdown": lambda text: (
        text.count("\n| error | bad.keyxm:6:11 | SYN002 bad-number | ") or lines(text, "### mudline: no .+") - 1
    ),
    "sarif": lambda text: len(json.loads(text)["runs"][0]["results"]),
}
"""How many findings a form tells; fails where anything else stands in the text."""


def lines(text: str, pattern: str) -> int:
    found = text.splitlines()
    assert [line for line in found if not re.fullmatch(pattern, line)] == []
    return len(found)


@pytest.fixture
def decks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "bad.keyxm").write_text(BAD_NUMBER, encoding="utf-8")
    (tmp_path / "clean.keyxm").write_text(CLEAN, encoding="utf-8")
    return tmp_path


def test_every_form_is_looked_at() -> None:
    assert COUNTED.keys() == set(form_names())


@pytest.mark.parametrize("form", form_names())
@pytest.mark.parametrize("more", [("-q",), ("--output-format", "json=more.json", "-v")], ids=" ".join)
@pytest.mark.usefixtures("decks")
def test_standard_output_holds_the_result_only(form: str, more: Sequence[str]) -> None:
    outcome = run("lint", ".", "nowhere.keyxm", "--output-format", form, *more)
    assert outcome.code == 2
    assert COUNTED[form](outcome.out) == 1
    told = outcome.err.splitlines()
    assert "mudline: nowhere.keyxm: no such file or directory" in told
    assert len(told) == (3 if "-v" in more else 1)


@pytest.mark.parametrize("form", form_names())
@pytest.mark.usefixtures("decks")
def test_statistics_are_the_result_when_asked_for(form: str) -> None:
    outcome = run("lint", ".", "--statistics", "-v", "--output-format", form, "--output-format", f"{form}=report")
    assert outcome.out == "     1  SYN002  bad-number\n"
    assert all(line.startswith("mudline: ") for line in outcome.err.splitlines())
    assert COUNTED[form](Path("report").read_text(encoding="utf-8")) == 1


@pytest.mark.parametrize("form", form_names())
@pytest.mark.usefixtures("decks")
def test_nothing_found_is_a_whole_result(form: str) -> None:
    outcome = run("lint", "clean.keyxm", "--output-format", form)
    assert (outcome.code, outcome.err, COUNTED[form](outcome.out)) == (0, "", 0)
