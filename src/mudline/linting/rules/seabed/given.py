"""What single places of a deck give to elements besides stiffness, in both families of keywords."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple, cast

from mudline.diagnostics import Where
from mudline.linting.context import LintContext
from mudline.scene.deck_values import surfaces
from mudline.scene.laws import typed_blocks

_UNKNOWN = float("nan")
_OF_SET = {
    "lateral": ("lateral",),
    "suction_stiffness": ("suction", "stiffness"),
    "suction_extent": ("suction", "extent"),
}


class Given(NamedTuple):
    """A set of *SEABED PROPERTIES, or the first line of a legacy surface; `type_` is None where it is not known."""

    part: Any
    where: Where
    type_: str | None
    legacy: bool

    def place(self, name: str) -> Where:
        """Where a value stands; names are those of the fields of *ELASTIC SURFACE."""
        return self.where._replace(path=(*self.where.path, *self._path(name)))

    def value(self, name: str) -> float | None:
        """A value: None where the deck gives none, NaN where it could not be read."""
        found = self.part
        for step in self._path(name):
            found = getattr(found, step, None)
        if found is None:
            return None
        return float(cast("float", found)) if isinstance(found, float | int) else _UNKNOWN

    def _path(self, name: str) -> tuple[str, ...]:
        return (name,) if self.legacy else _OF_SET.get(name, ("friction", name))


def given(context: LintContext) -> list[Given]:
    """All of them: legacy surfaces first, then the sets of *SEABED PROPERTIES in the order of the file."""
    return context.once(_found)


def _found(context: LintContext) -> list[Given]:
    return list(_each(context))


def _each(context: LintContext) -> Iterator[Given]:
    deck = context.scene.deck
    for where, surface in surfaces(deck):
        place = where._replace(path=("properties",))
        yield Given(getattr(surface, "properties", None), place, surface.facts.seabed_type, legacy=True)
    for where, properties, type_ in typed_blocks(context.scene.context):
        for index, entry in enumerate(properties.sets):
            yield Given(entry, where._replace(path=("sets", index)), type_, legacy=False)


def positive(value: float | None) -> bool:
    """Whether a value is given, could be read and is above zero."""
    return value is not None and value > 0.0


def absent(context: LintContext, entry: Given, name: str) -> bool:
    """Whether the deck gives no value, or zero; of a line that could not be read whole nothing is said."""
    value = entry.value(name)
    place = entry.place(name)
    line = place._replace(path=place.path[:-1])
    resolving = context.scene.context
    return value == 0.0 or (
        value is None and not resolving.has_read_errors(line) and not resolving.has_read_errors(entry.where)
    )
