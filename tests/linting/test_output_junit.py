"""JUnit: what is written, and opened by a parser that other programs use."""

from __future__ import annotations

import re
from xml.etree import ElementTree as ET

import pytest
from hypothesis import given
from hypothesis import strategies as st
from junitparser import Failure, JUnitXml, TestCase, TestSuite

from mudline.linting.output import form
from tests.builders.decks import BAD_NUMBER, CLEAN
from tests.cli.runner import run
from tests.linting.outputs import finding

ODD = CLEAN.replace(" 100.0, 1025.0, 9.81", " 100.0, 10\x1b[31m\x00<&\"']]>, 9.81é")


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


@pytest.fixture(scope="module")
def opened(tmp_path_factory: pytest.TempPathFactory) -> JUnitXml:
    folder = tmp_path_factory.mktemp("decks")
    decks = {"a clean.keyxm": CLEAN, "bad & 'ü'.keyxm": BAD_NUMBER, "odd.keyxm": ODD}
    for name, text in decks.items():
        (folder / name).write_text(text, encoding="utf-8")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        outcome = run("lint", *decks, "--output-format", "junit=report.xml", "--output-format", "junit")
    assert (outcome.code, outcome.err) == (1, "")
    assert (folder / "report.xml").read_bytes() == outcome.output
    found = JUnitXml.fromfile(str(folder / "report.xml"))
    assert isinstance(found, JUnitXml)
    return found


def suites(opened: JUnitXml) -> list[TestSuite]:
    return list(opened)


def cases(opened: JUnitXml) -> list[TestCase]:
    return [case for suite in suites(opened) for case in suite]


def failures(case: TestCase) -> list[Failure]:
    return [result for result in case.result if isinstance(result, Failure)]


def test_the_counts_are_those_of_the_cases(opened: JUnitXml) -> None:
    assert opened.name == "mudline"
    assert opened.tests == len(cases(opened))
    assert opened.failures == sum(len(failures(case)) for case in cases(opened))
    assert opened.errors == 0
    for suite in suites(opened):
        assert (suite.tests, suite.errors, suite.skipped) == (len(list(suite)), 0, 0)
        assert suite.failures == sum(len(failures(case)) for case in suite)
    assert [(suite.tests, suite.failures) for suite in suites(opened)][:2] == [(1, 0), (1, 1)]


def test_names_are_those_of_files_and_rules(opened: JUnitXml) -> None:
    assert [suite.name for suite in suites(opened)] == ["a clean.keyxm", "bad & 'ü'.keyxm", "odd.keyxm"]
    clean, bad, *_ = cases(opened)
    assert (clean.classname, clean.name, clean.is_passed) == ("a clean.keyxm", "mudline", True)
    assert (bad.classname, bad.name, bad.is_passed) == ("bad & 'ü'.keyxm", "SYN002 bad-number 6:11", False)


def test_texts_tell_place_and_message_in_both_places(opened: JUnitXml) -> None:
    (failure,) = failures(cases(opened)[1])
    assert failure.type == "error"
    assert str(failure.message).startswith("bad & 'ü'.keyxm:6:11: 'ten' is not a number")
    assert failure.text == failure.message


def test_control_characters_are_replaced() -> None:
    found = finding(file="o\x1bdd.keyxm", message="10\x1b[31m\x00<&\"']]>\ud800\ufffe\x85é")
    opened = JUnitXml.fromstring("".join(form("junit", [found.file], "")([found])).encode())
    assert isinstance(opened, JUnitXml)
    (case,) = cases(opened)
    (failure,) = failures(case)
    assert case.classname == "o\ufffddd.keyxm"
    assert failure.text == failure.message == "o\ufffddd.keyxm:3:2: 10\ufffd[31m\ufffd<&\"']]>\ufffd\ufffd\ufffdé"


def test_control_characters_of_a_deck_reach_no_reader(opened: JUnitXml) -> None:
    told = [str(failure.message) for case in cases(opened)[2:] for failure in failures(case)]
    assert any("SYN012" in case.name for case in cases(opened)[2:])
    assert not any(re.search(r"[\x00-\x1f\x7f-\x9f]", text) for text in told)
