"""Names that lines give: element sets and labels are known, and what is nearly one of them is told."""

from __future__ import annotations

import json
from collections.abc import Iterator

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from mudline.language.deck.loading import load_bytes
from mudline.language.deck.model import Deck
from mudline.language.deck.parameters import name_key
from mudline.language.diagnostics import Span
from mudline.language.keywords.values import LINE_SETS, Names
from mudline.language.syntax import fields
from mudline.language.syntax.fields import read_line
from mudline.model.scene.deck_values import first_written, sets_in, texts_in
from tests.helpers.builders.decks import PIPE
from tests.helpers.builders.scenes import messages, reported
from tests.helpers.builders.spellings import names, pads, setting, texts
from tests.helpers.growth import FOURFOLD, TWOFOLD, call_growth, growth

LINES = "*LINES\n LINE=SCR\n"


def deck_of(text: str) -> Deck:
    return load_bytes(f"$MODEL\n{text}".encode(), "deck.keyxm")


def sets_of(text: str) -> list[str]:
    return list(first_written(deck_of(text), sets_in).values())


def labels_of(text: str) -> list[str]:
    return list(first_written(deck_of(text), texts_in).values())


# ----------------------------------------------------------------------------------------------------------------- sets


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("*LINES\n LINE=SCR\n SECTION=Top, 100.0\n ADDITIONAL=Upper, Coated Pipe\n", "SCR Top Upper Coated_Pipe"),
        ("*LINES\n LINE=SCR, SECTION=Top, 100.0, ADDITIONAL=Upper, Coated Pipe,\n", "SCR Top Upper Coated_Pipe"),
        ("*LINES\n  line =  SCR  ,\n Section\t=\tTop\t, 100.0\n", "SCR Top"),
        ("*LINES\n LINE=SCR\n LINE=scr\n SECTION=ScR, 2\n", "SCR"),
        ("*LINES\n NAME=SCR, TYPE=CATENARY, START={Hang-off}\n", "SCR"),
        ('*LINES\n LINE="SCR", SECTION={Top}, 1\n ADDITIONAL="a, b" , {c, d}, e\n', "SCR Top a,_b c,_d e"),
        ("*LINES\n LINE==[if(a, b, c)], 2\n SECTION=A=B, 3\n", "=[if(a,_b,_c)] A=B"),
        ("*LINES\n LINE=\n SECTION=, 3\n ADDITIONAL=, ,\n ADDITIONAL=,a, ,b\n", "a b"),
        ("*LINES\nC LINE=a\nc LINE=b\nC-- LINE=c\nCLINE=d\nC\n100.0, LINE=e\n", "e"),
        ("*LINES\n LINE={open, 2\n", "{open,_2"),
        ("*LINE LOCATIONS\n LINE=SCR\n SECTION=no set, 3\n", "SCR"),
        ("*LINE PATHS\n LINE=Flowline\n 0, 0, 0\n", "Flowline"),
        ("*NODE,CURVILINEAR\n LINE=a\n", ""),
        ("*LINE PATH SECTIONS\n LINE=a\n SECTION=b, 0, 1, REPEAT=no\n ADDITIONAL=c, d\n", "a b c d"),
        ("*LINE SECTION GROUPS\n NAME=a\n SECTION=b, 1\n ADDITIONAL=c, d\n 1, 2, 3\n", "a b c d"),
        ("*LINE SECTION GROUPS\n NAME=a\n SECTION=b\n SECTIN=c, 1\n ADDITIONAL=d\n", "a b d"),
        ("*LINE PATH SECTIONS\n SECTION=b, 1\n LINE=\n LINE=c\n", "b c"),
        ("*P-Y\n LINE=a\n", ""),
        ("$LOAD CASE\n*LINES\n LINE=a\n", ""),
    ],
)
def test_sets(text: str, found: str) -> None:
    assert [name.replace(" ", "_") for name in sets_of(text)] == found.split()


def test_names_of_a_keyword_with_a_model_that_a_document_gives_as_lines() -> None:
    block = {"keyword": "LINE PATH SECTIONS", "lines": [" LINE=a", " SECTION=b, 0, 1", " ADDITIONAL=c, d"]}
    document = {"format": "mudline-deck/1", "sections": [{"name": "MODEL", "blocks": [block]}]}
    assert list(first_written(load_bytes(json.dumps(document).encode(), "deck.json"), sets_in)) == ["a", "b", "c", "d"]


_KEYWORDS = st.sampled_from(["LINES", "LINE PATHS", "LINE PATH SECTIONS", "LINE SECTION GROUPS"])
_CASES = st.sampled_from([str.upper, str.lower, str.title])


@given(_KEYWORDS, names, names, st.lists(names, min_size=1, max_size=4), st.data())
def test_any_name_is_found(keyword: str, line: str, section: str, more: list[str], data: st.DataObject) -> None:
    key = "NAME" if keyword == "LINE SECTION GROUPS" else "LINE"
    listed = ",".join(data.draw(pads) + name + data.draw(pads) for name in more)
    lines = [
        data.draw(setting(key, line)),
        data.draw(setting("SECTION", f"{section}{data.draw(pads)}, 1.0")),
        data.draw(setting("ADDITIONAL", listed + data.draw(st.sampled_from(["", ",", " , ,"])))),
    ]
    block = "".join(f"{text}\n" for text in (f"*{keyword}", *lines))
    found = first_written(deck_of(block), sets_in)
    for name in (line, section, *more):
        assert name_key(name) in found
        seabed = f"*SEABED PROPERTIES\n TYPE=ELASTIC\n SET={data.draw(_CASES)(name)}\n STIFFNESS=1.0\n"
        assert reported(f"$MODEL\n{block}{seabed}") == []


def _slowly(line: str) -> Iterator[str]:
    """The sets of a line of `*LINES`, by the reader of fields."""
    for group in read_line(line, Span(0, len(line))).groups:
        if kind := LINE_SETS.get(group.key):
            yield from (given.text for given in (group.fields if kind is Names.SETS else group.fields[:1]))


_pieces = st.lists(
    st.sampled_from(
        ["LINE", "section", " ADDITIONAL ", "x y", "=", "=", ",", ",", '"', "{", "}", "[", "]", " ", "1.5"]
    ),
    max_size=14,
).map("".join)


@given(_pieces | texts)
@example('ADDITIONAL=a, "b, c" d, {e, "f}, g, LINE={h')
def test_lines_are_cut_as_the_reader_of_fields_does(line: str) -> None:
    line = " " + line.replace("$", "").replace("*", "")
    wanted = {name_key(name) for name in _slowly(line)} - {""}
    assert set(first_written(deck_of(f"*LINES\n{line}\n"), sets_in)) == wanted


@pytest.mark.untraced
@pytest.mark.parametrize("unit", ["a=", '{"'])
def test_no_line_takes_long(unit: str, monkeypatch: pytest.MonkeyPatch) -> None:
    def line(count: int) -> Deck:
        return deck_of(f"*LINES\n LINE={unit * count}\n LINE=SCR\n")

    def opaque_sets(deck: Deck) -> list[dict[str, str]]:
        return [first_written(deck, sets_in), first_written(deck, texts_in)]

    assert call_growth(opaque_sets, line(2_500), line(5_000)) < TWOFOLD
    assert growth(opaque_sets, line(5_000), line(20_000)) < FOURFOLD
    monkeypatch.setattr(fields, "MOST_FIELDS", 10_000)
    assert growth(opaque_sets, line(10_000), line(40_000)) < FOURFOLD  # too many for the reader of fields
    assert ["scr" in found for found in opaque_sets(line(20_000))] == [True, True]


# -------------------------------------------------------------------------------------------------- sets that are named


# -------------------------------------------------------------------------------------------------- what lines may make


def test_the_block_that_may_define_it_is_named() -> None:
    seabed = "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=b\n STIFFNESS=1\n"
    sections = "*LINE PATH SECTIONS\n LINE=x\n"
    assert messages(PIPE + "*LINE LOCATIONS\n x, 2\n*LINE PATHS\n 1\n" + seabed)[0].endswith(
        "*LINE PATHS, which is not read, may define it"
    )
    ending = "the lines of *LINE PATH SECTIONS, which this deck does not show, may define it"
    assert messages(PIPE + sections + seabed)[0].endswith(ending)
    ending = "a line of *LINE PATH SECTIONS that could not be used may define it"
    assert messages(PIPE + LINES + sections + " SECTIN=b, 1\n" + seabed)[0].endswith(ending)
    cable = "*CABLE\n 1, 1, 2, 50.0\n"
    assert reported(PIPE + cable + "*NODE,CURVILINEAR\n 1, 1, 2.0\n" + seabed) == [("E", "REF001", 15, 6)]


# --------------------------------------------------------------------------------------------------------------- labels


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("*LINE LOCATIONS\n LINE=SCR\n Seabed End, 0.0, 1E3\n {Hang-off}, =[x]\n", ["SCR", "Seabed End", "Hang-off"]),
        ('*LINES\n LINE=SCR, START="Seabed End", {Top}\nC {no}\n 1, 2\n', ["SCR", "Seabed End", "Top"]),
        ("*LINE PATHS\n LABEL=a b\n", ["a b"]),
        ("*P-Y\n {no}\n", []),
        ("*LINE SECTION GROUPS\n NAME=no\n", []),
    ],
)
def test_labels(text: str, found: list[str]) -> None:
    assert labels_of(text) == found
