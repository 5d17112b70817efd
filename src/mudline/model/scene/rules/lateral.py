"""Lateral resistance: trenches, and friction with a breakout."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.language.diagnostics import Blocks, Code, Problem, Severity, Where
from mudline.language.keywords.contents import is_partly_unknown
from mudline.model.scene.deck_values import number
from mudline.model.scene.laws import Extension, rule_of_extension
from mudline.model.scene.numbering import Floats, Mask
from mudline.model.scene.rules.extensions import of_elements
from mudline.model.scene.rules.fields import lacks_diameter
from mudline.model.scene.rules.seabed import extends_rigid

if TYPE_CHECKING:
    from mudline.language.keywords.library.seabed_lateral import FrictionSet, TrenchSet
    from mudline.model.scene.resolved import ResolvedDeck


EXT003 = Code("EXT003", "bad-trench", Severity.ERROR)

_KEYWORD = "SEABED TRENCH"
_SIZES = ("depth", "bottom_width", "upper_width")
_LOCKED = "mu2 tan(theta) must be below 1, else the wall of the trench locks itself"
_HIDDEN = "; sets or lines that this deck does not show may give them another friction"


@rule_of_extension(EXT003, _KEYWORD)
def bad_trench(scene: ResolvedDeck, extension: Extension) -> Iterator[Problem]:
    """A trench has no possible geometry, no resistance, no friction spring, or a self-locking wall.

    The walls of a trench rise from its bottom width to a larger upper width, and its depth is above 0. Their resistance
    raises the limit of the lateral friction spring. Both nodes of an element need such a spring: from *SEABED FRICTION,
    or from a transverse friction coefficient that no LATERAL= replaces. Correct the value, or give what is missing.

    * MODEL=PEAK, the default, needs PEAK=. The rows of PEAK=TABLE are two or more, and their offsets begin at 0 or more
      and ascend.
    * MODEL=WALL takes the resistance from its slope. If the transverse coefficient times that slope is 1 or more, the
      wall would hold any force.
    * RESIDUAL= needs a number in PEAK=, and is reached beyond the middle of the wall. SMOOTHING= rounds off at most
      half of the shortest side of the resistance. MODEL=WALL excludes RESIDUAL=, SMOOTHING= and LEVEL=LOWERED.
    * The two points of CENTRELINE= must differ.
    * PEAK= with MODEL=WALL has no effect and is a warning. So are elements whose friction may be given outside this
      deck.

    Example on seabed:
          STIFFNESS=50000.0
        | FRICTION=0.3, 0.6
        |*SEABED TRENCH
        | SET=ALL
        - GEOMETRY=0.5, 3.0, 1.0
        + GEOMETRY=0.5, 1.0, 3.0
        | PEAK=2000.0

    Finds: 9:2
    """
    if extends_rigid(scene):
        return
    bare, locked = _without_spring(scene, extension)
    for entry, where, held in extension.blocks():
        yield from _of_block(cast("TrenchSet", entry), where)
        message = "a trench and no lateral friction spring: give *SEABED FRICTION for them"
        yield from of_elements(scene, held & bare, _of_friction(scene, message, where.inside("set")))
        if np.any(both := held & locked):
            yield _of_friction(scene, f"{_LOCKED}: {scene.describe(both, '', '')}", where.inside("geometry"))


def _of_friction(scene: ResolvedDeck, message: str, where: Where) -> Problem:
    """Return a problem of the friction of elements: a warning if the deck may not show all of their friction."""
    friction = scene.extensions.get("SEABED FRICTION")
    hidden = friction is not None and any(held is None or held.open for held in friction.sets)
    if hidden or scene.laws.uncertain or scene.context.restart:
        return Problem(EXT003, message + _HIDDEN, None, Severity.WARNING, where, blocks=Blocks.ALWAYS)
    return Problem(EXT003, message, where=where)


def _of_block(entry: TrenchSet, where: Where) -> Iterator[Problem]:
    """Yield faults of a block by itself: its resistance, its section, its centreline."""
    if entry.model == "WALL" and entry.peak is not None:
        message = "PEAK= has no effect under MODEL=WALL: remove it, or write MODEL=PEAK"
        yield Problem(EXT003, message, None, Severity.WARNING, where.inside("peak"))
    faults = [*_resistance_faults(entry)] if entry.model != "WALL" else []
    short = entry.table is not None and entry.table.values.shape[1] < 2  # rows without a resistance cannot be read
    unread = is_partly_unknown(entry) or short
    for path, message in faults or (() if unread else _excess_faults(entry)):
        yield Problem(EXT003, message, where=where.inside(*path))
    depth, bottom, upper = (number(entry.geometry, name) for name in _SIZES)
    if depth <= 0.0 or bottom <= 0.0 or upper <= 0.0 or upper <= bottom:
        message = "invalid trench geometry: depth and bottom width must be above 0, the upper width larger"
        yield Problem(EXT003, message, where=where.inside("geometry"))
    line = entry.centreline
    if all(number(line, f"{axis}0") == number(line, f"{axis}1") for axis in "yz"):
        message = "the two points of the centreline coincide: correct one"
        yield Problem(EXT003, message, where=where.inside("centreline"))


def _resistance_faults(entry: TrenchSet) -> Iterator[tuple[tuple[str | int, ...], str]]:
    """Yield path and message of faults in the resistance of a block; a sloped wall takes it from its geometry."""
    if entry.peak is None:
        yield ("set",), "MODEL=PEAK needs a resistance: give PEAK="
    if entry.peak != "TABLE":
        return
    offsets = np.zeros(0) if entry.table is None else entry.table.column(0)
    if len(offsets) < 2:
        yield ("peak",), "PEAK=TABLE needs two rows or more: offset from the centreline, resistance per unit length"
    if (offsets[:1] < 0.0).any():
        yield ("table", 0, 0), "the offset from the centreline is negative: it is a distance, the same on both sides"
    for row in np.flatnonzero(np.diff(offsets) <= 0.0)[:1].tolist():
        yield ("table", row + 1, 0), "the offset is not larger than that of the row before: offsets must ascend"


def _excess_faults(entry: TrenchSet) -> Iterator[tuple[tuple[str | int, ...], str]]:
    """Yield path and message of a level, a residual or rounded corners that do not fit other values or the geometry."""
    from mudline.model.contact.laws.trench import shortest_side  # noqa: PLC0415 - a deck without trenches does without it
    from mudline.model.scene.assignments import resistance_diagram  # noqa: PLC0415 - as above

    if entry.model == "WALL":
        given = {"level": entry.level == "LOWERED", "residual": entry.residual, "smoothing": entry.smoothing}
        for name in (name for name, value in given.items() if value):
            message = f"MODEL=WALL has sloped walls, which {name.upper()}= does not go with: remove one of the two"
            yield (name,), message
        return
    middle = 0.25 * (number(entry.geometry, "bottom_width") + number(entry.geometry, "upper_width"))
    if entry.residual is not None and entry.peak == "TABLE":
        yield ("residual",), "a table has a residual of its own: remove RESIDUAL=, or add its row"
    elif number(entry.residual, "displacement") <= middle:
        message = f"the residual is reached no later than the peak, at {middle:g}: give a larger displacement"
        yield ("residual",), message
    elif number(entry, "smoothing", 0.0) > max(0.5 * (side := shortest_side(resistance_diagram(entry))), 0.0):
        yield ("smoothing",), f"SMOOTHING= is above half of the shortest side of the resistance, {side:g}: give less"


def _without_spring(scene: ResolvedDeck, trenches: Extension) -> tuple[Mask, Mask]:
    """Return masks (m,) of elements in a trench: those without a lateral friction spring, and self-locking ones."""
    nothing: Mask = np.zeros(len(scene.element_ids), dtype=np.bool_)
    if not (trenches.of_element >= 0).any() or scene.element_nodes.min(initial=0) < 0 or _unread(scene):
        return nothing, nothing
    from mudline.model.scene.contact_input import friction_of  # noqa: PLC0415 - a deck without trenches does without it

    friction, count = friction_of(scene), len(scene.node_ids)
    sprung, coefficient = np.zeros(count, dtype=np.bool_), np.zeros(count)
    if friction is not None:
        coefficient[friction.rows] = friction.parameters["lateral_coefficient"]
        stiffness = np.asarray(friction.parameters["lateral_stiffness"])
        sprung[friction.rows] = ~np.isnan(stiffness) | (coefficient[friction.rows] > 0.0)
    bare: Mask = (trenches.of_element >= 0) & ~sprung[scene.element_nodes].all(axis=1)
    return bare, _self_locking(scene, trenches, coefficient)


def _unread(scene: ResolvedDeck) -> bool:
    """Return True if friction could not be read, or belongs to no set, which is reported as an error."""
    friction = scene.extensions.get("SEABED FRICTION")
    if friction is not None and None in friction.sets and not scene.context.possible_definition("ELEMENT SETS"):
        return True
    places = [*scene.resistance.places, *(friction.places if friction else ())]
    return any(is_partly_unknown(scene.context.written.at(place)) for place in places)


def _self_locking(scene: ResolvedDeck, trenches: Extension, coefficient: Floats) -> Mask:
    """Return a mask (m,) of the elements in a trench with sloped walls where a node has mu2 tan(theta) >= 1.

    `coefficient` (n,) is mu2 of each node.
    """
    from mudline.model.contact.laws.trench import wall_coefficient  # noqa: PLC0415 - as above

    depth, bottom, upper = (trenches.values(trenches.of_element, "geometry", name) for name in _SIZES)
    locking: Mask = np.zeros(len(scene.element_ids), dtype=np.bool_)
    for end in scene.element_nodes.T:
        added = wall_coefficient(depth, bottom, upper, coefficient[end])
        locking |= ~(np.isfinite(added) & (added >= 0.0))
    usable = (depth > 0.0) & (bottom > 0.0) & (upper > bottom)
    return locking & usable & trenches.says(trenches.of_element, "model", "WALL")


EXT013 = Code("EXT013", "bad-breakout", Severity.ERROR)


@rule_of_extension(EXT013, "SEABED FRICTION")
def bad_breakout(scene: ResolvedDeck, extension: Extension) -> Iterator[Problem]:
    """The lateral breakout of *SEABED FRICTION is incomplete, impossible, or combined with a law that it excludes.

    LATERAL=PEAK-RESIDUAL needs PEAK= and RESIDUAL= with a factor and a displacement each. The residual is at most the
    peak, and is reached at a larger displacement. LATERAL=F114 needs only the factor of PEAK=, and a diameter:
    everything else follows from the embedment. Both limit the lateral force by themselves, so CRITERION=ELLIPSE is
    excluded, and *SEABED TRENCH on the same element. PEAK= or RESIDUAL= without them has no effect and is a warning.

    Example on seabed:
          STIFFNESS=50000.0
        |*SEABED FRICTION
        | SET=ALL
        | COEFFICIENTS=0.3, 0.6
        | STIFFNESS=20000.0
        | LATERAL=PEAK-RESIDUAL
        | PEAK=1.2, 0.03
        - RESIDUAL=1.3, 0.3
        + RESIDUAL=1.2, 0.3

    Finds: 12:2
    """
    from mudline.model.scene.assignments import breaks_out  # noqa: PLC0415 - most decks have no such friction

    trench = scene.extensions.get("SEABED TRENCH")
    for entry, where, held in extension.blocks():
        friction = cast("FrictionSet", entry)
        if not breaks_out(friction):
            for name in (name for name in ("peak", "residual") if getattr(friction, name) is not None):
                message = f"{name.upper()}= has no effect under LATERAL=COULOMB: write LATERAL=PEAK-RESIDUAL or F114"
                yield Problem(EXT013, message, None, Severity.WARNING, where.inside(name))
            continue
        for name, message in () if is_partly_unknown(friction) else _breakout_faults(friction):
            yield Problem(EXT013, message, where=where.inside(name))
        if friction.criterion == "ELLIPSE":
            message = "a breakout across the line has no ellipse: write CRITERION=BOX"
            yield Problem(EXT013, message, where=where.inside("criterion"))
        if trench is not None:
            words = "a trench too, whose resistance a breakout excludes: remove one of the two"
            problem = Problem(EXT013, words, where=where.inside("lateral"))
            yield from of_elements(scene, held & (trench.of_element >= 0), problem)
        bare = held & np.isnan(scene.diameter)
        if friction.lateral == "F114" and bare.any():
            message = f"{scene.describe(bare)} no external diameter for LATERAL=F114"
            yield lacks_diameter(scene, EXT013, message, where.inside("lateral"))


def _breakout_faults(friction: FrictionSet) -> Iterator[tuple[str, str]]:
    """Yield field and message of the faults of a breakout: missing values, and values that its law excludes."""
    (peak, at), (residual, end) = (
        (number(part, "factor"), number(part, "displacement")) for part in (friction.peak, friction.residual)
    )
    if friction.lateral == "F114":
        if np.isnan(peak):
            yield "lateral", "LATERAL=F114 needs the factor at breakout: give PEAK="
        if friction.residual is not None or not np.isnan(at):
            name = "peak" if friction.residual is None else "residual"
            yield name, f"LATERAL=F114 has displacements and a residual of its own: remove those of {name.upper()}="
    elif np.isnan([peak, at, residual, end]).any():
        yield "lateral", "LATERAL=PEAK-RESIDUAL needs PEAK= and RESIDUAL=, a factor and a displacement each"
    elif residual > peak:
        yield "residual", f"the residual is above that of the peak, {peak!r}: correct one of the two"
    elif end <= at:
        yield "residual", f"the residual is reached no later than the peak, {at!r}: correct one of the two"
