"""The known name that a misspelt one was to be: one measure, with a bound, for every message."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable
from dataclasses import dataclass

from mudline.basics.limits import LONGEST_MISSPELT, SPELLING_EFFORT

_SHORT = 5


@dataclass(slots=True)
class Effort:
    """What may still be spent on comparing names, in letters: the misspelt words that share it cost no more together.

    Where it ends there is no suggestion: very many misspelt words get one for the first of them only.
    """

    left: int = SPELLING_EFFORT


def nearest(word: str, known: Iterable[str], effort: Effort | None = None) -> str:
    """Return the nearest known name within two edits (one for a short word), or ""; case does not matter."""
    effort = Effort() if effort is None else effort
    wanted = word.casefold()
    if len(wanted) > LONGEST_MISSPELT or effort.left < 0:
        return ""
    most = 1 if len(wanted) < _SHORT else 2
    found: list[tuple[int, str]] = []
    for name in known:
        other = name.casefold()
        close = abs(len(other) - len(wanted)) <= most
        effort.left -= len(wanted) + 1 if close else 1
        if effort.left < 0:
            return ""
        if close and (distance := edits(wanted, other, most)) <= most:
            most = distance
            found.append((distance, name))
    return min(found, default=(0, ""))[1]


_MARKS = re.compile(r"[0-9]+|\b\w{1,2}\b")
"""Numbers and words of one or two letters: they tell things of a kind apart."""
_FEWEST_LETTERS = 4


def same_marks(one: str, other: str) -> bool:
    """Whether one of two names that are spelt nearly alike may be a slip: "End 2" is none of "End 1"."""
    return _MARKS.findall(one.casefold()) == _MARKS.findall(other.casefold())


def meant_names(word: str, known: Collection[str], effort: Effort | None = None) -> list[str]:
    """Return the known names for one of which a name was meant, as near as each other.

    None is so near whose numbers or short words are others, or that has, as the word may have, fewer than four letters.
    """
    effort = Effort() if effort is None else effort
    if len(word) < _FEWEST_LETTERS or effort.left < 0:
        return []
    alike = [name for name in known if len(name) >= _FEWEST_LETTERS and same_marks(word, name)]
    effort.left -= len(known)
    return equally_near(word, alike, effort)


def equally_near(word: str, known: Collection[str], effort: Effort | None = None) -> list[str]:
    """Return the known names that are as near as the nearest one."""
    near = nearest(word, known, effort)
    most = edits(word.casefold(), near.casefold(), 2) if near else 0
    return [name for name in known if edits(word.casefold(), name.casefold(), most) <= most] if near else []


def edits(one: str, other: str, most: int) -> int:
    """Letters to change, insert, drop or swap with a neighbour to make one word of the other; `most` + 1 if more.

    Only the diagonals within `most` of the main one are computed: letter j of `other` is at j - i + `most` in row i.
    """
    far = most + 1
    if abs(len(one) - len(other)) > most:
        return far
    start = next((i for i, pair in enumerate(zip(one, other, strict=False)) if pair[0] != pair[1]), None)
    if start is None:
        return abs(len(one) - len(other))
    one, other = one[start:], other[start:]
    width = 2 * most + 1
    # A row has one place more, which is also the one before its first, and stays far.
    before: list[int] = []
    row = [far] * most + list(range(far)) + [far]
    for i, letter in enumerate(one, 1):
        two_before, before, row = before, row, [far] * (width + 1)
        for k in range(max(0, most - i), min(width, len(other) + most - i + 1)):
            j = i + k - most
            if j == 0:
                row[k] = i
                continue
            target = other[j - 1]
            cost = min(before[k + 1] + 1, row[k - 1] + 1, before[k] + (letter != target))
            if i > 1 and j > 1 and letter == other[j - 2] and one[i - 2] == target:
                cost = min(cost, two_before[k] + 1)
            row[k] = cost
        if min(row) > most:
            return far
    return min(row[len(other) - len(one) + most], far)
