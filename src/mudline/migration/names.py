"""Names for the curves that come out of `*EMBEDMENT`, whose curves have only the names of their sets."""

from __future__ import annotations

from collections.abc import Iterable

from mudline.deck.parameters import folded
from mudline.keywords.text import reads_as_name


def curve_names(sets: Iterable[str], taken: Iterable[str]) -> list[str]:
    """A name for each curve: that of its set, with ` curve` and a number behind it where that would not do.

    A name that another curve has, in any case of letters, would name both; one that reads as a number or an equation
    would be taken for a stiffness.
    """
    used = {folded(name) for name in taken}
    names: list[str] = []
    for name in sets:
        chosen = next(one for one in _candidates(name) if folded(one) not in used and reads_as_name(one))
        used.add(folded(chosen))
        names.append(chosen)
    return names


def _candidates(name: str) -> Iterable[str]:
    yield name
    base = f"{name} curve" if reads_as_name(f"{name} curve") else "curve"
    yield base
    number = 2
    while True:
        yield f"{base} {number}"
        number += 1
