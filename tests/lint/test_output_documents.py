"""The forms for GitHub and GitLab, read back as the documents of the two say they are read."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.linting.output.formats import form
from mudline.linting.output.visible import visible
from mudline.linting.registry import rules
from tests.cli.decks import BAD_NUMBER
from tests.cli.runner import run
from tests.lint.outputs import finding

TEXTS = st.text(st.characters(codec="utf-8"), min_size=1, max_size=20)


def heard(line: str) -> tuple[str, dict[str, str], str]:
    """A workflow command as a runner takes it apart: at the first `::`, at commas, at `=`, then the escapes."""
    match = re.fullmatch(r"::([a-z]+) (.*?)::(.*)", line)
    assert match, line
    pairs = (pair.split("=", 1) for pair in match[2].split(","))
    return match[1], {name: _unescaped(value, ",:") for name, value in pairs}, _unescaped(match[3], "")


def _unescaped(text: str, more: str) -> str:
    for char in f"\r\n{more}%":
        text = text.replace(f"%{ord(char):02X}", char)
    return text


@given(TEXTS, TEXTS)
def test_a_command_says_the_same_to_the_runner(file: str, message: str) -> None:
    (text,) = form("github", [], "")([finding(file=file, message=message)])
    assert re.fullmatch(r"[^\r\n]*\n", text)
    word, values, said = heard(text[:-1])
    assert (word, values["file"], said) == ("warning", file.removeprefix("./"), visible(message))
    assert values["title"] == "LEG001 superseded-keyword"
    assert values.keys() == {"file", "line", "endLine", "col", "endColumn", "title"}


@given(st.lists(st.tuples(TEXTS, TEXTS), max_size=5))
def test_an_issue_of_gitlab_has_the_keys_and_words_of_its_document(found: list[tuple[str, str]]) -> None:
    issues = json.loads("".join(form("gitlab", [], "")(finding(file=file, message=message) for file, message in found)))
    assert len(issues) == len(found)
    for issue in issues:
        assert all(isinstance(issue[key], str) and issue[key] for key in ("description", "check_name", "fingerprint"))
        assert issue["severity"] in {"info", "minor", "major", "critical", "blocker"}
        assert isinstance(issue["location"]["path"], str)
        assert issue["location"]["lines"]["begin"] >= 1
    assert len({issue["fingerprint"] for issue in issues}) == len(issues)


def test_a_run_tells_gitlab_and_github_of_the_same(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "50%, a b.keyxm").write_text(BAD_NUMBER, encoding="utf-8")
    outcome = run("lint", "./50%, a b.keyxm", "--output-format", "github", "--output-format", "gitlab=report.json")
    assert (outcome.code, outcome.err) == (1, "")
    (issue,) = json.loads((tmp_path / "report.json").read_text(encoding="utf-8"))
    word, values, message = heard(outcome.out.rstrip("\n"))
    assert (word, issue["severity"], issue["check_name"]) == ("error", "major", "bad-number")
    assert values["file"] == issue["location"]["path"] == "50%, a b.keyxm"
    assert int(values["line"]) == issue["location"]["lines"]["begin"] == 6
    assert issue["description"] == f"SYN002 {message}"


def test_every_name_of_a_rule_stands_in_a_title_as_it_is() -> None:
    for rule in rules():
        (text,) = form("github", [], "")([finding(code=rule.code.code, slug=rule.code.slug)])
        assert f",title={rule.code.code} {rule.code.slug}::" in text
