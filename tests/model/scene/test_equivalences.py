"""Decks that say the same in different ways have the same scene."""

from __future__ import annotations

import random

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.model.scene.model import Scene
from tests.helpers.builders.scenes import ends_of, members, nodes_of, scene_of

pytestmark = pytest.mark.slow


_PIPE = "$MODEL\n*NODE\n 1, 0, 0\n 41, 0, 400\n GEN=1, 41\n*ELEMENT\n 1, 1, 2\n GEN=1, 40\n"


_SETS = st.lists(
    st.lists(
        st.one_of(
            st.integers(1, 40).map(str),
            st.tuples(st.integers(1, 40), st.integers(0, 9)).map(lambda p: f"GEN={p[0]}, {min(p[0] + p[1], 40)}"),
            st.integers(0, 5).map(lambda other: f"SUBSET=s{other}"),
        ),
        min_size=1,
        max_size=4,
    ),
    min_size=1,
    max_size=6,
)


@given(_SETS)
def test_sets_are_what_a_search_finds(sets: list[list[str]]) -> None:
    """A set holds what its lines list, and what the lines of every set that it leads to list."""
    text = _PIPE + "*ELEMENT SETS\n"
    direct: dict[int, set[int]] = {}
    leads: dict[int, set[int]] = {}
    for index, lines in enumerate(sets):
        direct[index], leads[index] = set(), set()
        text += f" SET=s{index}\n"
        for line in lines:
            key, _, value = line.rpartition("=")
            if key == "SUBSET":
                other = int(value[1:])
                if other >= index or other >= len(sets):
                    continue  # only backwards: circles have no meaning
                leads[index].add(other)
            else:
                ends = [int(number) for number in value.split(",")]
                direct[index] |= set(range(ends[0], ends[-1] + 1))
            text += f" {line}\n"
    found = members(scene_of(text))
    for index in range(len(sets)):
        reached, waiting = set(), {index}
        while waiting:
            current = waiting.pop()
            reached.add(current)
            waiting |= leads[current] - reached
        assert found[f"s{index}"] == sorted(set().union(*(direct[one] for one in reached)))


BLOCKS = [
    "*OCEAN\n 100, 1025, 9.81\n",
    "*NODE\n 1, -0.1, 0.0\n 11, -0.1, 100.0\n GEN=1, 11\n",
    "*ELEMENT\n 1, 1, 2\n GEN=1, 10\n",
    "*ELEMENT SETS\n SET=West\n GEN=1, 6\n SET=East\n GEN=5, 10\n SET=Both\n SUBSET=West\n SUBSET=East\n",
    "*GEOMETRIC SETS\n OPTION=MOORING\n SET=Both\n 1.0E9, 80.0, 0.3\n SET=East\n 1.0E9, 80.0, 0.4\n",
    "*SEABED STIFFNESS\n CURVE=Clay\n 0.0, 0.0\n 0.5, 4000.0\n CURVE=Sand\n 0.0, 0.0\n 0.5, 9000.0\n",
    "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=Both\n STIFFNESS=Clay\n SET=West\n STIFFNESS=250.0\n",
    "*ELASTIC SURFACE\n 700.0\n",
    "*EMBEDMENT\n SET=East\n 0.0, 0.0\n 1.0, 100.0\n",
]
"""Keywords that do not build on the order in which they stand."""


def same(one: Scene, other: Scene) -> None:
    assert nodes_of(one) == nodes_of(other)
    assert ends_of(one) == ends_of(other)
    assert np.array_equal(one.diameter, other.diameter, equal_nan=True)
    assert np.array_equal(one.length, other.length)
    assert [name.upper() for name in one.law_names] == [name.upper() for name in other.law_names]
    assert [(name or "").upper() for name in one.law_sets] == [(name or "").upper() for name in other.law_sets]
    for first, second in zip(one.contact_input().curves, other.contact_input().curves, strict=True):
        assert np.array_equal(first.forces, second.forces)
    assert [problem.code for problem in one.problems] == [problem.code for problem in other.problems]


@given(st.permutations(BLOCKS))
def test_the_order_of_unrelated_blocks_does_not_matter(blocks: list[str]) -> None:
    same(scene_of("$MODEL\n" + "".join(BLOCKS)), scene_of("$MODEL\n" + "".join(blocks)))


@given(st.randoms(use_true_random=False))
def test_the_case_of_names_does_not_matter(chance: random.Random) -> None:
    text = "$MODEL\n" + "".join(BLOCKS)
    names = ("West", "East", "Both", "Clay", "Sand")
    words = text.replace("=", "= ").replace("\n", " \n").split(" ")
    mixed = [
        "".join(chance.choice((letter.lower(), letter.upper())) for letter in word) if word in names else word
        for word in words
    ]
    same(scene_of(text), scene_of(" ".join(mixed)))
