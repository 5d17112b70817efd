"""Friction, lateral resistance and suction of the seabed, and the resistance of soil springs."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, NamedTuple, cast

import numpy as np

from mudline.checks.context import LintContext
from mudline.language.deck.parameters import folded
from mudline.language.diagnostics import Code, Problem, Severity, Where
from mudline.language.keywords.table import Table
from mudline.language.rules import rule
from mudline.model.scene.context import records_of
from mudline.model.scene.deck_values import number
from mudline.model.scene.laws import DIRECTIONS, typed_blocks
from mudline.model.scene.sets import ALL

SBD007 = Code("SBD007", "lateral-and-friction", Severity.WARNING)
SBD013 = Code("SBD013", "legacy-friction-order", Severity.WARNING)
SBD014 = Code("SBD014", "unused-friction-stiffness", Severity.INFO)
SBD015 = Code("SBD015", "extent-without-stiffness", Severity.WARNING)
SBD019 = Code("SBD019", "short-mobilisation", Severity.WARNING)
SBD020 = Code("SBD020", "unused-characteristic-length", Severity.INFO)
SBD024 = Code("SBD024", "one-friction-coefficient", Severity.WARNING)
CRV015 = Code("CRV015", "repeated-depth", Severity.WARNING)
CRV016 = Code("CRV016", "soil-gains-again", Severity.INFO)

_OF_SET = {
    "lateral": ("lateral",),
    "suction_stiffness": ("suction", "stiffness"),
    "suction_extent": ("suction", "extent"),
}


@rule(SBD007)
def lateral_and_friction(context: LintContext) -> Iterator[Problem]:
    """Lateral resistance and transverse friction are given for the same elements.

    A lateral spring replaces transverse friction and never adds to it: the program sets the transverse coefficient to
    zero. Only the spring then resists lateral walking, however large the coefficient is. Keep the one that the
    assessment relies on.

    Example on seabed:
          STIFFNESS=50000.0
        - FRICTION=0.3, 0.6
        + FRICTION=0.3, 0.0
        | LATERAL=2000.0

    Finds: 7:10
    """
    for entry in context.once(given):
        friction = entry.value("transverse")
        both = entry.type_ != "RIGID" and positive(entry.value("lateral")) and positive(friction)
        if both and not friction_replaced(context, entry):
            message = f"lateral resistance sets the transverse friction coefficient {friction!r} to zero: remove one"
            yield Problem(SBD007, message, where=entry.place("lateral"))


@rule(SBD013)
def legacy_friction_order(context: LintContext) -> Iterator[Problem]:
    """FRICTION= seems to have the field order of a legacy surface.

    After the two coefficients *RIGID SURFACE has characteristic lengths, whose default is 3.048 m or 10 ft. FRICTION=
    has mobilisation lengths there. A line copied from a legacy deck then mobilises friction over metres, and the pipe
    slides far before it is held. Leave the field empty, or give the mobilisation length.

    Example on seabed:
          STIFFNESS=50000.0
        - FRICTION=0.3, 0.6, 3.048, 3.048
        + FRICTION=0.3, 0.6, 0.03, 0.05

    Finds: 6:21
    """
    for entry in context.once(given):
        length = entry.value("longitudinal_mobilisation")
        if not entry.legacy and length in (3.048, 10.0):
            message = (
                f"{length!r} is a usual characteristic length of legacy surfaces, and the third field of FRICTION= is "
                "the mobilisation length (inferred from the value): give that, or remove it"
            )
            yield Problem(SBD013, message, where=entry.place("longitudinal_mobilisation"))


@rule(SBD014)
def unused_friction_stiffness(context: LintContext) -> Iterator[Problem]:
    """A friction stiffness is given in a direction whose coefficient is zero.

    Modal and frequency-domain runs use the stiffness instead of friction only where the coefficient is not zero; in
    this direction the pipe is free, and the modes have less restraint than the deck suggests. The same holds for
    *FRICTION of a load case or of modes. Give a coefficient, or remove the stiffness.

    Example on seabed:
          STIFFNESS=50000.0
        - FRICTION=0.0, 0.6, , , , 500.0, 250.0
        + FRICTION=0.3, 0.6, , , , 500.0, 250.0

    Finds: 6:27
    """
    for entry in context.once(given):
        for direction in DIRECTIONS:
            name = f"{direction}_stiffness"
            idle = positive(entry.value(name)) and absent(entry, direction)
            if idle and not friction_replaced(context, entry):
                message = f"the {direction} friction stiffness is unused: the coefficient is 0; give one, or remove it"
                yield Problem(SBD014, message, where=entry.place(name))
    yield from _of_load_cases(context)


def _of_load_cases(context: LintContext) -> Iterator[Problem]:
    """Yield problems of *FRICTION stiffnesses in directions in which no place of the model has a coefficient."""
    scene = context.scene
    blocks = [placed for section in ("LOAD CASE", "MODES") for placed in context.blocks("FRICTION", section)]
    if not blocks or scene.context.restart or "SEABED FRICTION" in context.keywords:
        return
    entries = context.once(given)
    for direction in DIRECTIONS if entries else ():
        if not all(absent(entry, direction) for entry in entries):
            continue
        for where, block in blocks:
            stiffness = getattr(block, direction, None)
            if isinstance(stiffness, float | int) and stiffness > 0.0:
                message = (
                    f"the {direction} friction stiffness is unused: the seabed has no {direction} coefficient; give "
                    "one, or remove it"
                )
                yield Problem(SBD014, message, where=where.inside(direction))


@rule(SBD015)
def extent_without_stiffness(context: LintContext) -> Iterator[Problem]:
    """A suction zone has an extent but no stiffness.

    The extent is the height over which suction resists a rising pipe; without a stiffness there is no suction. Give the
    suction stiffness, or remove the extent.

    Example on seabed:
          STIFFNESS=50000.0
        - SUCTION=0.0, 0.15
        + SUCTION=8000.0, 0.15

    Finds: 6:15
    """
    for entry in context.once(given):
        if positive(entry.value("suction_extent")) and absent(entry, "suction_stiffness"):
            message = "a suction zone without suction stiffness has no effect: give the stiffness, or remove the extent"
            yield Problem(SBD015, message, where=entry.place("suction_extent"))


@rule(SBD020)
def unused_characteristic_length(context: LintContext) -> Iterator[Problem]:
    """A characteristic length is given together with a mobilisation length.

    The mobilisation length of a direction overrides its characteristic length: changing the characteristic length has
    no effect. Remove the one that is not meant.

    Example:
         $MODEL
        -*ELASTIC SURFACE
        - 50000.0, 0.3, 0.6, , , , 3.048, , , 0.03
        +*SEABED PROPERTIES
        + TYPE=ELASTIC
        + SET=ALL
        + STIFFNESS=50000.0
        + FRICTION=0.3, 0.6, 0.03

    Finds: 3:27
    """
    for entry in context.once(given):
        for direction in DIRECTIONS if entry.legacy else ():
            name = f"{direction}_length"
            both = positive(entry.value(name)) and positive(entry.value(f"{direction}_mobilisation"))
            if both and not friction_replaced(context, entry):
                message = f"the {direction} mobilisation length overrides this characteristic length: remove one"
                yield Problem(SBD020, message, where=entry.place(name))


@rule(SBD024)
def one_friction_coefficient(context: LintContext) -> Iterator[Problem]:
    """Friction has a longitudinal coefficient but no transverse one.

    The second coefficient is 0 unless it is given (stated for the legacy surfaces, inferred for FRICTION=). Then only
    the pipe itself resists sideways movement, and it slides under the smallest current. If one coefficient is meant for
    both directions, it is often written once. Give both, or a 0 where no transverse friction is meant. A line with
    LATERAL= needs no transverse coefficient, as its spring replaces transverse friction.

    Example on seabed:
          STIFFNESS=50000.0
        - FRICTION=0.6
        + FRICTION=0.6, 0.6

    Finds: 6:11
    """
    for entry in context.once(given):
        longitudinal = entry.value("longitudinal")
        single = positive(longitudinal) and entry.value("transverse") is None and absent(entry, "transverse")
        sprung = entry.type_ != "RIGID" and positive(entry.value("lateral"))
        if single and not sprung and not friction_replaced(context, entry):
            source = "0" if entry.legacy else "0 (inferred)"
            message = (
                f"friction has one coefficient, {longitudinal!r}, and the transverse one is then {source}: "
                "give both, the second one as 0 if that is meant"
            )
            yield Problem(SBD024, message, where=entry.place("longitudinal"))


@rule(SBD019)
def short_mobilisation(context: LintContext) -> Iterator[Problem]:
    """A mobilisation length is under a ten-thousandth of the diameter.

    Friction then builds up almost at once: its spring is so stiff that the solution jumps between stick and slip and
    hardly converges. Soil mobilises friction over some thousandths of a diameter at least. Give a longer
    mobilisation length.

    Example on pipe:
          STIFFNESS=50000.0
        - FRICTION=0.3, 0.6, 0.00001, 0.05
        + FRICTION=0.3, 0.6, 0.03, 0.05

    Finds: 17:21
    """
    scene = context.scene
    resistance = scene.resistance
    if not resistance.has_mobilisation:
        return
    lengths, friction = resistance.column("mobilisation"), resistance.column("friction")
    friction[resistance.column("lateral") > 0.0, 1] = 0.0  # a lateral spring replaces it
    if replacing := scene.extensions.get("SEABED FRICTION"):
        friction[replacing.of_element >= 0] = 0.0
    for side, name in enumerate(("longitudinal_mobilisation", "transverse_mobilisation")):
        length = lengths[:, side]
        short = (length > 0.0) & (friction[:, side] > 0.0) & (length < 1e-4 * scene.diameter)
        for index in sorted(set(resistance.of_element[short].tolist())):
            where = resistance.places[index]
            path = (name,) if where.path[0] == "properties" else ("friction", name)
            value = resistance.values[index].mobilisation[side]
            message = f"mobilisation length {value!r} is under 1e-4 diameters of the pipe: give a longer one"
            yield Problem(SBD019, message, where=where.inside(*path))


class FrictionEntry(NamedTuple):
    """Set of *SEABED PROPERTIES, or first line of a legacy surface; `type_` is None where it is not known."""

    part: Any
    where: Where
    type_: str | None
    legacy: bool

    def place(self, name: str) -> Where:
        """Return the place of a value; names are those of the fields of *ELASTIC SURFACE."""
        return self.where.inside(*self._path(name))

    def value(self, name: str) -> float | None:
        """Return a value: None where the deck gives none, NaN where it could not be read."""
        number = self.part
        for step in self._path(name):
            number = getattr(number, step, None)
        if number is None:
            return None
        return float(cast("float", number)) if isinstance(number, float | int) else math.nan

    def _path(self, name: str) -> tuple[str, ...]:
        return (name,) if self.legacy else _OF_SET.get(name, ("friction", name))


def given(context: LintContext) -> list[FrictionEntry]:
    """Return legacy surfaces first, then the sets of *SEABED PROPERTIES in the order of the file."""
    entries = [
        FrictionEntry(
            getattr(surface, "properties", None),
            where.inside("properties"),
            surface.facts.seabed_type,
            legacy=True,
        )
        for where, surface in context.scene.context.surfaces
    ]
    for where, properties, type_ in typed_blocks(context.scene.context):
        entries += [FrictionEntry(entry, at, type_, legacy=False) for at, entry in records_of([(where, properties)])]
    return entries


def positive(value: float | None) -> bool:
    """Return True if a value is given, could be read and is above zero."""
    return value is not None and value > 0.0


def absent(entry: FrictionEntry, name: str) -> bool:
    """Return True if the deck gives no value, or zero."""
    value = entry.value(name)
    return value is None or value == 0.0


def friction_replaced(context: LintContext, entry: FrictionEntry) -> bool:
    """Return True if `*SEABED FRICTION` replaces the friction of every element that follows this place.

    For sets whose elements the deck does not show only the names are compared.
    """
    friction = context.scene.extensions.get("SEABED FRICTION")
    if friction is None:
        return False
    names = {folded(held.name) for held in friction.sets if held is not None}
    if ALL in names:
        return True
    resistance = context.scene.resistance
    followers = np.zeros(0, dtype=np.intp)
    if entry.where in resistance.places:
        followers = np.flatnonzero(resistance.of_element == resistance.places.index(entry.where))
    if followers.size:
        return bool((friction.of_element[followers] >= 0).all())
    return not entry.legacy and folded(str(entry.part.set_name)) in names


# --------------------------------------------------------------------------------------------------------- soil springs


@rule(CRV015)
def repeated_depth(context: LintContext) -> Iterator[Problem]:
    """A soil spring has two curves at one depth, or a depth above the one before it.

    The resistance is interpolated between the given depths: at a depth that is given twice it jumps, or one of its
    curves is not used at all. Mostly the second curve was copied and kept the depth of the first. Depths that do
    not ascend are an info, as nothing says that they must. Correct the depth.

    Example on pipe:
          STIFFNESS=50000.0
        |*P-Y
        | SET=ALL
        | DEPTH=0.0
        | 0.0, 0.0
        | 2000.0, 0.05
        - DEPTH=0.0
        + DEPTH=5.0
        | 0.0, 0.0
        | 20000.0, 0.05

    Finds: 22:8
    """
    for place, curves in _springs(context):
        before: list[float] = []
        for at, curve in enumerate(curves):
            depth = number(curve, "depth", math.inf)  # one that is not known is deeper than all others
            where = place.inside(at, "depth")
            if depth in before and depth < math.inf:
                yield Problem(CRV015, f"there is already a curve at depth {depth:g}: correct one", where=where)
            elif before and depth < max(before):
                message = f"depth {depth:g} follows {max(before):g}: write the curves from the mudline downwards"
                yield Problem(CRV015, message, where=where, severity=Severity.INFO)
            before.append(depth)


@rule(CRV016)
def soil_gains_again(context: LintContext) -> Iterator[Problem]:
    """The resistance of a soil spring falls, and rises again at larger displacements.

    Softening soil falls to a residual resistance and stays there; it does not regain strength at larger displacements.
    A curve that rises again mostly has a wrong digit in one point, or two points exchanged. Correct it, or leave it if
    it was measured so. Each side of a curve is checked by itself.

    Example on pipe:
          STIFFNESS=50000.0
        |*P-Y
        | SET=ALL
        | DEPTH=5.0
        | 0.0, 0.0
        | 9000.0, 0.01
        - 1500.0, 0.05
        + 15000.0, 0.05
        | 18000.0, 0.2

    Finds: 22:2
    """
    for place, curves in _springs(context):
        for at, curve in enumerate(curves):
            if isinstance(curve.points, Table) and (lowest := _gains_again(curve.points)) is not None:
                resistance, displacement = (float(curve.points.column(each)[lowest]) for each in (0, 1))
                message = (
                    f"resistance falls to {resistance:g} at {displacement:g} and rises again farther out, as no soil "
                    "does that has softened: correct a point, or leave it if it was measured"
                )
                yield Problem(CRV016, message, where=place.inside(at, "points", lowest))


def _springs(context: LintContext) -> Iterator[tuple[Where, list[Any]]]:
    """Yield the place and the curves of each set of soil springs."""
    for where, entry in records_of(context.scene.deck.blocks_with("soil_springs")):
        yield where.inside("curves"), entry.curves


def _gains_again(points: Table) -> int | None:
    """Return the row to which resistance falls before it rises again, on either side of a curve; None without one."""
    resistance, displacement = points.column(0), points.column(1)
    for side in (1.0, -1.0):
        rows = np.flatnonzero((side * displacement >= 0.0) & np.isfinite(resistance))
        rows = rows[np.argsort(np.abs(displacement[rows]), kind="stable")]
        steps = np.diff(np.abs(resistance[rows]))
        falls = np.flatnonzero(steps < 0.0)
        rises = np.flatnonzero(steps > 0.0)
        if falls.size and rises.size and rises[-1] > falls[0]:
            return int(rows[rises[rises > falls[0]][0]])
    return None
