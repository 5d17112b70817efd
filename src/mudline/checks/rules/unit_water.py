"""In user units, whose are known by the density of the water: what follows from a density in another unit."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain

from mudline.checks.context import Found, Joined, LintContext, joint
from mudline.checks.rules.coordinates import UNT006
from mudline.checks.rules.unit_densities import UNT004, UNT005
from mudline.language.syntax.rows import read_number

_USER_UNITS = (".keyx", ".keyxu")
_TONNES = 10.0
"""Densities of water below this are in tonnes, of which the unit of force is 1000 times that of kilograms."""


@joint(UNT004, UNT005, UNT006)
def water_in_another_mass(context: LintContext, found: Found) -> Iterator[Joined]:
    """Values of several kinds that do not fit the density of the water, which says what units are."""
    text = context.text
    wrong = {code: problems for code, problems in found.items() if code.startswith("UNT")}
    if text is None or len(wrong) == 1 or not text.source.name.lower().endswith(_USER_UNITS):
        return
    place = next((where.inside("density") for where, _ in context.written("OCEAN")), None)
    span = text.span(place) if place and context.deck.written(place) else None
    density = read_number(text.source.unified[slice(*span)]) if span else None
    if density is None:
        return
    everything = [*chain.from_iterable(wrong.values())]
    cause = next(one for one in everything if one.code in (UNT004, UNT005, UNT006))
    message = (
        f"the density {density!r} of the water does not fit the rest of the deck, in which "
        f"{density * (1000.0 if density < _TONNES else 0.001):.6g} would: write it in the deck's unit of mass"
    )
    yield Joined(cause, [one for one in everything if one is not cause], message=message, place=span)
