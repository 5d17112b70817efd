"""Friction, lateral resistance and suction of the seabed."""

from __future__ import annotations

from collections.abc import Iterator

from mudline.diagnostics import Code, Problem, Severity
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.linting.rules.seabed.given import absent, given, positive
from mudline.linting.rules.seabed.replaced import friction_replaced

SBD007 = Code("SBD007", "lateral-and-friction", Severity.WARNING)
SBD013 = Code("SBD013", "legacy-friction-order", Severity.WARNING)
SBD014 = Code("SBD014", "unused-friction-stiffness", Severity.INFO)
SBD015 = Code("SBD015", "extent-without-stiffness", Severity.WARNING)
SBD020 = Code("SBD020", "unused-characteristic-length", Severity.INFO)
SBD024 = Code("SBD024", "one-friction-coefficient", Severity.WARNING)

_DIRECTIONS = ("longitudinal", "transverse")
_CHARACTERISTIC = (3.048, 10.0)


@rule(SBD007)
def lateral_and_friction(context: LintContext) -> Iterator[Problem]:
    """Lateral resistance and transverse friction are given for the same elements.

    A lateral spring takes the place of transverse friction and never adds to it: the program sets the transverse
    coefficient to zero. Lateral walking is then held by the spring alone, however large the coefficient is. Keep the
    one that the assessment is meant to rest on.

    Example:
         $MODEL
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=50000.0
        - FRICTION=0.3, 0.6
        + FRICTION=0.3, 0.0
          LATERAL=2000.0

    Finds: 7:10
    """
    for entry in given(context):
        friction = entry.value("transverse")
        both = entry.type_ != "RIGID" and positive(entry.value("lateral")) and positive(friction)
        if both and not friction_replaced(context, entry):
            message = f"lateral resistance sets the transverse friction coefficient {friction!r} to zero: remove one"
            yield Problem(SBD007, message, where=entry.place("lateral"))


@rule(SBD013)
def legacy_friction_order(context: LintContext) -> Iterator[Problem]:
    """FRICTION= seems to have the order of fields of a legacy surface.

    Behind the two coefficients *RIGID SURFACE has characteristic lengths, whose default is 3.048 m or 10 ft, where
    FRICTION= has mobilisation lengths. A line copied from a legacy deck then spreads the build-up of friction over
    metres, and the pipe slides far before it is held. Leave the field empty, or give the mobilisation length.

    Example:
         $MODEL
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=50000.0
        - FRICTION=0.3, 0.6, 3.048, 3.048
        + FRICTION=0.3, 0.6, 0.03, 0.05

    Finds: 6:21
    """
    for entry in given(context):
        length = entry.value("longitudinal_mobilisation")
        if not entry.legacy and length in _CHARACTERISTIC:
            message = (
                f"{length!r} is a usual characteristic length of legacy surfaces, and the third field of FRICTION= is "
                "the mobilisation length (inferred from the value): give that, or remove it"
            )
            yield Problem(SBD013, message, where=entry.place("longitudinal_mobilisation"))


@rule(SBD014)
def unused_friction_stiffness(context: LintContext) -> Iterator[Problem]:
    """A friction stiffness is given in a direction whose coefficient is zero.

    Modal and frequency-domain runs put the stiffness in place of friction only where the coefficient is not zero; in
    this direction the pipe is free, and the modes have less restraint than the deck seems to give. The same holds for
    *FRICTION of a load case or of modes. Give a coefficient, or remove the stiffness.

    Example:
         $MODEL
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=50000.0
        - FRICTION=0.0, 0.6, , , , 500.0, 250.0
        + FRICTION=0.3, 0.6, , , , 500.0, 250.0

    Finds: 6:27
    """
    for entry in given(context):
        for direction in _DIRECTIONS:
            name = f"{direction}_stiffness"
            idle = positive(entry.value(name)) and absent(context, entry, direction)
            if idle and not friction_replaced(context, entry):
                message = f"the {direction} friction stiffness is unused: the coefficient is 0; give one, or remove it"
                yield Problem(SBD014, message, where=entry.place(name))
    yield from _of_load_cases(context)


def _of_load_cases(context: LintContext) -> Iterator[Problem]:
    """Stiffnesses of *FRICTION in directions in which no place of the model has a coefficient."""
    scene = context.scene
    blocks = [found for section in ("LOAD CASE", "MODES") for found in scene.deck.blocks("FRICTION", section)]
    if not blocks or scene.context.restart or "SEABED FRICTION" in scene.deck.keywords():
        return
    entries = list(given(context))
    for direction in _DIRECTIONS if entries else ():
        if not all(absent(context, entry, direction) for entry in entries):
            continue
        for where, block in blocks:
            stiffness = getattr(block, direction, None)
            if isinstance(stiffness, float | int) and stiffness > 0.0:
                message = (
                    f"the {direction} friction stiffness is unused: the seabed has no {direction} coefficient; give "
                    "one, or remove it"
                )
                yield Problem(SBD014, message, where=where._replace(path=(direction,)))


@rule(SBD015)
def extent_without_stiffness(context: LintContext) -> Iterator[Problem]:
    """A suction zone has an extent and no stiffness.

    The extent is the height over which suction holds a rising pipe; without a stiffness nothing holds it, and uplift is
    free at once. Give the suction stiffness, or remove the extent.

    Example:
         $MODEL
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=50000.0
        - SUCTION=0.0, 0.15
        + SUCTION=8000.0, 0.15

    Finds: 6:15
    """
    for entry in given(context):
        if positive(entry.value("suction_extent")) and absent(context, entry, "suction_stiffness"):
            message = "a suction zone without suction stiffness holds nothing: give the stiffness, or remove the extent"
            yield Problem(SBD015, message, where=entry.place("suction_extent"))


@rule(SBD020)
def unused_characteristic_length(context: LintContext) -> Iterator[Problem]:
    """A characteristic length is given together with a mobilisation length.

    The mobilisation length of a direction overrides its characteristic length, which then counts for nothing: a reader
    who changes it to see what the mesh does will see no change. Remove the one that is not meant.

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
    for entry in given(context):
        for direction in _DIRECTIONS if entry.legacy else ():
            name = f"{direction}_length"
            both = positive(entry.value(name)) and positive(entry.value(f"{direction}_mobilisation"))
            if both and not friction_replaced(context, entry):
                message = f"the {direction} mobilisation length overrides this characteristic length: remove one"
                yield Problem(SBD020, message, where=entry.place(name))


@rule(SBD024)
def one_friction_coefficient(context: LintContext) -> Iterator[Problem]:
    """Friction has a longitudinal coefficient and no transverse one.

    The second coefficient is 0 unless it is given (stated for the legacy surfaces, inferred for FRICTION=), so nothing
    but the pipe itself resists sideways movement: it slides under the smallest current. People who mean one coefficient
    for both directions write it once. Give both, or a 0 where no transverse friction is meant. A line with LATERAL=
    needs none, as its spring replaces transverse friction.

    Example:
         $MODEL
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=50000.0
        - FRICTION=0.6
        + FRICTION=0.6, 0.6

    Finds: 6:11
    """
    for entry in given(context):
        longitudinal = entry.value("longitudinal")
        single = positive(longitudinal) and entry.value("transverse") is None and absent(context, entry, "transverse")
        sprung = entry.type_ != "RIGID" and positive(entry.value("lateral"))
        if single and not sprung and not friction_replaced(context, entry):
            source = "0" if entry.legacy else "0 (inferred)"
            message = (
                f"friction has one coefficient, {longitudinal!r}, and the transverse one is then {source}: "
                "give both, the second one as 0 if that is meant"
            )
            yield Problem(SBD024, message, where=entry.place("longitudinal"))
