"""The known name nearest to a misspelt one, and what finding it costs."""

from __future__ import annotations

from collections.abc import Callable
from itertools import product
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

import mudline
from mudline.basics.spelling import Effort, edits, nearest
from tests.helpers.growth import TWOFOLD, call_growth, calls

WORDS = st.text("abcd", max_size=7)


def plain_edits(one: str, other: str) -> int:
    """The whole table of the distance with swaps of neighbours."""
    table = {(i, 0): i for i in range(len(one) + 1)} | {(0, j): j for j in range(len(other) + 1)}
    for i, j in product(range(1, len(one) + 1), range(1, len(other) + 1)):
        changed = one[i - 1] != other[j - 1]
        table[i, j] = min(table[i - 1, j] + 1, table[i, j - 1] + 1, table[i - 1, j - 1] + changed)
        if i > 1 and j > 1 and one[i - 1] == other[j - 2] and one[i - 2] == other[j - 1]:
            table[i, j] = min(table[i, j], table[i - 2, j - 2] + 1)
    return table[len(one), len(other)]


@given(WORDS, WORDS, st.integers(0, 4))
def test_edits_are_counted_up_to_a_bound(one: str, other: str, most: int) -> None:
    assert edits(one, other, most) == min(plain_edits(one, other), most + 1)


@given(WORDS, st.lists(WORDS, max_size=8))
def test_the_nearest_name_is_that_of_fewest_edits(word: str, known: list[str]) -> None:
    most = 1 if len(word) < 5 else 2
    near = [(plain_edits(word, name), name) for name in known if plain_edits(word, name) <= most]
    assert nearest(word, known) == min(near, default=(0, ""))[1]


def test_words_that_share_an_effort_share_its_bound() -> None:
    known = [f"flowline {i:03d}" for i in range(100)]
    effort = Effort()
    found = [nearest(f"flowlime {i:03d}", known, effort) for i in range(2000)]
    assert found[0] == "flowline 000"
    assert found[-1] == ""
    assert "" not in found[: found.index("")]
    assert calls(lambda: nearest("flowlime 000", known, effort)) < 5


def parameters(count: int) -> str:
    known = "".join(f" known{i}, {i}.0\n" for i in range(count))
    uses = "".join(f" {i + 3}, =[unknown{i}], 0.0, 0.0\n" for i in range(count))
    return f"$PREPROCESSOR\n*PARAMETERS\n{known}$MODEL\n*NODE\n{uses}"


def keywords(count: int) -> str:
    return "$MODEL\n" + "".join(f"*QX{i}\n*UNKNWON WORD {i}\n" for i in range(count))


def settings(count: int) -> str:
    return "$MODEL\n*ELEMENT SETS\n SET=A\n" + "".join(f" STE{i}=B\n" for i in range(count))


def sets(count: int) -> str:
    named = "".join(f" SET=Flowline {i}\n 1\n SUBSET=Flowlime {i}\n" for i in range(count))
    return f"$MODEL\n*NODE\n 1, 0.0, 0.0\n 2, 0.0, 1.0\n*ELEMENT\n 1, 1, 2\n*ELEMENT SETS\n{named}"


@pytest.mark.untraced
@pytest.mark.parametrize(("text", "count"), [(parameters, 125), (keywords, 62), (settings, 125), (sets, 125)])
def test_misspelt_names_cost_as_much_as_they_are_many(
    text: Callable[[int], str], count: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A fraction of the names that would cost too much, and as much less effort."""
    monkeypatch.setattr(Effort.__init__, "__defaults__", (Effort().left * count // 8000,))
    paths = [tmp_path / f"{number}.keyxm" for number in (count, 2 * count)]
    for path in paths:
        path.write_text(text(int(path.stem)), encoding="utf-8")
    assert call_growth(lambda path: list(mudline.lint(path)), *paths) < TWOFOLD
