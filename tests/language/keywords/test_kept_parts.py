"""Lines of forms that are not public: in open blocks and behind a TYPE= they stay where they stand, in every form."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.language.deck.loading import dump, load_bytes
from mudline.language.diagnostics import Severity
from mudline.language.keywords import catalogue
from mudline.language.keywords.contents import OpenBlock, is_read, keeps_lines, kept_places, openers
from mudline.language.keywords.model import Block, Record, record_schema
from tests.helpers.builders.scenes import deck_of, faults

BOUNDARY = """\
$LOAD CASE
*BOUNDARY
 TYPE=VESSEL
C of the vessel
 12, Semi
C between
 VESSEL=Semi, 3
 TYPE=CONSTANT
 1, 2
 TYPE=RAMPED, FROM=2
"""
FRICTION = """\
$LOAD CASE
*FRICTION
C first
 MODES=3
 1.0, 2.0
C then
 1, 2, Mode
 Nowhere
"""


def only(text: str) -> Block:
    (block,) = deck_of(text).sections[0].blocks
    assert isinstance(block, Block)
    return block


@pytest.mark.parametrize("text", [BOUNDARY, FRICTION])
@pytest.mark.parametrize("form", ["json", "yaml", "keyword"])
def test_kept_lines_stay_in_their_place_in_every_form(text: str, form: str) -> None:
    deck = deck_of(text)
    assert [problem for problem in deck.problems if problem.weight is not Severity.INFO] == []
    again = load_bytes(dump(deck, form).encode(), "deck.keyxm" if form == "keyword" else f"deck.{form}")
    assert again.sections == deck.sections
    assert dump(again, "keyword") == text


def test_a_part_that_is_not_public_is_kept_and_the_others_are_read() -> None:
    block = only(BOUNDARY)
    assert block.model_dump(exclude_defaults=True) == {
        "types": [
            {
                "type": "VESSEL",
                "comments": [{"before": 0, "text": " of the vessel"}],
                "unread": [
                    {"before": 0, "text": " 12, Semi"},
                    {"before": 0, "text": "C between"},
                    {"before": 0, "text": " VESSEL=Semi, 3"},
                ],
            },
            {"type": "CONSTANT", "entries": [{"node": 1, "dof": 2}]},
            {"type": "RAMPED, FROM=2"},
        ]
    }
    assert not is_read(block)
    assert is_read(only("$LOAD CASE\n*BOUNDARY\n TYPE=CONSTANT\n 1, 2\n"))


UNKNOWN = [
    ("LOAD CASE", "*BOUNDARY\n TYPE=OTHER\n 1, 1\n garbage here\n", "4:7", "TYPE="),
    ("LOAD CASE", "*WAVE-JONSWAP\n FREQUENCY=AREA, SPEC=OTHER\n garbage here\n", "4:23", "SPEC="),
    ("MODEL", "*HYDRODYNAMIC SETS\n SET=ALL, TYPE=OTHER\n garbage here\n", "4:16", "TYPE="),
    ("MODEL", "*P-Y\n TYPE=OTHER\n garbage here\n", "4:7", "TYPE="),
]


@pytest.mark.parametrize(
    ("section", "lines", "place", "key"), UNKNOWN, ids=[lines.split("\n")[0] for _, lines, *_ in UNKNOWN]
)
def test_a_word_that_is_not_known_is_told_where_the_lines_behind_it_are_not_read(
    section: str, lines: str, place: str, key: str
) -> None:
    message = f"'OTHER' is not known for {key}, and what it stands for is passed through unchanged"
    text = f"C a deck\n${section}\n{lines}"
    assert faults(text) == [f"{place} SYN005 {message}"]
    assert [problem.weight for problem in deck_of(text).problems] == [Severity.INFO]


@pytest.mark.parametrize(
    "lines", ["*BOUNDARY\n TYPE=VESSEL\n 12, Semi\n", "*LOAD\n TYPE=OTHER\n 1, 2\n", "*ANALYSIS TYPE\n TYPE=OTHER\n"]
)
def test_a_word_is_not_told_where_lines_behind_a_known_one_would_not_be_read_either(lines: str) -> None:
    assert faults(f"$LOAD CASE\n{lines}") == []


def test_a_type_that_is_nearly_a_known_one_is_told() -> None:
    (told,) = faults("$LOAD CASE\n*BOUNDARY\n TYPE=VESEL\n 12, Semi\n")
    assert told.startswith("3:7 SYN005 'VESEL' is not known for TYPE= (did you mean VESSEL?)")


def test_lines_of_an_open_block_that_are_certainly_wrong_are_told() -> None:
    head = "$LOAD CASE\n*FRICTION\n"
    assert faults(head + " 1.O, 2.0\n")[0].startswith("3:2 SYN002")
    assert faults(head + " 1, 5, 2\n")[0].startswith("3:2 SYN003")
    assert faults("$LOAD CASE\n*RESTART\n LAST=a\n TYP=b\n")[0].startswith("4:2 SYN004 *RESTART has no setting TYP=")
    assert not is_read(only(head + " MODE=3\n"))
    places = kept_places(only(head + " MODE=3\n 1, 2\n word\n"))
    assert [line for _, line in places] == [" MODE=3", " word"]


@given(
    st.lists(st.sampled_from([" 1.0, 2.0", " MODE=3", "C x", " 1, Mode 3", " word", " ,", "", " a=b, c=d"]), max_size=8)
)
def test_any_lines_of_an_open_block_go_through_every_form(lines: list[str]) -> None:
    deck = deck_of("\n".join(["$LOAD CASE", "*FRICTION", *lines, ""]))
    for form in ("json", "yaml"):
        again = load_bytes(dump(deck, form).encode(), f"deck.{form}")
        assert again.sections == deck.sections
    text = dump(deck, "keyword")
    assert dump(deck_of(text), "keyword") == text


@pytest.mark.parametrize("block", catalogue.block_classes())
def test_every_record_of_an_open_block_keeps_lines_lines(block: type[Block]) -> None:
    records = list(_records(block))
    if block.open_lines:
        assert issubclass(block, OpenBlock)
        assert all("unread" in record.model_fields for record in records if len(record_schema(record).slots) > 1)
    for record in [block, *records]:
        governing = [slot for slot in record_schema(record).slots if slot.about.opaque is not None]
        assert not governing or "unread" in record.model_fields
        assert all(slot.key in openers(block) for slot in governing)
    assert keeps_lines(block) == any("unread" in record.model_fields for record in [block, *records])


def _records(part: type[Record]) -> list[type[Record]]:
    own = [record for slot in record_schema(part).slots for record in slot.record.values()]
    return [*own, *(inner for record in own for inner in _records(record))]
