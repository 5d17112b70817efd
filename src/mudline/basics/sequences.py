"""Parts in which two sequences differ."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from difflib import SequenceMatcher

from mudline.basics.spelling import common_start


def differing(old: Sequence[str], new: Sequence[str], most: int) -> Iterator[tuple[int, int, int, int]]:
    """Yield begin and end in `old`, then begin and end in `new`, of each part that differs.

    More than `most` items between the first and the last that differ, in both together, are one part: the time of a
    search for equal items among them grows with the square of their number.
    """
    start = common_start(old, new)
    rest = common_start(old[start:][::-1], new[start:][::-1])
    removed, added = old[start : len(old) - rest], new[start : len(new) - rest]
    parts: Sequence[tuple[str, int, int, int, int]] = [("replace", 0, len(removed), 0, len(added))]
    if len(removed) + len(added) <= most:
        parts = SequenceMatcher(None, removed, added, autojunk=False).get_opcodes()
    for kind, i, i_end, j, j_end in parts:
        if kind != "equal":
            yield start + i, start + i_end, start + j, start + j_end
