"""Suggestions for misspelt names: one bounded distance for every message."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass
from itertools import takewhile

from mudline.basics.limits import LONGEST_MISSPELT, SPELLING_EFFORT

_SHORT = 5


@dataclass(slots=True)
class Effort:
    """Remaining budget of letters to compare; misspelt words that share it cost no more together.

    Without budget there is no suggestion: of very many misspelt words only the first get suggestions.
    """

    left: int = SPELLING_EFFORT


def common_start(first: Sequence[object], second: Sequence[object]) -> int:
    """Return the number of characters or items that both begin with."""
    return sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], zip(first, second, strict=False)))


def nearest(word: str, known: Iterable[str], effort: Effort | None = None) -> str:
    """Return the nearest known name within two edits (one for a short word), or "". Case is ignored."""
    effort = Effort() if effort is None else effort
    casefolded = word.casefold()
    if len(casefolded) > LONGEST_MISSPELT or effort.left < 0:
        return ""
    most = 1 if len(casefolded) < _SHORT else 2
    close_names: list[tuple[int, str]] = []
    for name in known:
        candidate = name.casefold()
        may_match = abs(len(candidate) - len(casefolded)) <= most
        effort.left -= len(casefolded) + 1 if may_match else 1
        if effort.left < 0:
            return ""
        if may_match and (distance := edits(casefolded, candidate, most)) <= most:
            most = distance
            close_names.append((distance, name))
    return min(close_names, default=(0, ""))[1]


_MARKS = re.compile(r"[0-9]+|\b\w{1,2}\b")
"""Numbers and words of one or two letters, which distinguish similar names."""
_FEWEST_LETTERS = 4


def same_marks(first: str, second: str) -> bool:
    """Return True if two similar names may be a misspelling: "End 1" and "End 2" are different names."""
    return _MARKS.findall(first.casefold()) == _MARKS.findall(second.casefold())


def meant_names(word: str, known: Collection[str], effort: Effort | None = None) -> list[str]:
    """Return the known names that a misspelt name may stand for, all equally near.

    A name with other numbers or short words never matches. Names of fewer than four letters are not compared.
    """
    effort = Effort() if effort is None else effort
    if len(word) < _FEWEST_LETTERS or effort.left < 0:
        return []
    alike = [name for name in known if len(name) >= _FEWEST_LETTERS and same_marks(word, name)]
    effort.left -= len(known)
    return equally_near(word, alike, effort)


def equally_near(word: str, known: Collection[str], effort: Effort | None = None) -> list[str]:
    """Return the known names that are as near to the word as the nearest."""
    near = nearest(word, known, effort)
    most = edits(word.casefold(), near.casefold(), 2) if near else 0
    return [name for name in known if edits(word.casefold(), name.casefold(), most) <= most] if near else []


def edits(first: str, second: str, most: int) -> int:
    """Return how many letters to change, insert, drop or swap with a neighbour to turn `first` into `second`.

    More than `most` edits count as `most` + 1. Row i of the table of distances is computed within `most` letters of i.
    """
    far = most + 1
    if abs(len(first) - len(second)) > most:
        return far
    pairs = enumerate(zip(first, second, strict=False))
    start = next((i for i, (one, other) in pairs if one != other), min(len(first), len(second)))
    first, second = first[start:], second[start:]
    two_before: list[int] = []
    before = list(range(len(second) + 1))
    for i, letter in enumerate(first, 1):
        row = [far] * len(before)
        row[0] = i
        for j in range(max(1, i - most), min(len(second), i + most) + 1):
            target = second[j - 1]
            row[j] = min(before[j] + 1, row[j - 1] + 1, before[j - 1] + (letter != target))
            if i > 1 and j > 1 and letter == second[j - 2] and first[i - 2] == target:
                row[j] = min(row[j], two_before[j - 2] + 1)
        if min(row) > most:
            return far
        two_before, before = before, row
    return min(before[-1], far)
