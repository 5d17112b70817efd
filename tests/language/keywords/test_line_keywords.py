"""The keywords of lines: two with models, five that are kept as they are."""

from __future__ import annotations

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from mudline.language.deck.loading import dump
from mudline.language.keywords import catalogue
from mudline.language.keywords.values import Names, OpaqueKeyword
from tests.helpers.builders.scenes import deck_of, faults
from tests.helpers.builders.spellings import no_head, texts
from tests.language.deck.test_forms import held

OPAQUE = [kept for kept in catalogue.opaque_keywords() if kept.sections == ("MODEL",)]

GROUPS = """\
$MODEL
*LINE SECTION GROUPS
 NAME=Joint
 SECTION=Pipe Joint, =[length]
C thicker
 ADDITIONAL=Coated Pipe, Riser
 ADDITIONAL=Upper
 0.5, , 0.25
 SECTION=Field Joint, 0.4
"""
PATHS = """\
$MODEL
*LINE PATH SECTIONS
 LINE=Flowline
 SECTION=Start Zone, 0.0, 150.0, REPEAT=Joint
 ADDITIONAL=Coated Pipe
 SECTION=End Zone, -50.0
 LINE=Jumper
"""


def block(text: str) -> dict[str, object]:
    """The only block of a deck as it stands in a document; reading it finds nothing."""
    deck = deck_of(text)
    assert deck.problems == []
    held(deck)
    (found,) = deck.sections[0].blocks
    return found.model_dump(mode="json", exclude_defaults=True)


# ------------------------------------------------------------------------------------------------------------- models


def test_groups() -> None:
    joint: dict[str, object] = {
        "section": {"set": "Pipe Joint", "length": "=[length]"},
        "additional": [{"sets": ["Coated Pipe", "Riser"]}, {"sets": ["Upper"]}],
        "mesh": {"start": 0.5, "end": 0.25},
        "comments": [{"before": 0, "text": " thicker"}],
    }
    field = {"section": {"set": "Field Joint", "length": 0.4}}
    assert block(GROUPS) == {"groups": [{"name": "Joint", "sections": [joint, field]}]}


def test_paths() -> None:
    start: dict[str, object] = {
        "section": {"set": "Start Zone", "start": 0.0, "end": 150.0},
        "repeat": "Joint",
        "additional": [{"sets": ["Coated Pipe"]}],
    }
    end = {"section": {"set": "End Zone", "start": -50.0}}
    assert block(PATHS) == {"paths": [{"line": "Flowline", "sections": [start, end]}, {"line": "Jumper"}]}


@pytest.mark.parametrize(
    ("lines", "fault"),
    [
        (
            "*LINE SECTION GROUPS\n SECTION=a, 1\n",
            "3:2 SYN001 expected NAME= before this line: write NAME= and its value above it",
        ),
        ("*LINE SECTION GROUPS\n NAME=g\n SECTION=a\n", "4:10 SYN003 2 fields expected (`set, length`), found 1"),
        (
            "*LINE SECTION GROUPS\n NAME=g\n SECTION=a, 1\n 1, 2, 3, 4\n",
            "5:2 SYN003 0 to 3 fields expected (`[start] [, longest] [, end]`), found 4",
        ),
        (
            "*LINE SECTION GROUPS\n NAME=g\n SECTION=a, 1\n ADDITIONAL= ,\n",
            "5:2 SYN003 ADDITIONAL= has no value",
        ),
        (
            "*LINE PATH SECTIONS\n LINE=x\n SECTION=, 1\n",
            "4:10 SYN003 set is missing: expected a name",
        ),
        (
            "*LINE PATH SECTIONS\n LINE=x\n SECTION=a, 0, 1, REPAT=g\n",
            "4:19 SYN004 REPAT= does not belong on this line (did you mean REPEAT?): expected SECTION=, REPEAT=",
        ),
        (
            "*LINE PATH SECTIONS\n LINE=x\n 1, 2\n",
            "4:2 SYN001 *LINE PATH SECTIONS has no place for a row here: expected LINE= or SECTION=",
        ),
    ],
)
def test_faults(lines: str, fault: str) -> None:
    assert fault in faults("$MODEL\n" + lines)


# --------------------------------------------------------------------------------------------------------------- kept


@pytest.mark.parametrize("kept", OPAQUE, ids=lambda kept: kept.keyword)
def test_what_a_kept_keyword_says_of_itself(kept: OpaqueKeyword) -> None:
    name = kept.keyword
    assert kept.sections == ("MODEL",) == catalogue.sections_of(name)
    assert catalogue.opaque_keyword("MODEL", name) is kept
    assert catalogue.block_class("MODEL", name) is None
    assert name in catalogue.keywords()
    assert all(words.endswith(".") for words in (kept.summary, kept.certain, kept.inferred))
    assert set(kept.makes) <= {"NODE", "ELEMENT", "ELEMENT SETS"}
    assert all(key in kept.inferred for key in (f"{key}=" for key in kept.name_settings))
    assert ("ELEMENT SETS" in kept.makes) <= (Names.SET in kept.name_settings.values())


@given(st.sampled_from([kept.keyword for kept in OPAQUE]), st.lists(texts, max_size=5))
@example("LINES", ["\ufeff$"])
def test_nothing_of_a_kept_block_is_lost(keyword: str, lines: list[str]) -> None:
    text = f"$MODEL\n*{keyword}\n" + "".join(f"{no_head(line)}\n" for line in lines)
    deck = deck_of(text)
    assert {problem.code.code for problem in deck.problems} == ({"SYN012"} if "\ufeff" in text else set())
    held(deck)
    assert dump(deck, "keyword") == text
