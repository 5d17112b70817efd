from __future__ import annotations

from xml.etree import ElementTree as ET

from hypothesis import given
from hypothesis import strategies as st

from mudline.linting.output.formats import form
from tests.lint.outputs import finding


def test_a_suite_a_file_and_a_passed_case_for_a_clean_one() -> None:
    found = [finding(file="b.keyxm", message="wrong"), finding(file="b.keyxm", line=7)]
    root = ET.fromstring("".join(form("junit", ["a.keyxm", "b.keyxm"], "")(found)))  # noqa: S314 - our own text
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
    text = "".join(form("junit", [file], "")([finding(file=file, message=message)]))
    root = ET.fromstring(text.encode())  # noqa: S314 - our own text
    assert root.get("failures") == "1"
