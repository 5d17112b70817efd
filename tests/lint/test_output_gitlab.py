from __future__ import annotations

import json
from pathlib import Path

import pytest

from mudline.linting.output.formats import form
from tests.lint.outputs import finding


def test_an_issue_has_what_the_report_asks_for() -> None:
    (issue,) = json.loads("".join(form("gitlab", [], "")([finding(file="./a.keyxm", message="wrong")])))
    assert len(issue.pop("fingerprint")) == 64
    assert issue == {
        "description": "LEG001 wrong",
        "check_name": "superseded-keyword",
        "severity": "minor",
        "location": {"path": "a.keyxm", "lines": {"begin": 3, "end": 3}},
    }


def test_paths_are_from_the_folder_of_the_job(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    given = [f"{tmp_path.as_posix()}/decks/a.keyxm", "./decks/a.keyxm", "../a.keyxm", f"{tmp_path.as_posix()}x.keyxm"]
    issues = json.loads("".join(form("gitlab", [], "")(finding(file=file) for file in given)))
    paths = [issue["location"]["path"] for issue in issues]
    assert paths == ["decks/a.keyxm", "decks/a.keyxm", "../a.keyxm", given[3]]
    (alone,) = json.loads("".join(form("gitlab", [], "")([finding(file="decks/a.keyxm")])))
    assert issues[0]["fingerprint"] == alone["fingerprint"]


def test_fingerprints_stay_when_lines_move_and_are_unique() -> None:
    def prints(*lines: int) -> list[str]:
        return [
            issue["fingerprint"]
            for issue in json.loads("".join(form("gitlab", [], "")(finding(line=line) for line in lines)))
        ]

    assert prints(3, 9) == prints(4, 17)
    assert len(set(prints(3, 9, 9))) == 3


def test_nothing_is_an_empty_array() -> None:
    assert "".join(form("gitlab", [], "")([])) == "[]\n"
