"""The ladder of extremes on the laws of the user's deck: curves, springs, friction and suction, scaled.

Of each contact of the deck a small deck is made that has the numbers of that contact, as text. All forces, all depths,
the diameter, the length of the element, the coefficients of friction are then multiplied by powers of ten.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from decimal import Decimal
from typing import NamedTuple

import numpy as np

from mudline.contact import ContactInput, LawKind
from mudline.contact.arrays import FloatArray
from mudline.scene.model import Scene
from mudline.scene.seabed import SeabedKind
from mudline.study.exact import BOUND
from mudline.study.report import Omission
from mudline.study.stability.families import AnyCell, returning, sliding, through_zone
from mudline.study.stability.paths import TILTED_BOUND, PathCell, Place
from mudline.study.stability.pull_out import SuctionCell
from mudline.study.stability.small_decks import Pair, SmallDeck

POWERS = (-300, -200, -100, -10, 0, 10, 100, 200, 300)
"""Powers of ten by which the numbers of the deck are multiplied."""
_BETWEEN = ": "
"""Separator in the name of a family, between the contact and what is scaled."""
MOST_CONTACTS = 6
"""Contacts that are scaled: those with the most elements."""


class OwnContact(NamedTuple):
    """A contact of the deck: its name, a small deck with its numbers, and its suction, if it has any."""

    name: str
    deck: SmallDeck
    suction: SuctionCell | None


def is_own(family: str) -> bool:
    """Whether a family of cells is one on the deck's own laws, by its name."""
    return _BETWEEN in family


def own_cells(scene: Scene) -> tuple[list[AnyCell], list[Omission]]:
    """The cells on the laws of a deck, and what is left out; raises DeckError for a deck that cannot be evaluated."""
    given = scene.contact().input
    contacts, omissions = _contacts(scene, given)
    return [cell for contact in contacts for cell in _scaled(contact)], omissions


# ------------------------------------------------------------------------------------------------ the deck's contacts


def _contacts(scene: Scene, given: ContactInput) -> tuple[list[OwnContact], list[Omission]]:
    """The contacts with the most elements, each of elements with the same numbers."""
    columns = _columns(given)
    rows = np.flatnonzero(np.isin(given.law, (LawKind.CURVE, LawKind.LINEAR, LawKind.NODAL)))
    omissions = []
    if not rows.size:
        return [], [Omission("ladder on the deck's own laws", "no element has a curve, a stiffness or nodal springs")]
    table = np.nan_to_num(np.column_stack([column[rows] for column in columns.values()]), nan=-1.0)
    _, firsts, counts = np.unique(table, axis=0, return_index=True, return_counts=True)
    order = np.argsort(-counts, kind="stable")
    if len(order) > MOST_CONTACTS:
        more = len(order) - MOST_CONTACTS
        omissions.append(Omission(f"ladder on {more} more contacts", f"the {MOST_CONTACTS} largest are scaled"))
    if given.has("trench peak", "trench wall", "trench table"):
        omissions.append(Omission("ladder on trenches", "the exact reference has no trench"))
    if scene.seabed.kind in {SeabedKind.PROFILE, SeabedKind.SURFACE}:
        omissions.append(Omission("ladder on the profile of the seabed", "the exact reference has planes: it is flat"))
    found: list[OwnContact] = []
    for index in order[:MOST_CONTACTS].tolist():
        element = int(rows[firsts[index]])
        numbers = {name: float(column[element]) for name, column in columns.items()}
        name = f"{given.law_names[element]} on {given.law_sets[element]}"
        same = sum(one.name.partition(" (")[0] == name for one in found)
        name = f"{name} ({same + 1})" if same else name
        points = given.curves[int(numbers["curve"])] if given.law[element] == LawKind.CURVE else None
        rows_of = () if points is None else tuple(zip(points.ratios.tolist(), points.forces.tolist(), strict=True))
        found.append(OwnContact(name, _small_deck(scene, numbers, rows_of), _suction(numbers)))
    return found, omissions


def _columns(given: ContactInput) -> dict[str, FloatArray]:
    """Parameters of each element (m,) by law and name, those of the laws of its first node included."""
    elements, nodes = len(given.element_ids), len(given.node_ids)
    found = {"curve": given.curve_index.astype(np.float64), "diameter": given.diameter, "length": given.length}
    for name, assigned in given.assigned.items():
        if name in {"curve", "rigid"} or name.startswith("trench"):
            continue
        for parameter in assigned.parameters:
            if assigned.law.acts_on == "elements":
                found[f"{name} {parameter}"] = assigned.spread(parameter, elements)
            else:
                found[f"{name} {parameter}"] = assigned.spread(parameter, nodes)[given.element_nodes[:, 0]]
    return found


def _small_deck(scene: Scene, numbers: dict[str, float], points: Sequence[tuple[float, float]]) -> SmallDeck:
    def text(name: str, otherwise: str = "") -> str:
        value = numbers.get(name, np.nan)
        return otherwise if np.isnan(value) else repr(value)

    zone = "nodal" if text("nodal stiffness") else "smoothed"
    width = numbers.get(f"{zone} half_width", np.nan)
    frictional = bool(text("friction axial_coefficient"))
    mobilised = frictional and not text("friction axial_stiffness")
    slope, direction, point = _plane(scene)
    return SmallDeck(
        diameter=text("diameter", "0.3"),
        length=text("length", "2.0") if numbers["length"] > 0.0 else "2.0",
        stiffness=text("linear stiffness") or text("smoothed stiffness") or "0.0",
        curve=[(repr(ratio), repr(force)) for ratio, force in points],
        nodal=text("nodal stiffness"),
        smoothing=repr(width) if width > 0.0 else "",
        form="ONE-SIDED" if numbers.get(f"{zone} one_sided", 0.0) > 0.0 else "CENTRED",
        unloading=text("unloading stiffness"),
        coefficients=(text("friction axial_coefficient"), text("friction lateral_coefficient")) if frictional else None,
        springs=(text("friction axial_stiffness", "1.0"), text("friction lateral_stiffness", "1.0")),
        criterion="ELLIPSE" if numbers.get("friction elliptic", 0.0) > 0.0 else "BOX",
        angle=text("friction angle"),
        mobilisation=(
            (text("friction axial_mobilisation", "1.0"), text("friction lateral_mobilisation", "1.0"))
            if mobilised
            else None
        ),
        lateral=text("lateral stiffness"),
        uplift=(text("suction spring stiffness"), text("suction spring extent"))
        if "suction spring extent" in numbers and text("suction spring extent")
        else None,
        slope=slope,
        direction=direction,
        point=point,
    )


def _plane(scene: Scene) -> tuple[str, str, tuple[str, str, str] | None]:
    """Slope, direction and point of the steepest plane of the seabed; an empty slope where it is flat."""
    seabed = scene.seabed
    if seabed.kind is SeabedKind.SLOPING:
        return repr(float(seabed.slope)), repr(float(seabed.direction)), None
    if seabed.kind is SeabedKind.PLANES:
        plane = max(seabed.planes, key=lambda one: abs(one.slope))
        x, y, z = (repr(float(part)) for part in plane.point)
        return repr(float(plane.slope)), repr(float(plane.direction)), (x, y, z)
    return "", "0.0", None


def _suction(numbers: dict[str, float]) -> SuctionCell | None:
    names = ("force_factor", "force_exponent", "depth_factor", "depth_exponent", "first_corner", "second_corner")
    if np.isnan(numbers.get("suction force_factor", np.nan)):
        return None
    force, n_f, depth, n_d, first, second = (repr(numbers[f"suction {name}"]) for name in names)
    return SuctionCell(
        family="",
        value="",
        force=(force, n_f),
        depth=(depth, n_d),
        cutoff=(first, second),
        regularisation=repr(numbers["suction regularisation"]),
    )


# ---------------------------------------------------------------------------------------------------------- to extremes


def times(text: str, power: int) -> str:
    """A number of a deck times a power of ten, with all of its digits; an empty text stays empty."""
    return f"{Decimal(text).scaleb(power):E}" if text else ""


def _pair(pair: Pair | None, one: int, other: int) -> Pair | None:
    return None if pair is None else (times(pair[0], one), times(pair[1], other))


def _scaled(contact: OwnContact) -> Iterator[AnyCell]:
    """The cells of one contact, family by family."""
    deck = contact.deck
    kinds = ["forces", "depths", "diameter", "length"]
    if deck.coefficients is not None:
        kinds.append("coefficients")
    for kind in kinds:
        for power in POWERS:
            scaled = _deck(deck, kind, power)
            tilted = bool(deck.slope or deck.angle or deck.criterion == "ELLIPSE")
            bound = TILTED_BOUND if tilted else BOUND
            yield PathCell(f"{contact.name}{_BETWEEN}{kind}", f"x 1E{power}", scaled, _path(scaled), bound)
    if contact.suction is not None:
        for kind in ("suction", "breakout", "velocity"):
            for power in POWERS:
                yield _pull(contact.suction, f"{contact.name}{_BETWEEN}{kind}", kind, power)


def _deck(deck: SmallDeck, kind: str, power: int) -> SmallDeck:
    if kind == "forces":
        return replace(
            deck,
            stiffness=times(deck.stiffness, power),
            curve=[(ratio, times(force, power)) for ratio, force in deck.curve],
            nodal=times(deck.nodal, power),
            unloading=times(deck.unloading, power),
            springs=(times(deck.springs[0], power), times(deck.springs[1], power)),
            lateral=times(deck.lateral, power),
            uplift=_pair(deck.uplift, power, 0),
        )
    if kind == "depths":
        return replace(
            deck,
            curve=[(times(ratio, power), force) for ratio, force in deck.curve],
            smoothing=times(deck.smoothing, power),
            mobilisation=_pair(deck.mobilisation, power, power),
            uplift=_pair(deck.uplift, 0, power),
        )
    if kind == "coefficients":
        return replace(deck, coefficients=_pair(deck.coefficients, power, power))
    if kind == "diameter":
        return replace(deck, diameter=times(deck.diameter, power))
    return replace(deck, length=times(deck.length, power))


def _pull(cell: SuctionCell, family: str, kind: str, power: int) -> SuctionCell:
    cell = replace(cell, family=family, value=f"x 1E{power}")
    if kind == "velocity":
        return replace(cell, velocity=times(cell.velocity, power))
    if kind == "suction":
        return replace(cell, force=_pair(cell.force, power, 0))
    return replace(cell, depth=_pair(cell.depth, power, 0))


def _path(deck: SmallDeck) -> list[Place]:
    """A path in the middle of the laws of a deck; none where its numbers make no laws."""
    try:
        depth = _depth(deck)
        places = sliding(deck, depth)
        if deck.unloading:
            places += returning(deck, depth)
        if deck.smoothing:
            places += through_zone(deck)
    except (ArithmeticError, ValueError):
        return []
    return places


def _depth(deck: SmallDeck) -> float:
    """A penetration in the middle of the normal law: of a curve, of the zone, or a twentieth of the diameter."""
    if deck.curve:
        depth = 0.37 * float(deck.curve[-1][0]) * float(deck.diameter)
    else:
        depth = 3.0 * float(deck.smoothing) if deck.smoothing else 0.05 * float(deck.diameter)
    return min(max(depth, 1e-305), 1e300)
