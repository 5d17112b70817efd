"""What of a legacy model the new family cannot say, or would say otherwise: it stops the migration."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from mudline.codes import MIG001
from mudline.deck.model import Deck
from mudline.diagnostics import Problem, Where
from mudline.keywords.catalogue import in_order, is_superseded, supersedes
from mudline.keywords.model import Block
from mudline.keywords.surface import Surface
from mudline.keywords.values import Equation
from mudline.syntax.tree import canonical_name

_FRICTION = (
    "longitudinal",
    "transverse",
    "longitudinal_mobilisation",
    "transverse_mobilisation",
    "constant",
)
_CHARACTERISTIC = (("longitudinal", "longitudinal_length"), ("transverse", "transverse_length"))


@dataclass(frozen=True, slots=True)
class SurfaceLines:
    """What a surface says of every element: `stiffness` as written, "" when it gives none, and the other lines."""

    stiffness: str
    others: Sequence[str]

    def block(self, set_name: str, stiffness: str) -> list[str]:
        """The lines of one SET=, which takes all from itself: nothing is inherited from another block."""
        lines = [f"SET={set_name}"]
        if stiffness:
            lines.append(f"STIFFNESS={stiffness}")
        return [*lines, *self.others]


def surface_lines(fields: Mapping[str, str]) -> SurfaceLines:
    """The lines of a surface whose fields are given by name, as text, "" for an empty one."""
    others: list[str] = []
    friction = [fields.get(name, "") for name in _FRICTION]
    if any(friction):
        friction[:2] = [value or "0" for value in friction[:2]]
        others.append("FRICTION=" + _joined(friction))
    if fields.get("lateral"):
        others.append(f"LATERAL={fields['lateral']}")
    suction = [fields.get("suction_stiffness", ""), fields.get("suction_extent", "")]
    if any(suction):
        others.append("SUCTION=" + _joined([suction[0] or "0", suction[1]]))
    return SurfaceLines(fields.get("stiffness", ""), others)


def lengths_in_force(fields: Mapping[str, str], without_friction: Mapping[str, bool]) -> list[str]:
    """The largest characteristic lengths that bound the mobilisation length, which the new family cannot say.

    One does not count where the mobilisation length itself is given, or where `without_friction` says that the
    coefficient of its direction is 0.
    """
    return [
        length
        for direction, length in _CHARACTERISTIC
        if fields.get(length) and not fields.get(f"{direction}_mobilisation") and not without_friction[direction]
    ]


def lengths_given(fields: Mapping[str, str]) -> list[str]:
    """The largest characteristic lengths with their directions, as they are written."""
    return [f"{direction} {fields[name]}" for direction, name in _CHARACTERISTIC if fields.get(name)]


def _joined(values: Sequence[str]) -> str:
    last = max(index for index, value in enumerate(values) if value)
    return ", ".join(values[: last + 1])


_DEFAULT_LENGTH = {"metric": 3.048, "imperial": 10.0}


def superseded_blocks(deck: Deck) -> list[tuple[Where, Block]]:
    """The blocks of superseded keywords: surfaces first, then curves by set."""
    present = filter(is_superseded, in_order(deck.keywords()))
    return [found for keyword in present for found in deck.blocks(keyword)]


def surfaces(deck: Deck) -> list[tuple[Where, Surface]]:
    """The legacy surfaces of a deck, in the order of the file."""
    return list(deck.blocks_that(lambda declared: declared.facts.seabed_type))


def refusals(deck: Deck, continued_by: Sequence[str] = ()) -> Iterator[Problem]:
    """The reasons why a deck is left as it is; `deck` has its equations as written.

    `continued_by` names decks that go on from this one with seabed keywords of their own.
    """
    yield from _other_family(deck)
    yield from _other_deck(deck)
    yield from _continued(deck, continued_by)
    yield from _actions(deck)
    found = surfaces(deck)
    for where, block in found[1:]:
        yield _told(f"a second surface: remove all but one, then migrate *{block.keyword}", where)
    for where, block in found[:1]:
        yield from _lengths(block, where, deck.units)
        yield from _bed(deck, block, where)


def _told(message: str, where: Where) -> Problem:
    return Problem(MIG001, message, where=where)


def _other_family(deck: Deck) -> Iterator[Problem]:
    """Which of two families holds for an element is a question that no rewriting answers."""
    for where, _ in deck.blocks("SEABED PROPERTIES"):
        message = (
            "*SEABED PROPERTIES stands beside legacy keywords: which holds where must be decided by hand; remove one"
        )
        yield _told(message, where)


def _other_deck(deck: Deck) -> Iterator[Problem]:
    """A deck that goes on from another one, whose seabed is part of what it says."""
    for section, found in enumerate(deck.sections):
        for block, restart in enumerate(found.blocks):
            if found.name == "LOAD CASE" and restart.keyword == "RESTART":
                message = (
                    "*RESTART continues another deck, whose seabed counts too: keep one model in one deck to migrate it"
                )
                yield _told(message, Where(section, block))


def _continued(deck: Deck, continued_by: Sequence[str]) -> Iterator[Problem]:
    """In a deck that goes on from this one, its keywords would meet other ones than before."""
    where, _ = superseded_blocks(deck)[0]
    for name in continued_by:
        message = f"{name} continues this deck and has seabed keywords of its own, which would meet others: keep both"
        yield _told(message, where)


def _actions(deck: Deck) -> Iterator[Problem]:
    """Actions of `*VARIATION` on what a migration takes away or makes."""
    for where, block in deck.blocks("VARIATION", "PREPROCESSOR"):
        for i, variation in enumerate(block.variations):
            for j, item in enumerate(variation.blocks):
                keyword = canonical_name("*" + ",".join(item.keyword))
                if is_superseded(keyword) or supersedes(keyword):
                    message = (
                        f"a variation adds or removes *{keyword}, which means another thing then: remove the action"
                    )
                    yield _told(message, where._replace(path=("variations", i, "blocks", j)))


def _lengths(block: Surface, where: Where, units: str) -> Iterator[Problem]:
    """Largest characteristic lengths that bound the mobilisation length and are not the default.

    What an equation gives may be another number tomorrow: it counts as neither 0 nor the default.
    """
    values: Any = block.properties
    written = {name: "given" for name in type(values).model_fields if getattr(values, name) is not None}
    frictionless = {name: getattr(values, name) in (None, 0.0) for name in ("longitudinal", "transverse")}
    for name in lengths_in_force(written, frictionless):
        if getattr(values, name) != _DEFAULT_LENGTH.get(units):
            direction = name.removesuffix("_length")
            message = (
                f"the largest {direction} characteristic length bounds the mobilisation length of each element, "
                "and the new family has no field for it: give the mobilisation length instead"
            )
            yield _told(message, where._replace(path=("properties", name)))


def _bed(deck: Deck, block: Surface, where: Where) -> Iterator[Problem]:
    """A slope or profile that has no single place in `*SEABED PROFILE`."""
    shaped = block.slope is not None or block.profile is not None
    if block.slope is not None and block.profile is not None:
        yield _told("a slope and a profile: remove one of them", where._replace(path=("slope",)))
    for keyword in ("SEABED PROFILE", "SEABED PLANES"):
        for other, _ in deck.blocks(keyword):
            if shaped:
                yield _told(f"*{keyword} and the slope or profile of *{block.keyword}: remove one of them", other)
    for (row, column), word in (block.profile.words if block.profile is not None else {}).items():
        if isinstance(word, Equation):
            message = "an equation in a profile, which goes to a file of its own: write the number"
            yield _told(message, where._replace(path=("profile", row, column)))
