"""What is no difference."""

from __future__ import annotations

import random
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.comparison.comparing import compare
from mudline.deck.loading import dump, load_bytes, load_path
from mudline.scene.model import resolve
from tests.builders.decks import ordered_deck
from tests.builders.scenes import differences

SAMPLES = Path(__file__).parents[2] / "samples"
NAMES = sorted(path.name for path in SAMPLES.glob("*.key*") if path.name != "broken.keyxm")


@given(st.randoms(use_true_random=False))
def test_a_shuffled_deck_means_the_same(chance: random.Random) -> None:
    def shuffled(items: list[str]) -> list[str]:
        return chance.sample(items, len(items))

    assert differences(ordered_deck(), ordered_deck(shuffled)) == []


@given(st.sets(st.integers(0, 35)))
def test_comments_and_blank_lines_are_no_difference(places: set[int]) -> None:
    lines = ordered_deck().splitlines()
    for place in sorted(places, reverse=True):
        lines[place + 4 : place + 4] = ["C a note"] if place % 2 else [""]
    assert differences(ordered_deck(), "\n".join(lines) + "\n") == []


@pytest.mark.parametrize("form", ["keyword", "json", "yaml"])
@pytest.mark.parametrize("name", NAMES)
def test_a_converted_deck_means_the_same(name: str, form: str) -> None:
    text = dump(load_path(SAMPLES / name), form)
    suffix = Path(name).suffix if form == "keyword" else f".{form}"
    assert (
        compare(resolve(load_path(SAMPLES / name)), resolve(load_bytes(text.encode(), f"b{suffix}", folder=SAMPLES)))
        == []
    )


@pytest.mark.parametrize(
    ("written", "other"),
    [
        (" 3, 0.3, 20.0", " 3, 3e-1, 2.0E1"),
        ("SET=Pipe\n STIFFNESS", "SET=PIPE\n STIFFNESS"),
        ("STIFFNESS=Clay", "stiffness=CLAY"),
        ("=[od]", "0.5"),
        (" SET=Pipe\n 1, 2", " SET=Pipe\n GEN=1, 2"),
        ("*NODE\n 1, -0.1, 0.0\n", "*NODE\n 1, -0.1, 0.0\n*NODE\n"),
    ],
)
def test_another_way_to_write_it(written: str, other: str) -> None:
    text = ordered_deck()
    assert written in text
    assert differences(text, text.replace(written, other)) == []


def test_records_in_another_block_mean_the_same() -> None:
    apart = ordered_deck().replace(" SET=Rest\n STIFF", "*SEABED PROPERTIES\n SET=Rest\n STIFF")
    assert differences(ordered_deck(), apart) == []


def test_a_tolerance() -> None:
    near = (
        ordered_deck()
        .replace("0.3, 20.0", "0.3000001, 20.0")
        .replace("3000.0", "3000.0001")
        .replace("50000.0", "50000.01")
    )
    assert differences(ordered_deck(), near, 1e-6) == []
    assert len(differences(ordered_deck(), near)) > 2
