"""What notebooks show of decks, curves, scenes and results."""

from __future__ import annotations

from html.parser import HTMLParser

import numpy as np
import pytest

import mudline
from mudline.basics.html_repr import html_page, html_table
from mudline.basics.limits import SHOWN_ROWS
from tests.helpers.builders.decks import CLEAN

HOSTILE = "<script>alert('x')</script>&\udc80"


class Cells(HTMLParser):
    """The texts of the cells and headings, and the tags."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.texts: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        del attrs
        self.tags.append(tag)

    def handle_data(self, data: str) -> None:
        self.texts.append(data)


@pytest.fixture(scope="module")
def deck() -> mudline.Deck:
    return mudline.from_keyword(CLEAN)


def test_a_deck_shows_its_keywords(deck: mudline.Deck) -> None:
    texts = Cells(deck._repr_html_()).texts
    assert texts[:2] == ["Deck", " <keyword>, metric"]
    assert [texts[i + 1 : i + 3] for i, text in enumerate(texts) if text == "MODEL"][:2] == [
        ["OCEAN", "1"],
        ["NODE", "1"],
    ]


def test_a_scene_shows_laws_curves_and_sets(deck: mudline.Deck) -> None:
    texts = Cells(deck.scene()._repr_html_()).texts
    for expected in (["elements", "2"], ["curve:Clay", "2"], ["Clay", "3", "3000"], ["Pipe", "2"]):
        assert any(texts[i : i + len(expected)] == expected for i in range(len(texts))), expected


def test_a_result_shows_touchdown(deck: mudline.Deck) -> None:
    scene = deck.scene()
    contact = scene.contact()
    texts = Cells(contact.evaluate()._repr_html_()).texts
    assert texts[:2] == ["ContactResult", " 2 elements, 3 nodes, metric"]
    assert texts[2:6] == ["line", "touchdown_points", "touchdown point [m]", "last touchdown point [m]"]
    assert texts[-9:] == ["1", "1", "12.502", "12.502", "12.502", "1500", "1", "15000", "3481.78"]
    series = contact.evaluate(np.repeat(scene.coordinates[None], 50, axis=0), times=np.arange(50.0))
    texts = Cells(series._repr_html_()).texts
    assert texts[1] == " 50 steps, 2 elements, 3 nodes, metric"
    assert texts[2] == "time [s]"
    assert (texts.count("12.502"), texts[-1]) == (3 * SHOWN_ROWS, f"... and {50 - SHOWN_ROWS} more")


def test_hostile_texts_are_escaped_and_long_ones_cut() -> None:
    text = html_page(HOSTILE, HOSTILE, html_table([HOSTILE], [[HOSTILE], ["y" * 1000]], 2))
    assert set(Cells(text).tags) == {"div", "p", "b", "table", "thead", "tbody", "tr", "th", "td"}
    assert Cells(text).texts[0] == HOSTILE.replace("\udc80", "\\udc80")
    assert len(text) < 700
    text.encode()
