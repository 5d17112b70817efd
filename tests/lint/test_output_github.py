from __future__ import annotations

import pytest

from mudline.diagnostics import Severity
from mudline.linting.output.formats import form
from tests.lint.outputs import finding


def test_a_command_escapes_what_would_end_a_property_or_the_line() -> None:
    (line,) = form("github", [], "")([finding(file="a,b:c%.keyxm", message="50% of\r\nall: x,y")])
    head = "::warning file=a%2Cb%3Ac%25.keyxm,line=3,endLine=3,col=2,endColumn=5,title=LEG001 superseded-keyword"
    assert line == f"{head}::50%25 of\ufffd\ufffdall: x,y\n"


def test_columns_are_told_within_one_line_only() -> None:
    (line,) = form("github", [], "")([finding(end_line=5)])
    assert "line=3,endLine=5,title=" in line
    (line,) = form("github", [], "")([finding(end_column=2)])
    assert "col=2,endColumn=2," in line


@pytest.mark.parametrize(("severity", "word"), [("error", "error"), ("warning", "warning"), ("info", "notice")])
def test_severities(severity: str, word: str) -> None:
    (line,) = form("github", [], "")([finding(severity=Severity(severity))])
    assert line.startswith(f"::{word} ")
