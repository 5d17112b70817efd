"""A kind of fault: what an engineer does, which finding must say so, and how it is done to a deck."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from inspect import cleandoc

from tests.faults.draft import Draft

Damage = Callable[[Draft], None]


@dataclass(frozen=True)
class Kind:
    """One kind: its slug, its group, what was done, and the codes of which one is expected at a marked line.

    A finding of severity info counts only where `info` says that no more is asked for.
    """

    slug: str
    group: str
    did: str
    codes: tuple[str, ...]
    damage: Damage
    info: bool


class Group:
    """Kinds of one origin, in the order in which they are written down."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.kinds: list[Kind] = []

    def kind(self, *codes: str, info: bool = False) -> Callable[[Damage], Damage]:
        """Make a kind of the function below: its name is the slug, its docstring says what the engineer did."""

        def register(damage: Damage) -> Damage:
            did = cleandoc(damage.__doc__ or "").replace("\n", " ")
            self.kinds.append(Kind(damage.__name__.replace("_", "-"), self.name, did, codes, damage, info))
            return damage

        return register
