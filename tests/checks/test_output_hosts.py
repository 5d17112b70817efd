"""The formats of hosts, read back as they read them: GitHub, GitLab and JUnit."""

from __future__ import annotations

import json
import re
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from junitparser import JUnitXml
from markdown_it import MarkdownIt

from mudline.checks.output import form_module, visible
from mudline.language.diagnostics import Diagnostic, Severity
from tests.checks.made_rules import finding
from tests.cli.runner import run
from tests.helpers.builders.decks import BAD_NUMBER

TEXTS = st.text(st.characters(codec="utf-8"), min_size=1, max_size=20)


def test_a_command_escapes_what_would_end_a_property_or_the_line() -> None:
    (line,) = form_module("github").write([finding(file="a,b:c%.keyxm", message="50% of\r\nall: x,y")], [])
    head = "::warning file=a%2Cb%3Ac%25.keyxm,line=3,endLine=3,col=2,endColumn=5,title=LEG001 superseded-keyword"
    assert line == f"{head}::50%25 of\ufffd\ufffdall: x,y\n"


def test_columns_are_told_within_one_line_only() -> None:
    (line,) = form_module("github").write([finding(end_line=5)], [])
    assert "line=3,endLine=5,title=" in line
    (line,) = form_module("github").write([finding(end_column=2)], [])
    assert "col=2,endColumn=2," in line


@pytest.mark.parametrize(("severity", "word"), [("error", "error"), ("warning", "warning"), ("info", "notice")])
def test_severities(severity: str, word: str) -> None:
    (line,) = form_module("github").write([finding(severity=Severity(severity))], [])
    assert line.startswith(f"::{word} ")


def test_an_issue_has_what_the_report_asks_for() -> None:
    (issue,) = json.loads("".join(form_module("gitlab").write([finding(file="./a.keyxm", message="wrong")], [])))
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
    issues = json.loads("".join(form_module("gitlab").write([finding(file=file) for file in given], [])))
    paths = [issue["location"]["path"] for issue in issues]
    assert paths == ["decks/a.keyxm", "decks/a.keyxm", "../a.keyxm", given[3]]
    (alone,) = json.loads("".join(form_module("gitlab").write([finding(file="decks/a.keyxm")], [])))
    assert issues[0]["fingerprint"] == alone["fingerprint"]


def test_fingerprints_stay_when_lines_move_and_are_unique() -> None:
    def prints(*lines: int) -> list[str]:
        return [
            issue["fingerprint"]
            for issue in json.loads("".join(form_module("gitlab").write([finding(line=line) for line in lines], [])))
        ]

    assert prints(3, 9) == prints(4, 17)
    assert len(set(prints(3, 9, 9))) == 3


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
    (text,) = form_module("github").write([finding(file=file, message=message)], [])
    assert re.fullmatch(r"[^\r\n]*\n", text)
    word, values, said = heard(text[:-1])
    assert (word, values["file"], said) == ("warning", file.removeprefix("./"), visible(message))
    assert values["title"] == "LEG001 superseded-keyword"
    assert values.keys() == {"file", "line", "endLine", "col", "endColumn", "title"}


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


# ---------------------------------------------------------------------------------------------------------------- jUnit


def test_a_suite_a_file_and_a_passed_case_for_a_clean_one() -> None:
    found = [finding(file="b.keyxm", message="wrong"), finding(file="b.keyxm", line=7)]
    root = ET.fromstring("".join(form_module("junit").write(found, ["a.keyxm", "b.keyxm"])))  # noqa: S314 - our own text
    assert root.attrib == {"name": "mudline", "tests": "3", "failures": "2", "errors": "0"}
    clean, bad = root
    assert (clean.get("name"), clean.get("tests"), clean.get("failures")) == ("a.keyxm", "1", "0")
    assert [case.find("failure") for case in clean] == [None]
    assert [case.get("name") for case in bad] == ["LEG001 superseded-keyword 3:2", "LEG001 superseded-keyword 7:2"]
    failure = bad[0].find("failure")
    assert failure is not None
    assert failure.attrib == {"type": "warning", "message": "b.keyxm:3:2: wrong"}


@given(st.text(st.characters(codec=None), max_size=20), st.text(st.characters(codec=None), max_size=20))
def test_whatever_a_deck_holds_is_good_xml(file: str, message: str) -> None:
    text = "".join(form_module("junit").write([finding(file=file, message=message)], [file]))
    root = ET.fromstring(text.encode())  # noqa: S314 - our own text
    assert root.get("failures") == "1"


# ------------------------------------------------------------------------------------------------------------- Markdown


def test_control_characters_are_replaced() -> None:
    found = finding(file="o\x1bdd.keyxm", message="10\x1b[31m\x00<&\"']]>\ud800\ufffe\x85é")
    opened = JUnitXml.fromstring("".join(form_module("junit").write([found], [found.file])).encode())
    assert isinstance(opened, JUnitXml)
    ((case,),) = opened
    (failure,) = case.result
    assert case.classname == "o\ufffddd.keyxm"
    assert failure.text == failure.message == "o\ufffddd.keyxm:3:2: 10\ufffd[31m\ufffd<&\"']]>\ufffd\ufffd\ufffdé"


def table_of(found: list[Diagnostic]) -> tuple[str, list[list[str]]]:
    """The heading and the cells of a summary as a host shows them; what is markup in a cell is not text."""
    text = "".join(form_module("markdown").write(found, ["a.keyxm"]))
    tokens = MarkdownIt("gfm-like", {"linkify": False}).parse(text)
    heading, *cells = [token for token in tokens if token.type == "inline"]
    assert {child.type for cell in cells for child in cell.children or ()} <= {"text", "text_special"}
    shown = ["".join(child.content for child in cell.children or ()) for cell in cells]
    return heading.content, [shown[at : at + 4] for at in range(4, len(shown) - 3, 4)]


@given(TEXTS)
@example("*a* `b` <img src=x> | [c](https://d) @someone $e$ ~~f~~ &amp; www.g.h")
def test_nothing_of_a_deck_is_markup_in_a_summary(message: str) -> None:
    message = f"x{message}x"  # blanks at the edges of a cell are not shown
    _, ((severity, place, rule, said),) = table_of([finding(file="a|b.keyxm", message=message)])
    assert (severity, place, rule) == ("warning", "a|b.keyxm:3:2", "LEG001 superseded-keyword")
    assert said == visible(message)


def test_a_summary_has_errors_first_and_counts_what_it_leaves_out() -> None:
    found = [finding(line=line) for line in range(1, 300)] + [finding(line=999, severity=Severity.ERROR)]
    heading, rows = table_of(found)
    assert heading == "mudline: 1 error, 299 warnings in 1 file"
    assert [row[1].split(":")[1] for row in rows[:2]] == ["999", "1"]
    assert len(rows) == 200
    assert "".join(form_module("markdown").write(found, ["a.keyxm"])).endswith("\nand 100 findings more.\n")
