"""What is told of JSON and YAML decks beyond the schema: unknown and misplaced blocks, stray lines, too many faults."""

from __future__ import annotations

import json
from typing import Any

import pytest

from mudline.basics.limits import MOST_REPORTED
from mudline.checks.engine import lint_bytes
from mudline.checks.registry import rules
from mudline.language.deck.loading import dump, load_bytes
from mudline.language.deck.model import Deck, Opaque, Section
from mudline.language.diagnostics import DeckError, Diagnostic
from mudline.language.keywords.fields import Comment
from mudline.language.keywords.library.ocean import Ocean

Document = dict[str, Any]


def made(*sections: Document, **rest: object) -> Document:
    return {"format": "mudline-deck/1", **rest, "sections": list(sections)}


def section(*blocks: Document, name: str = "MODEL", **rest: object) -> Document:
    return {"name": name, **rest, "blocks": list(blocks)}


def read(document: Document) -> Deck:
    return load_bytes(json.dumps(document, indent=1).encode(), "a.json")


def told(document: Document) -> list[Diagnostic]:
    deck = read(document)
    return deck.diagnose(deck.problems)


def refused(document: Document) -> tuple[Diagnostic, ...]:
    with pytest.raises(DeckError) as caught:
        read(document)
    return caught.value.diagnostics


OCEAN = {"keyword": "OCEAN", "depth": 100.0}

TOLD: list[tuple[Document, str, str, str]] = [
    (made(section({"keyword": "WAVE", "lines": []})), "SYN008", '"keyword": "WAVE"', "belongs in $LOAD CASE"),
    (made(section({"keyword": "ocaen", "lines": []})), "SYN009", '"keyword": "ocaen"', "did you mean OCEAN?"),
    (made(section(name="MODLE")), "SYN010", '"name": "MODLE"', "did you mean MODEL?"),
    (made(section(OCEAN, lines=["C x", "stray", "1, 2"])), "SYN011", '"stray"', "2 lines of $MODEL"),
    (made(preamble=["C x", "", "a title"]), "SYN011", '"a title"', "1 line before the first section"),
    (made(preamble=["C x", "*OCEAN", " 1.0"]), "SYN007", '"*OCEAN"', "put it in its section, $MODEL"),
]


@pytest.mark.parametrize(("document", "code", "line", "words"), TOLD)
def test_the_same_is_told_as_of_a_text(document: Document, code: str, line: str, words: str) -> None:
    (found,) = told(document)
    assert (found.code, words in found.message) == (code, True)
    lines = json.dumps(document, indent=1).splitlines()
    assert line in "".join(lines[found.line - 1 : found.line + 1])
    text = dump(read(document), "keyword")
    again = load_bytes(text.encode(), "a.keyxm")
    assert [(one.code, one.message) for one in again.diagnose(again.problems)] == [(code, found.message)]


@pytest.mark.parametrize(
    "document",
    [
        {"format": "mudline-deck/1", "sections": [5] * (2 * MOST_REPORTED)},
        made(section(*[{"keyword": "X"}] * (2 * MOST_REPORTED))),
        made(*[section(name="a\nb")] * (2 * MOST_REPORTED)),
        made(**{f"x{number}": 1 for number in range(2 * MOST_REPORTED)}),
    ],
)
def test_of_very_many_faults_a_thousand_are_listed(document: Document) -> None:
    found = refused(document)
    assert len(found) == MOST_REPORTED + 1
    assert sum("and more of the same" in one.message for one in found) == 1


MANY = 100_000
LISTS: list[tuple[str, Document]] = [
    ("comments", {"keyword": "OCEAN", "depth": 1.0, "comments": [{}] * MANY}),
    ("curves", {"keyword": "SEABED STIFFNESS", "curves": [{}] * MANY}),
    (
        "sets[0].members[0].elements",
        {"keyword": "ELEMENT SETS", "sets": [{"name": "a", "members": [{"elements": [1] * 32 + [None] * MANY}]}]},
    ),
]


@pytest.mark.parametrize(("path", "block"), LISTS)
def test_a_list_of_faults_is_not_looked_at_to_its_end(path: str, block: Document) -> None:
    found = refused(made(section(block)))
    assert 32 < len(found) < 100
    assert found[-1].message.startswith(f"sections[0].blocks[0].{path}[{64 if 'sets' in path else 32}]: not checked")


def test_raw_lines_of_a_keyword_with_a_model_are_read() -> None:
    deck = read(made(section({"keyword": "ocean", "lines": ["C a", " 100, 1025", "C b"]}, OCEAN)))
    ocean = Ocean(depth=100.0, density=1025.0, comments=[Comment(before=0, text=" a")])
    assert deck.sections[0].blocks == [ocean, Ocean(depth=100.0)]
    assert dump(deck, "keyword") == "$MODEL\n*OCEAN\nC a\n 100.0, 1025.0\nC b\n*OCEAN\n 100.0\n"
    assert deck.problems == []


def test_faults_and_doubts_of_raw_lines_are_told_at_their_line() -> None:
    lines = ["C a", " 1x", " 2"]
    document = made(section({"keyword": "OCEAN", "lines": lines}))
    text = json.dumps(document, indent=1).splitlines()
    assert [(one.code, text[one.line - 1].strip(" ,")) for one in told(document)] == [
        ("SYN002", '" 1x"'),
        ("SYN001", '" 2"'),
    ]
    (doubt,) = told(made(section({"keyword": "NODE", "lines": [" 1, 0, 0", "Cold", " 2, 0, 1"]})))
    assert doubt.code == "SYN013"
    assert doubt.line == 11


@pytest.mark.parametrize("line", ["$MODEL", " *NODE"])
def test_raw_lines_open_nothing(line: str) -> None:
    for document, path in (
        (made(section({"keyword": "TITLE", "lines": ["x", line]})), "sections[0].blocks[0].lines[1]"),
        (made(section(lines=["x", line])), "sections[0].lines[1]"),
    ):
        (found,) = refused(document)
        assert found.message.startswith(path)
    assert refused(made(preamble=["$MODEL"]))[0].message.startswith("preamble[0]")


def test_comments_find_the_place_that_keyword_text_gives_them() -> None:
    comments = [{"before": number, "text": f" deck {number}"} for number in (9, 1, 0)]
    inner = [{"before": number, "text": f" {number}"} for number in (7, 0, 1)]
    opaque = {"keyword": "TITLE", "lines": ["x"]}
    deck = read(made(section(OCEAN, comments=inner), section(opaque, comments=inner), section(), comments=comments))
    assert deck.preamble == ["C deck 0"]
    assert dump(deck, "keyword").splitlines() == [
        *("C deck 0", "$MODEL", "C 0", "*OCEAN", " 100.0", "C 1", "C 7", "C deck 1"),
        *("$MODEL", "C 0", "*TITLE", "x", "C 1", "C 7", "$MODEL", "C deck 9"),
    ]
    again = load_bytes(dump(deck, "keyword").encode(), "a.keyxm")
    assert (again.sections, again.comments, again.preamble) == (deck.sections, deck.comments, deck.preamble)
    assert read(made(comments=comments)).preamble == ["C deck 0", "C deck 1", "C deck 9"]


@pytest.mark.parametrize(
    ("path", "document"),
    [
        ("source", made(source="\ud800")),
        ("preamble[0]", made(preamble=["a\udfff"])),
        ("sections[0].blocks[0].depth", made(section({"keyword": "OCEAN", "depth": "=[\ud800]"}))),
        ("sections[0]", made({"name": "MODEL", "blocks": [], "\ud800": 1})),
        (
            "sections[0].blocks[0].entries[0].nodes[0][1]",
            made(section({"keyword": "NODE", "entries": [{"nodes": [[1, "=[\ud800]", 0.0]]}]})),
        ),
    ],
)
def test_half_a_surrogate_pair_is_refused(path: str, document: Document) -> None:
    (found,) = refused(document)
    assert (found.code, found.message.partition(":")[0]) == ("DOC001", path)


def test_a_number_of_too_many_digits_is_found() -> None:
    for text, name in ((f"a:\n b: {'7' * 5000}", "a.yaml"), (f'{{"a":\n  {"7" * 5000}}}', "a.json")):
        with pytest.raises(DeckError) as caught:
            load_bytes(text.encode(), name)
        (found,) = caught.value.diagnostics
        assert (found.code, found.line) == ("DOC001", 2)
        assert found.message == "a whole number of 5000 digits is too large"


@pytest.mark.parametrize("form", ["json", "yaml"])
def test_a_file_name_that_is_not_utf_8_is_escaped(form: str) -> None:
    deck = load_bytes(b"$MODEL\n", "deck-\udcff.keyxm")
    again = load_bytes(dump(deck, form).encode(), f"a.{form}")
    assert again.source == "deck-\\udcff.keyxm"


def test_a_fault_in_a_block_of_rows_is_told_at_its_row() -> None:
    rows = "0, 0\n\n  1, 1\n2, q\n"
    stiffness = {"keyword": "SEABED STIFFNESS", "curves": [{"name": "a", "points": rows}]}
    text = "format: mudline-deck/1\nsections:\n- name: MODEL\n  blocks:\n  - keyword: SEABED STIFFNESS\n    curves:\n"
    text += "    - name: a\n      points: |\n        0, 0\n\n          1, 1\n        2, q\n"
    with pytest.raises(DeckError) as caught:
        load_bytes(text.encode(), "a.yaml")
    (found,) = caught.value.diagnostics
    assert (found.line, found.message.partition(":")[0]) == (12, "sections[0].blocks[0].curves[0].points[2][1]")
    (same,) = refused(made(section(stiffness)))
    assert same.message == found.message


POINTS = [[0, 0], [1, 2]]

UNSAYABLE: list[tuple[str, Document]] = [
    ("curves[0].name", {"keyword": "SEABED STIFFNESS", "curves": [{"name": "a, b", "points": POINTS}]}),
    ("curves[0].name", {"keyword": "SEABED STIFFNESS", "curves": [{"name": " a", "points": POINTS}]}),
    ("curves[0].points", {"keyword": "EMBEDMENT", "curves": [{"set": "a", "points": POINTS}, {"points": POINTS}]}),
    ("entries[0]", {"keyword": "NODE", "entries": [{"nodes": []}]}),
    ("entries[0].nodes[0]", {"keyword": "NODE", "entries": [{"nodes": [["=[a], b=[c]", 0, 0]]}]}),
    ("sets[0].stiffness", {"keyword": "SEABED PROPERTIES", "sets": [{"set": "a", "stiffness": "12"}]}),
    ("depth", {"keyword": "OCEAN", "depth": "=[a], 2, =[b]"}),
]


@pytest.mark.parametrize(("path", "block"), UNSAYABLE)
def test_what_keyword_text_cannot_say_is_refused(path: str, block: Document) -> None:
    deck = read(made(section(block)))
    assert dump(deck, "yaml")
    with pytest.raises(DeckError) as caught:
        dump(deck, "keyword")
    (found,) = caught.value.diagnostics
    assert found.message.startswith(f"sections[0].blocks[0].{path}")
    assert "cannot be written as keyword text" in found.message


def remark(text: str) -> list[Comment]:
    """A comment that no document could hold."""
    return [Comment.model_construct(before=1, text=text)]


@pytest.mark.parametrize(
    ("path", "deck"),
    [
        ("preamble[1]", Deck("a", preamble=["x", "$MODEL"])),
        ("preamble[0]", Deck("a", preamble=["a\nb"])),
        ("sections[0].name", Deck("a", sections=[Section("A\n$B")])),
        ("sections[0].name", Deck("a", sections=[Section("model")])),
        ("sections[0].lines[0]", Deck("a", sections=[Section("MODEL", lines=["C x"])])),
        ("sections[0].blocks[0].lines[1]", Deck("a", sections=[Section("A", [Opaque(keyword="B", lines=["", "$C"])])])),
        ("sections[0].blocks[0].keyword", Deck("a", sections=[Section("A", [Opaque(keyword="b", lines=[])])])),
        ("sections[0] ", Deck("a", sections=[Section("A", comments=remark("\n*B"))])),
        ("sections[0] ", Deck("a", sections=[Section("A")], comments=remark("\n$B"))),
    ],
)
def test_decks_made_by_a_program_are_tried_too(path: str, deck: Deck) -> None:
    with pytest.raises(DeckError) as caught:
        dump(deck, "keyword")
    message = caught.value.diagnostics[0].message
    assert message.startswith(path)
    assert "cannot be written as keyword text" in message


ONE_SHAPE: list[tuple[Document, list[str]]] = [
    ({"nodes": [[1, -0.004]]}, ["nodes[0]: 2 fields, expected 3 to 4"]),
    ({"nodes": [[1, 0.0, 0.0]], "colour": "red"}, ["colour: unknown key"]),
    ({"generate": [1, 2, 3, 4]}, ["generate: 4 values, expected start, end [, increment]"]),
    ({"nodez": []}, ["nodez: unknown key (did you mean nodes?)"]),
]


@pytest.mark.parametrize(("entry", "messages"), ONE_SHAPE)
def test_of_several_shapes_the_one_with_its_mandatory_key_is_meant(entry: Document, messages: list[str]) -> None:
    found = refused(made(section({"keyword": "NODE", "entries": [entry]})))
    assert [one.message.removeprefix("sections[0].blocks[0].entries[0].") for one in found] == messages


@pytest.mark.parametrize(
    ("data", "place"),
    [(b'{"name": "M\xfcller"}', (1, 12)), (b'\xef\xbb\xbf{\r\n "\xc3\xa4\xc3\xa4": "M\xfcller"}', (2, 10))],
)
def test_a_byte_that_is_not_utf8_is_told_where_it_stands(data: bytes, place: tuple[int, int]) -> None:
    for name, form in (("a.json", "JSON"), ("a.yaml", "YAML")):
        with pytest.raises(DeckError) as caught:
            load_bytes(data, name)
        (found,) = caught.value.diagnostics
        assert (found.code, found.line, found.column, found.end_column) == ("DOC001", *place, place[1] + 1)
        assert found.message == f"byte 0xFC is not UTF-8, which {form} has to be: save the file as UTF-8"


def test_a_whole_number_beyond_doubles_is_told_as_that() -> None:
    entry = {"set": "ALL", "stiffness": 10**309}
    (found,) = refused(made(section({"keyword": "SEABED PROPERTIES", "type": "ELASTIC", "sets": [entry]})))
    assert found.message.startswith("sections[0].blocks[0].sets[0].stiffness: expected a number or a text, found 1000")
    assert found.message.endswith("..., too large for double precision")


def test_what_is_joined_in_a_text_is_joined_in_a_document() -> None:
    text = (
        "$MODEL\n*OCEAN\n 100.0, 1025.0, 9.81\n*SEABED STIFFNESS\n CURVE=Clay\n 0.0, 0.0\n 0.1, 700.0\n 0.5, -1500.0\n"
    )
    deck = load_bytes(text.encode(), "deck.keyxm")
    forms = {"deck.keyxm": text, "deck.yaml": dump(deck, "yaml"), "deck.json": dump(deck, "json")}
    codes = {name: [one.code for one in lint_bytes(form.encode(), name, rules())] for name, form in forms.items()}
    assert "CRV012" in codes["deck.keyxm"]
    assert "CRV005" not in codes["deck.keyxm"]
    assert codes["deck.yaml"] == codes["deck.json"] == codes["deck.keyxm"]
