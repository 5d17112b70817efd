"""Waves, currents and hydrodynamic coefficients, compared with the water depth and the time steps of the run."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import chain
from typing import Any, NamedTuple

import numpy as np

from mudline.checks.context import LintContext, records_of
from mudline.checks.rules.model_parts import lacks, without_sections
from mudline.checks.rules.references import in_water
from mudline.checks.rules.seabed_position import first_of
from mudline.checks.rules.seabed_support import in_another_pipe
from mudline.language.diagnostics import Code, Problem, Severity, Where
from mudline.language.rules import rule
from mudline.model.scene.deck_values import DEFAULT_GRAVITY, number

WAV002 = Code("WAV002", "breaking-wave", Severity.WARNING)
TIM003 = Code("TIM003", "ramp-does-not-fit", Severity.WARNING)
TIM004 = Code("TIM004", "step-too-long-for-waves", Severity.WARNING)
CUR001 = Code("CUR001", "current-ends-below-surface", Severity.WARNING)
GEO008 = Code("GEO008", "missing-hydrodynamics", Severity.INFO)
GEO016 = Code("GEO016", "added-mass-order", Severity.INFO)

STEEPEST = 0.142
"""Height over length of the steepest regular wave in deep water (Michell 1893)."""
STEPS = 20
"""Number of time steps in a wave period, at least."""
_ROUNDED = 1e-3
"""Share of the water depth by which a profile may miss the surface."""


class _Wave(NamedTuple):
    """Wave of one period: its height, and the place of the height."""

    height: float
    period: float
    at_height: Where


def waves(context: LintContext) -> list[_Wave]:
    """Return the regular waves of a load case whose height and period are known."""
    found = []
    for where, entry in records_of(context.blocks("WAVE-REGULAR", "LOAD CASE"), "waves"):
        height, period = 2.0 * number(entry.wave, "amplitude"), number(entry.wave, "period")
        found.append(_Wave(height, period, where.inside("wave", "amplitude")))
    for where, wave in by_height(context):
        found.append(_Wave(number(wave, "height"), number(wave, "period"), where.inside("height")))
    return [wave for wave in found if wave.height > 0.0 and wave.period > 0.0]


def by_height(context: LintContext) -> Iterator[tuple[Where, Any]]:
    """Return the waves that have their own keyword, with a height and an equivalent Airy wave for vessels."""
    return chain(context.blocks("WAVE-STOKES", "LOAD CASE"), context.blocks("WAVE-DEANS", "LOAD CASE"))


@rule(WAV002)
def breaking_wave(context: LintContext) -> Iterator[Problem]:
    """A regular wave is steeper than a wave can be.

    In deep water a wave breaks when its height is more than 0.142 of its length g T^2 / (2 pi). In shallow water it
    breaks at a smaller height still. Height and period were exchanged, the height is given instead of the amplitude, or
    a unit is wrong. Correct the wave.

    Example on storm:
        - 9.0, 6.0, 180.0
        + 3.0, 9.0, 180.0

    Finds: 9:2
    """
    given = context.scene.surroundings.gravity
    gravity = given if given > 0.0 else DEFAULT_GRAVITY.get(context.scene.units, math.nan)
    for wave in context.once(waves):
        length = gravity * wave.period * wave.period / (2.0 * math.pi)
        if wave.height > STEEPEST * length:
            message = (
                f"a wave {wave.height:g} high with a period of {wave.period:g} is {wave.height / length:.3g} of its "
                f"length high, and breaks at {STEEPEST}: correct height or period"
            )
            yield Problem(WAV002, message, where=wave.at_height)


@rule(TIM003)
def ramp_does_not_fit(context: LintContext) -> Iterator[Problem]:
    """The ramp of loads is shorter than a wave period, or longer than the run.

    The ramp lets a run begin without a jolt. If it is shorter than the longest wave period, the first wave comes at
    once, and the motions that it excites spoil the start of the results. With a ramp beyond the end of the run the
    loads never reach their full size. Correct the ramp, the last value of the first line of *TIME. A ramp of 0 and runs
    that continue another one are left out.

    Example on storm:
        - 0.0, 120.0, 0.05, 5.0
        + 0.0, 120.0, 0.05, 24.0

    Finds: 7:20
    """
    longest = max((wave.period for wave in context.once(waves)), default=0.0)
    continues = bool(context.blocks("RESTART", "LOAD CASE"))
    for where, span in spans(context):
        ramp, start, end = (number(span, name) for name in ("ramp", "start", "end"))
        if ramp > end - start > 0.0:
            message = f"loads grow over {ramp:g}, longer than the run lasts ({end - start:g}): shorten the ramp"
            yield Problem(TIM003, message, where=where.inside("ramp"))
        elif 0.0 < ramp < longest and not continues:
            message = f"loads grow over {ramp:g}, less than the wave period {longest:g}: give them a period at least"
            yield Problem(TIM003, message, where=where.inside("ramp"))


@rule(TIM004)
def step_too_long_for_waves(context: LintContext) -> Iterator[Problem]:
    """The time step is more than a twentieth of the shortest wave period.

    With such steps the wave is no longer a smooth curve: forces and motions at its crest are missed. The largest of
    variable steps counts; periods of random seas are not checked. Shorten the step. `mudline study` measures if it
    is short enough for the seabed too.

    Example on storm:
        - 0.0, 120.0, 1.0, 24.0
        + 0.0, 120.0, 0.05, 24.0

    Finds: 7:14
    """
    shortest = min((wave.period for wave in context.once(waves)), default=math.inf)
    for where, step in _steps(context):
        if step > shortest / STEPS:
            message = (
                f"a time step of {step:g} is more than a twentieth of the wave period {shortest:g}: "
                f"give {shortest / STEPS:g} or less"
            )
            yield Problem(TIM004, message, where=where)


def spans(context: LintContext) -> Iterator[tuple[Where, object]]:
    """Yield the time spans of a load case."""
    for where, block in context.blocks("TIME", "LOAD CASE"):
        for name in ("fixed", "variable"):
            if (span := getattr(block, name)) is not None:
                yield where.inside(name), span


def _steps(context: LintContext) -> Iterator[tuple[Where, float]]:
    """Yield the time steps of a load case: fixed ones, and the largest of variable ones."""
    for where, span in spans(context):
        yield where.inside("increment"), number(span, "increment")
    for where, limits in records_of(context.blocks("TIME", "LOAD CASE"), "limits"):
        yield where.inside("largest"), number(limits, "largest")


# ------------------------------------------------------------------------------------------------------------- currents


@rule(CUR001)
def current_ends_below_surface(context: LintContext) -> Iterator[Problem]:
    """A current profile ends below the surface of the sea.

    Elevations count upward from X = 0 at the mudline, unless OPTION=DESCEND gives depths below the water line. A
    profile that ends far below the surface was written from the surface down, or for another depth. Its missing points
    are mostly where the current is strongest. Give a point at the surface, or OPTION=DESCEND.

    Example on storm:
          3.0, 9.0, 180.0
        |*CURRENT
        | TYPE=PIECEWISE LINEAR
        | 0.0, 0.1
        - 300.0, 0.9
        + 420.0, 0.9

    Finds: 13:2
    """
    depth = context.scene.surroundings.depth
    for where, current in records_of(context.blocks("CURRENT", "LOAD CASE"), "currents"):
        elevations = current.profile.column(0) if current.profile is not None else np.zeros(0)
        if not depth > 0.0 or not elevations.size or np.isnan(elevations).any():
            continue
        descends = str(current.option).startswith("DESCEND")
        row = int(elevations.argmin() if descends else elevations.argmax())
        missing = float(elevations[row]) if descends else depth - float(elevations[row])
        if missing > _ROUNDED * depth:
            advice = "" if descends else ", or OPTION=DESCEND for depths below the water line"
            message = f"the profile ends {missing:g} below the surface of {depth:g} deep water: give a point there"
            yield Problem(CUR001, f"{message}{advice}", where=where.inside("profile", row))


# --------------------------------------------------------------------------------------------------------- coefficients


@rule(GEO008)
def missing_hydrodynamics(context: LintContext) -> Iterator[Problem]:
    """Elements have no hydrodynamic properties in a load case with waves or a current.

    No set of *HYDRODYNAMIC SETS holds them, so neither drag nor added mass acts on them. That is right in a moonpool,
    and a mistake elsewhere. Inner pipes of *PIP SECTION need no coefficients. Put the elements into a set with
    coefficients.

    Example on held:
         $MODEL
        |*OCEAN
        | 420.0, 1025.0, 9.81

          GEN=1, 2
        |*ELEMENT SETS
        | SET=Pipe
        - 1
        + 1, 2
        |*HYDRODYNAMIC SETS
        | SET=Pipe, TYPE=CONSTANT
        | 1.0, 0.0, 2.0
         $LOAD CASE
        |*CURRENT
        | TYPE=UNIFORM
        | 0.5

    Finds: 10:2
    """
    scene = context.scene
    if not any(in_water(context.deck)) or not lacks(context, "elements", "hydrodynamics"):
        return
    covered = np.zeros(len(scene.element_ids), dtype=np.bool_)
    for _, entry in records_of(context.blocks("HYDRODYNAMIC SETS")):
        set_ = scene.set_table.find(entry.set_name) if isinstance(entry.set_name, str) else None
        if set_ is None:
            return
        covered[set_.elements] = True
    bare = np.flatnonzero(~(covered | without_sections(scene) | in_another_pipe(scene)))
    if bare.size:
        what = first_of("element", scene.element_ids[bare[0]], bare.size)
        message = f"{what} without coefficients in *HYDRODYNAMIC SETS: give them, else neither drag nor added mass acts"
        yield Problem(GEO008, message, where=scene.table.numbered.where(int(bare[0])))


@rule(GEO016)
def added_mass_order(context: LintContext) -> Iterator[Problem]:
    """A line of `*HYDRODYNAMIC SETS` gives two different added mass coefficients, whose order is inferred.

    mudline reads the normal coefficient first, as in decks of the older program (.das). The manual's page on theory
    lists the tangential one first, and no public page shows the line itself. Nothing that mudline evaluates depends on
    the order, but it matters if the values are copied. If the coefficients are the defaults, the normal inertia minus 1
    and 0, leave both fields empty: then there is no doubt.

    Example on sets:
          GEN=3, 4
        |*HYDRODYNAMIC SETS
        | SET=ALL, TYPE=CONSTANT
        - 1.0, 0.0, 2.0, 1.0, 0.0
        + 1.0, 0.0, 2.0

    Finds: 16:17
    """
    if context.deck.file.lower().endswith(".das"):
        return
    lines = []
    for where, entry in records_of(context.blocks("HYDRODYNAMIC SETS")):
        normal, tangential, inertia = (
            number(entry.constant, name) for name in ("normal_added_mass", "tangential_added_mass", "normal_inertia")
        )
        if abs(normal - tangential) > 0.0:
            lines.append((where.inside("constant", "normal_added_mass"), normal, tangential, inertia))
    if lines:
        where, normal, tangential, inertia = lines[0]
        others = f"; so are those of {len(lines) - 1} more sets" * (len(lines) > 1)
        defaults = normal == inertia - 1.0 and tangential == 0.0
        advice = "these are the defaults, remove both" if defaults else "keep them if they are meant so"
        message = (
            f"the added masses are read as {normal:g} normal, {tangential:g} tangential (inferred){others}: {advice}"
        )
        yield Problem(GEO016, message, where=where)
