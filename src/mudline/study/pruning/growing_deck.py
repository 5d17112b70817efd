"""A deck with as many sets as are wanted, each with a law of its own, over the same number of elements."""

from __future__ import annotations

from itertools import pairwise


def deck_with_sets(sets: int, elements: int) -> str:
    """The text of a straight line on linear seabeds; the elements are shared out among the sets."""
    edges = [number * elements // sets for number in range(sets + 1)]
    ranges = [(f"Part {number + 1}", first + 1, last) for number, (first, last) in enumerate(pairwise(edges))]
    return "\n".join(
        [
            "$MODEL",
            "*NODE",
            " 1, -0.01, 0.0, 0.0",
            f" {elements + 1}, -0.01, {2.0 * elements}, 0.0",
            f" GEN=1, {elements + 1}",
            "*ELEMENT",
            " 1, 1, 2",
            f" GEN=1, {elements}",
            "*ELEMENT SETS",
            *(f" SET={name}\n GEN={first}, {last}" for name, first, last in ranges),
            "*GEOMETRIC SETS",
            " OPTION=RIGID",
            " SET=ALL",
            " 207.0E9, 79.6E9, 0.3, 0.25, 7850.0",
            "*SEABED PROPERTIES",
            " TYPE=ELASTIC",
            *(f" SET={name}\n STIFFNESS={50_000 + first}" for name, first, _ in ranges),
            "$LOAD CASE",
            "*ANALYSIS TYPE",
            " TYPE=STATIC",
            "",
        ]
    )
