"""Representatives of elements that a deck does not show: in each set that a law names, and in every two of them."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import combinations, pairwise

import numpy as np

from mudline.language.deck.parameters import folded
from mudline.model.scene.csv_file import ExternalElements
from mudline.model.scene.model import Scene

_ALL_PAIRS = 40
_DIAMETERS = (0.2731, 0.5)
_FIRST = 2**40


def representatives(*scenes: Scene) -> tuple[ExternalElements, dict[int, str]]:
    """Return elements of two diameters in no set, in each set that a law names, and in two of them.

    The last block that holds an element wins, which makes an order of the blocks. It is the same in two decks if it is
    the same for every two consecutive blocks; with many sets no other pairs are needed. Each element has two nodes of
    its own. The second result is its description, by its number.
    """
    sets = _sets(scenes)
    pairs = combinations(sets, 2) if len(sets) <= _ALL_PAIRS else pairwise(sets)
    given: list[tuple[str, ...]] = [(), *((name,) for name in sets), *pairs]
    memberships = dict(enumerate((membership for membership in given for _ in _DIAMETERS), _FIRST))
    members: dict[str, list[int]] = {name: [] for name in sets}
    for number, membership in memberships.items():
        for name in membership:
            members[name].append(number)
    count = len(memberships)
    elements = ExternalElements(
        "representative elements",
        _FIRST + np.arange(count),
        _FIRST + np.arange(2 * count).reshape(count, 2),
        np.resize(_DIAMETERS, count),
        np.ones(count),
        {name: np.array(ids, dtype=np.int64) for name, ids in members.items()},
    )
    names = {
        number: f"an element of {' and '.join(membership)}" if membership else "an element of no set but ALL"
        for number, membership in memberships.items()
    }
    return elements, names


def shows_elements(scene: Scene) -> bool:
    """Return True if a deck shows all elements that its laws are for: none come from `*LINES` or another deck."""
    return bool(len(scene.element_ids)) and not scene.set_table.everything.open


def _sets(scenes: Iterable[Scene]) -> list[str]:
    """Return the sets that laws name, each once, in the order of the last block that names it."""
    last: dict[str, str] = {}
    for scene in scenes:
        for law in scene.laws.set_laws:
            if law.set_ is not scene.set_table.everything:
                last.pop(folded(law.set_.name), None)
                last[folded(law.set_.name)] = law.set_.name
    return list(last.values())
