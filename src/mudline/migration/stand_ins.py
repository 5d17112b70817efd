"""Elements that stand for those that a deck does not show."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations, pairwise

import numpy as np

from mudline.scene.external_elements import ExternalElements

_ALL_PAIRS = 40
_DIAMETERS = (0.2731, 0.5)
_FIRST = 2**40


class StandIns:
    """Elements of two diameters in no set, each set, and two sets; of many sets only those that follow each other.

    The last block that holds an element wins. That is an order of the blocks; it is the same in two decks when it is
    the same for every two blocks that follow each other.
    """

    def __init__(self, sets: Sequence[str]) -> None:
        self.sets = sets
        pairs = list(combinations(sets, 2) if len(sets) <= _ALL_PAIRS else pairwise(sets))
        self.memberships: list[tuple[str, ...]] = [(), *((name,) for name in sets), *pairs]

    def elements(self) -> ExternalElements:
        """The elements, each with two nodes of its own."""
        count = len(self.memberships) * len(_DIAMETERS)
        members: dict[str, list[int]] = {name: [] for name in self.sets}
        for number, membership in self._numbered():
            for name in membership:
                members[name].append(number)
        return ExternalElements(
            "stand-ins",
            _FIRST + np.arange(count),
            _FIRST + np.arange(2 * count).reshape(count, 2),
            np.array(_DIAMETERS * len(self.memberships)),
            np.ones(count),
            {name: np.array(ids, dtype=np.int64) for name, ids in members.items()},
        )

    def names(self) -> dict[int, str]:
        """What each element is called, by its number."""
        return {
            number: f"an element of {' and '.join(membership)}" if membership else "an element of no set but ALL"
            for number, membership in self._numbered()
        }

    def _numbered(self) -> Iterator[tuple[int, tuple[str, ...]]]:
        for index in range(len(self.memberships) * len(_DIAMETERS)):
            yield _FIRST + index, self.memberships[index // len(_DIAMETERS)]
