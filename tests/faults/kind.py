"""The kinds of faults: the rows of kinds.txt, each with the change or the function that does it to a deck."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from tests.faults import changes, kinds_copies, kinds_keywords, kinds_seabed, kinds_typing, kinds_units
from tests.faults.draft import Draft

MODULES = (kinds_units, kinds_typing, kinds_keywords, kinds_copies, kinds_seabed)
_CODES = {
    "STRAY": ("SYN001", "SYN002", "SYN003", "SYN004", "SYN011", "SYN015", "REF007"),
    "STRAY_LINE": ("SYN001", "SYN003", "SYN004", "SYN011"),
    "UNREADABLE": ("SYN001", "SYN002", "SYN003", "SYN015", "SYN016", "STY004"),
}
"""Names in the table. STRAY: a row under a keyword that is not its own is not read, or reads as something else."""


@dataclass(frozen=True)
class Kind:
    """One kind: its slug, its group, what was done, and the codes of which one is expected at a marked line."""

    slug: str
    group: str
    did: str
    codes: tuple[str, ...]
    units: str
    change: Callable[[Draft], None]

    def damage(self, draft: Draft) -> None:
        """Do the fault to a deck; raises NotHere where it cannot happen."""
        draft.needs(not self.units or draft.units in self.units.split())
        self.change(draft)


def _kinds() -> list[Kind]:
    kinds: list[Kind] = []
    group = ""
    for line in Path(__file__).with_name("kinds.txt").read_text(encoding="utf-8").splitlines():
        if line.startswith("## "):
            group = line[3:]
        elif line and not line.startswith("#"):
            slug, codes, units, change, did = (cell.strip() for cell in line.split("|"))
            expected = tuple(code for word in codes.split() for code in _CODES.get(word, (word,)))
            kinds.append(Kind(slug, group, did, expected, units, _change(slug, change)))
    return kinds


def _change(slug: str, change: str) -> Callable[[Draft], None]:
    if change:
        return partial(changes.apply, change=change)
    name = slug.replace("-", "_")
    function: Callable[[Draft], None] = next(getattr(module, name) for module in MODULES if hasattr(module, name))
    return function


KINDS = _kinds()
