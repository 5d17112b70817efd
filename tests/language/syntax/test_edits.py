"""Edits of a text: all at once, in any order, none twice; what they do not touch keeps its bytes."""

from __future__ import annotations

import re
from random import Random

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from mudline.language.diagnostics import Span
from mudline.language.syntax.edits import (
    OverlapError,
    TextEdit,
    Undoing,
    apply_edits,
    edited_bytes,
    line_end_before,
)
from mudline.language.syntax.source import Source

BOM = b"\xef\xbb\xbf"


def edit(start: int, end: int, text: str) -> TextEdit:
    return TextEdit(Span(start, end), text)


def source(data: bytes) -> Source:
    return Source.from_bytes(data, "deck.keyxm")


@pytest.mark.parametrize(
    ("edits", "expected"),
    [
        ([], "abcdef"),
        ([edit(0, 0, "x")], "xabcdef"),
        ([edit(6, 6, "x")], "abcdefx"),
        ([edit(0, 6, "")], ""),
        ([edit(4, 5, "Y"), edit(1, 2, "XX")], "aXXcdYf"),
        ([edit(3, 3, "1"), edit(3, 3, "2"), edit(3, 3, "3")], "abc123def"),
        ([edit(3, 5, "R"), edit(3, 3, "i"), edit(1, 3, "L")], "aLiRf"),
        ([edit(5, 5, "i"), edit(3, 5, "R")], "abcRif"),
    ],
)
def test_edits_are_made_all_at_once(edits: list[TextEdit], expected: str) -> None:
    assert apply_edits("abcdef", edits) == expected


@pytest.mark.parametrize(
    "edits",
    [
        [edit(1, 3, "x"), edit(2, 4, "y")],
        [edit(1, 3, "x"), edit(1, 3, "x")],
        [edit(1, 4, "x"), edit(2, 2, "y")],
        [edit(0, 6, ""), edit(2, 3, "")],
    ],
)
def test_overlapping_edits_are_refused(edits: list[TextEdit]) -> None:
    with pytest.raises(OverlapError, match=r"edits overlap: \(\d, \d\) and \(\d, \d\)") as caught:
        apply_edits("abcdef", reversed(edits))
    assert {str(tuple(edit.span)) for edit in edits} >= set(re.findall(r"\(.*?\)", str(caught.value)))


@pytest.mark.parametrize(
    ("text", "offset", "end"),
    [
        ("a\r\nb\nc\rd", 0, "\r\n"),
        ("a\r\nb\nc\rd", 3, "\r\n"),
        ("a\r\nb\nc\rd", 4, "\r\n"),
        ("a\r\nb\nc\rd", 5, "\n"),
        ("a\r\nb\nc\rd", 7, "\r"),
        ("a\r\nb\nc\rd", 8, "\r"),
        ("\rb", 0, "\r"),
        ("abc", 2, "\n"),
        ("", 0, "\n"),
    ],
)
def test_the_line_end_of_the_nearest_line_before(text: str, offset: int, end: str) -> None:
    assert line_end_before(source(text.encode()), offset) == end


def test_inserted_lines_end_as_the_line_before_them() -> None:
    mixed = source(b"one\r\ntwo\nthree\rfour")
    edits = [edit(5, 5, "x\ny\n"), edit(9, 9, "x\ny\n"), edit(15, 15, "x\ny\r\n"), edit(0, 3, "1\n1")]
    assert edited_bytes(mixed, edits) == b"1\r\n1\r\nx\r\ny\r\ntwo\nx\ny\nthree\rx\ry\r\nfour"


def test_the_encoding_and_the_mark_stay() -> None:
    assert edited_bytes(source(BOM + b"C \xc3\xa9\r\n"), [edit(3, 3, " \xfc")]) == BOM + b"C \xc3\xa9 \xc3\xbc\r\n"
    assert edited_bytes(source(b"C \xe9 \x80\r\n"), [edit(0, 1, "\u20ac\n")]) == b"\x80\r\n \xe9 \x80\r\n"
    with pytest.raises(UnicodeEncodeError):
        edited_bytes(source(b"C \xe9\r\n"), [edit(0, 1, "\u2028")])


_texts = st.text("ab\r\n\xe9", max_size=12)


@given(st.lists(st.tuples(_texts, _texts, _texts), max_size=6), _texts, st.randoms(use_true_random=False))
def test_a_text_is_its_kept_pieces_and_the_new_ones(
    pieces: list[tuple[str, str, str]], last: str, shuffled: Random
) -> None:
    text, expected = "", ""
    edits: list[TextEdit] = []
    for kept, old, new in pieces:
        start = len(text) + len(kept)
        edits.append(edit(start, start + len(old), new))
        text += kept + old
        expected += kept + new
    assert apply_edits(text + last, edits) == expected + last
    places = [found.span for found in edits]
    if len(set(places)) == len(places):
        shuffled.shuffle(edits)
        assert apply_edits(text + last, edits) == expected + last


@st.composite
def some_edits(draw: st.DrawFn) -> list[TextEdit]:
    """Edits of a text of 40 characters that do not overlap."""
    bounds = sorted(draw(st.lists(st.integers(0, 40), min_size=2, max_size=12)))
    texts = st.sampled_from(["", "x", "yy\n", "z" * 7])
    return [edit(a, b, draw(texts)) for a, b in zip(bounds[::2], bounds[1::2], strict=False)]


def one_by_one(span: Span, edits: list[TextEdit]) -> Span:
    """The span before the edits, from one edit to the next."""
    start, end = span
    for one in edits:
        if one.span.start >= end:
            break
        grown = len(one.text) - (one.span.end - one.span.start)
        if one.span.start < start + (not one.text):
            start = max(start - grown, one.span.start)
        end = max(end - grown, one.span.start)
    return Span(start, max(start, end))


@given(some_edits(), st.integers(0, 60), st.integers(0, 20))
@example([edit(10, 10, "x")], 9, 1)  # it ends where the new text begins
@example([edit(10, 10, "x\n")], 10, 0)
def test_places_of_an_edited_text_are_led_back(edits: list[TextEdit], start: int, length: int) -> None:
    place, undoing = Span(start, start + length), Undoing(reversed(edits))
    assert undoing.before(place) == one_by_one(place, edits)
    grown, touched, new = 0, False, False
    for one in edits:
        at = Span(one.span.start + grown, one.span.start + grown + len(one.text))
        grown += len(one.text) - (one.span.end - one.span.start)
        touched |= start < at.end and at.start < max(place.end, start + 1)
        whole_lines = one.span.start == one.span.end and one.text.endswith("\n")
        new |= whole_lines and at.start <= start < place.end < at.end
    assert (undoing.touches(place), undoing.is_in_new_lines(place)) == (touched, new)
