"""A kind of fault: what an engineer does, which finding must say so, and how it is done to a deck."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from inspect import cleandoc

from tests.faults.draft import Draft, Row

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

    def row(self, slug: str, codes: str | tuple[str, ...], did: str, damage: Damage, units: str = "") -> None:
        """Make a kind of a change that one expression says; `units` are those of the decks that it is done to."""

        def in_units(draft: Draft) -> None:
            draft.needs(not units or draft.units in units.split())
            damage(draft)

        said = tuple(codes.split()) if isinstance(codes, str) else codes
        self.kinds.append(Kind(slug, self.name, did, said, in_units, info=False))


def put(row: Callable[[Draft], Row], column: int, text: str) -> Damage:
    """Another field in a column of a row."""
    return lambda draft: draft.put(row(draft), column, text)


def scale(row: Callable[[Draft], Row], column: int, factor: float) -> Damage:
    """The number in a column of a row multiplied."""
    return lambda draft: draft.scale(row(draft), column, factor)


def head(keyword: str, typed: str) -> Damage:
    """Another line for that of a keyword."""
    return lambda draft: draft.write(draft.block(keyword)[0], typed)


def comment(keyword: str, text: str) -> Damage:
    """A line put behind that of a keyword."""

    def insert(draft: Draft) -> None:
        draft.insert(draft.block(keyword)[0], text)

    return insert


def swap(keyword: str, key: str, old: str, new: str) -> Damage:
    """Another text for a part of a setting."""
    return lambda draft: draft.swap(draft.setting(keyword, key), old, new)
