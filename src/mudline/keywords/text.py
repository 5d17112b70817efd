"""Words for people: how a text of the deck is shown, what may have been meant, why something is no number."""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache

from mudline.keywords.values import is_not_finite

_LONGEST_SHOWN = 60
_LONGEST_GUESSED = 60


def cut(text: str) -> str:
    """A text of the deck, cut when long."""
    return text if len(text) <= _LONGEST_SHOWN else text[: _LONGEST_SHOWN - 3] + "..."


def shown(text: str) -> str:
    """A text of the deck in quotes, cut when long."""
    return repr(cut(text))


def suggested(word: str, known: Iterable[str]) -> str:
    """The known word that is nearest to one that is not known, case aside: within two edits, one for a short word."""
    if not 1 < len(word) <= _LONGEST_GUESSED:
        return ""
    most = 1 if len(word) < 5 else 2
    wanted, letters = word.casefold(), _letters(word)
    near = (name for name in known if (letters ^ _letters(name)).bit_count() <= 2 * most)
    distance, best = min(((edits(wanted, name.casefold(), most), name) for name in near), default=(most + 1, ""))
    return best if distance <= most else ""


def suggestion(word: str, known: Iterable[str]) -> str:
    """` (did you mean X?)` for the nearest known word, or nothing."""
    near = suggested(word, known)
    return f" (did you mean {near}?)" if near else ""


@lru_cache(maxsize=1024)
def _letters(word: str) -> int:
    """The set of letters of a word as bits; one edit changes two of them at most."""
    bits = 0
    for letter in word.casefold():
        bits |= 1 << ord(letter) % 64
    return bits


def edits(one: str, other: str, most: int) -> int:
    """How many letters have to be put in, taken out, changed or swapped with the next; above `most` just more."""
    if abs(len(one) - len(other)) > most:
        return most + 1
    above: list[int] = []
    row = list(range(len(other) + 1))
    for i, letter in enumerate(one):
        above, row, before = row, [i + 1], above
        for j, wanted in enumerate(other):
            cost = min(row[j] + 1, above[j + 1] + 1, above[j] + (letter != wanted))
            if i and j and letter == other[j - 1] and one[i - 1] == wanted:
                cost = min(cost, before[j - 1] + 1)
            row.append(cost)
        if min(row) > most:
            return most + 1
    return row[-1]


def either(words: Iterable[str]) -> str:
    """`a`, `a or b`, `a, b or c`."""
    *most, last = words
    return f"{', '.join(most)} or {last}" if most else last


def number_fault(text: str, label: str, wanted: str = "a number or an equation =[...]") -> str:
    """Why a text is no number, in words that say what to do; `wanted` may stand there."""
    if is_not_finite(text):
        return f"{shown(text)} is not a finite number: {label} needs {wanted}"
    if text.startswith(("[", "=")):
        return f"{shown(text)} is no equation: {label} needs {wanted}"
    if _too_large(text.lower().lstrip("+-")):
        return f"{shown(text)} is too large for a double-precision number: {label} must be below 1.8E308"
    return f"{shown(text)} is no number: {label} needs {wanted}"


def whole_fault(text: str, label: str) -> str:
    """Why a number cannot stand where a whole one is needed."""
    return f"{shown(text)} is no whole number: {label} needs one"


def _too_large(text: str) -> bool:
    if not text[:1].isdigit() or "_" in text or not text.isascii():
        return False
    try:
        return float(text.replace("d", "e")) == float("inf")
    except ValueError:
        return False
