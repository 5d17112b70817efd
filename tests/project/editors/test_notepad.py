"""The language of Notepad++: fresh, and of the form that it imports. The editor itself runs on Windows alone."""

from __future__ import annotations

import re
from xml.etree import ElementTree as ET

from mudline.language.keywords import catalogue
from tests.cli.runner import ROOT
from tests.project.editors.notepad import LANGUAGE, language_text


def lists() -> dict[str, str]:
    root = ET.fromstring(language_text().encode())  # noqa: S314 - our own text
    return {str(each.get("name")): each.text or "" for each in root.iter("Keywords")}


def test_the_language_is_fresh() -> None:
    assert (ROOT / LANGUAGE).read_text(encoding="utf-8") == language_text(), "run make docs"


def test_it_takes_the_suffixes_of_decks_and_comments_in_the_first_column() -> None:
    (language,) = ET.fromstring(language_text().encode()).iter("UserLang")  # noqa: S314 - as above
    assert str(language.get("ext")).split() == ["keyx", "keyxm", "keyxi", "das"]
    (settings,) = language.iter("Global")
    assert (settings.get("caseIgnored"), settings.get("forcePureLC")) == ("yes", "1")
    assert lists()["Comments"].split()[0] == "00C"


def test_every_word_of_the_catalogue_is_in_one_list() -> None:
    found = lists()
    words = {
        name: [a or b for a, b in re.findall(r"'([^']+)'|(\S+)", found[f"Keywords{name}"])] for name in range(1, 6)
    }
    assert {word.removeprefix("$") for word in words[1]} == set(catalogue.SECTIONS)
    assert {word.removeprefix("*") for word in words[2] + words[3]} == set(catalogue.keywords())
    assert {"STIFFNESS", "SET", "TYPE"} <= set(words[4])
    assert {"ELASTIC", "RIGID"} <= set(words[5])
    everything = [word for listed in words.values() for word in listed]
    assert len(everything) == len(set(everything))


def test_each_list_and_each_style_has_the_name_that_the_editor_knows() -> None:
    root = ET.fromstring(language_text().encode())  # noqa: S314 - as above
    styles = [str(style.get("name")) for style in root.iter("WordsStyle")]
    assert len(styles) == len(set(styles)) == 24
    assert {"DEFAULT", "COMMENTS", "LINE COMMENTS", "NUMBERS", "OPERATORS"} <= set(styles)
    assert {f"KEYWORDS{n}" for n in range(1, 9)} | {f"DELIMITERS{n}" for n in range(1, 9)} <= set(styles)
    assert len(lists()) == 28
