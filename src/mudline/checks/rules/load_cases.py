"""Load cases: the kind of run, its times, waves, currents and vessels."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import chain
from typing import Any, NamedTuple

import numpy as np

from mudline.checks.context import LintContext
from mudline.checks.rules.references import in_water
from mudline.language.deck.parameters import name_key
from mudline.language.diagnostics import Code, Problem, Severity, Where
from mudline.language.keywords import catalogue
from mudline.language.keywords.contents import names_given
from mudline.language.keywords.text import shown
from mudline.language.keywords.values import Names
from mudline.language.rules import rule
from mudline.model.scene.context import records_of
from mudline.model.scene.deck_values import DEFAULT_GRAVITY, number

VES002 = Code("VES002", "vessel-without-rao", Severity.WARNING)
TIM005 = Code("TIM005", "static-steps-without-effect", Severity.INFO)
TIM001 = Code("TIM001", "end-not-after-start", Severity.ERROR)
TIM002 = Code("TIM002", "step-limits-out-of-order", Severity.ERROR)
TIM003 = Code("TIM003", "ramp-does-not-fit", Severity.WARNING)
TIM004 = Code("TIM004", "step-too-long-for-waves", Severity.WARNING)
TIM006 = Code("TIM006", "storage-given-twice", Severity.ERROR)
TIM007 = Code("TIM007", "stored-after-the-end", Severity.WARNING)
WAV001 = Code("WAV001", "airy-period-without-amplitude", Severity.ERROR)
WAV002 = Code("WAV002", "breaking-wave", Severity.WARNING)
CUR001 = Code("CUR001", "current-ends-below-surface", Severity.WARNING)
VES001 = Code("VES001", "two-kinds-of-drift", Severity.ERROR)

STEEPEST = 0.142
"""Height over length of the steepest regular wave in deep water (Michell 1893)."""
STEPS = 20
"""Number of time steps in a wave period, at least."""
_ROUNDED = 1e-3
"""Share of the water depth by which a profile may miss the surface."""


def _analysis(context: LintContext) -> set[str]:
    """Return the kinds of run that the deck names."""
    return {str(block.type_).upper() for _, block in context.blocks("ANALYSIS TYPE", "LOAD CASE") if block.type_}


@rule(VES002)
def vessel_without_rao(context: LintContext) -> Iterator[Problem]:
    """A vessel has no response amplitude operators in a dynamic run with waves.

    Without them it stands still in the waves, and the line hangs from a fixed point: the motions that drive the
    touchdown zone are missing. Give the file of the operators with RAO= of *VESSEL,INTEGRATED, or in *RAO. Vessels that
    a time history moves are left out, as are decks that do not say with *ANALYSIS TYPE that they are dynamic.

    Example:
         $MODEL
         *VESSEL,INTEGRATED
          VESSEL=FPSO
          INITIAL POSITION=1005.0, 0.0, 0.0, 90.0
         $LOAD CASE
         *ANALYSIS TYPE
          TYPE=DYNAMIC
         *WAVE-REGULAR
          1.5, 9.0, 180.0
        +*RAO
        + VESSEL=FPSO
        + HEADING=0.0
        + 0.1
        + 0.9, 0.4, 0.0, 0.0, 0.0, 1.1
        + 10.0, 90.0, 0.0, 0.0, 0.0, -80.0

    Finds: 3:9
    """
    waves = any("WAVE" in keyword for _, keyword in in_water(context.deck))
    if not waves or _analysis(context).isdisjoint(("DYNAMIC", "TIME DOMAIN", "FREQUENCY DOMAIN")):
        return
    moving = context.scene.deck.blocks_with("moves_vessels", "LOAD CASE")
    moved = {name_key(name) for _, block in moving for _, name in names_given(block, Names.VESSEL)}
    for keyword in catalogue.definers(Names.VESSEL):
        for where, vessel in context.records(keyword, "vessels"):
            name = str(getattr(vessel, "vessel", None) or "")
            still = name and name_key(name) not in moved and not getattr(vessel, "rao", None)
            if still and not getattr(vessel, "unread", None):
                message = (
                    f"vessel {shown(name)} has no RAO and stands still in the waves: give RAO= in *VESSEL,INTEGRATED, "
                    "or the operators in *RAO"
                )
                yield Problem(VES002, message, where=where.inside("vessel"))


@rule(TIM005)
def static_steps_without_effect(context: LintContext) -> Iterator[Problem]:
    """*NON LINEAR STATIC is given in a run that is not in the frequency domain.

    It sets the steps, the tolerance and the iterations of the static solution from which dynamics in the frequency
    domain start, and has no effect elsewhere. Remove it, or correct *ANALYSIS TYPE.

    Example:
         $LOAD CASE
         *ANALYSIS TYPE
        - TYPE=TIME DOMAIN
        + TYPE=FREQUENCY DOMAIN
         *NON LINEAR STATIC
          5, 0.001, 40

    Finds: 4:1
    """
    kinds = _analysis(context)
    if not kinds or any(kind.startswith("FREQUENCY") for kind in kinds):
        return
    for where, _ in context.written("NON LINEAR STATIC", "LOAD CASE"):
        message = f"no effect: the run is {min(kinds).lower()}, not in the frequency domain; remove *NON LINEAR STATIC"
        yield Problem(TIM005, message, where=where)


# ---------------------------------------------------------------------------------------------------------------- times


@rule(TIM001)
def end_not_after_start(context: LintContext) -> Iterator[Problem]:
    """The end of a run in time does not come after its start.

    The run would have no time step, or go backwards: two values were exchanged, or one was typed into the wrong field.
    Nothing else is reported about the length of such a run. Correct the start or the end. The same holds for the
    part of a run that is summarised.

    Example on storm:
        - 120.0, 0.0, 0.05, 24.0
        + 0.0, 120.0, 0.05, 24.0

    Finds: 7:9
    """
    for where, span in spans(context):
        yield from _backwards(span, where)
    for where, block in context.blocks("TIME", "SUMMARY POSTPROCESSING"):
        if block.start != -1.0:  # the last stored time
            yield from _backwards(block, where)


def _backwards(span: object, where: Where) -> Iterator[Problem]:
    start, end = number(span, "start"), number(span, "end")
    if end <= start:
        message = f"the end {end!r} is not after the start {start!r}: correct one of them"
        yield Problem(TIM001, message, where=where.inside("end"))


@rule(TIM002)
def step_limits_out_of_order(context: LintContext) -> Iterator[Problem]:
    """The suggested time step does not lie between the least and the largest one.

    A variable step begins with the suggested length and stays between the limits: least, suggested, largest. On the
    line the suggested step is the first field. Each of several lines applies from a later time on. Correct the order of
    the values.

    Example:
         $LOAD CASE
         *TIME
          STEP=VARIABLE
          0.0, 120.0, 24.0
        - 0.05, 0.1, 0.2
        + 0.1, 0.05, 0.2

    Finds: 5:2
    """
    for where, block in context.blocks("TIME", "LOAD CASE"):
        before = -float("inf")
        for place, limits in records_of([(where, block)], "limits"):
            suggested, least, largest = (number(limits, name) for name in ("suggested", "least", "largest"))
            if not math.isnan(suggested + least + largest) and not least <= suggested <= largest:
                message = (
                    f"the suggested step {suggested!r} does not lie between the least {least!r} and the largest "
                    f"{largest!r}: correct them"
                )
                yield Problem(TIM002, message, where=place.inside("suggested"))
            since = number(limits, "since")
            if since <= before:
                message = f"this line holds from {since!r} on, the one above it from {before!r}: sort them"
                yield Problem(TIM002, message, where=place.inside("since"))
            before = before if math.isnan(since) else since


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
    for where, span in spans(context):
        ramp, start, end = (number(span, name) for name in ("ramp", "start", "end"))
        if ramp > end - start > 0.0:
            message = f"loads grow over {ramp:g}, longer than the run lasts ({end - start:g}): shorten the ramp"
            yield Problem(TIM003, message, where=where.inside("ramp"))
        elif 0.0 < ramp < longest and not context.blocks("RESTART", "LOAD CASE"):
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
    for where, limits in context.records("TIME", "limits", "LOAD CASE"):
        yield where.inside("largest"), number(limits, "largest")


@rule(TIM006)
def storage_given_twice(context: LintContext) -> Iterator[Problem]:
    """A load case gives twice the times at which its results are stored.

    The manual allows one `*DATABASE` in a load case. If a second one is left over from another run, the times that a
    report needs may be missing from the results. Remove all but one.

    Example on storm:
          3.0, 9.0, 180.0
        |*DATABASE
        | TIME=SELECTED
        | 60.0, 0.5
        -*DATABASE
        - TIME=END

    Finds: 13:1
    """
    seen: set[int] = set()
    for where, _ in context.blocks("DATABASE", "LOAD CASE"):
        if where.section in seen:
            yield Problem(TIM006, "this load case has a *DATABASE above: remove one of them", where=where)
        seen.add(where.section)


@rule(TIM007)
def stored_after_the_end(context: LintContext) -> Iterator[Problem]:
    """Storage of results begins when the run has already ended.

    The run takes its hours and leaves no results. The first time of `*DATABASE` belongs to a longer run, or start and
    interval were exchanged. Correct it, or the end of `*TIME`.

    Example on storm:
          3.0, 9.0, 180.0
        |*DATABASE
        | TIME=SELECTED
        - 600.0, 0.5
        + 60.0, 0.5

    Finds: 12:2
    """
    ends = {
        where.section: end
        for where, block in context.blocks("TIME", "LOAD CASE")
        if not math.isnan(end := number(block.fixed or block.variable, "end"))
    }
    for where, block in context.blocks("DATABASE", "LOAD CASE"):
        start, end = number(block, "start"), ends.get(where.section, math.inf)
        if start >= end > 0.0:  # TIM001 reports an end that is wrong itself
            message = f"results are stored from {start:g} on, and the run ends at {end:g}: correct one of them"
            yield Problem(TIM007, message, where=where.inside("start"))


# ----------------------------------------------------------------------------------------- waves, currents and vessels


class _Wave(NamedTuple):
    """Wave of one period: its height, and the place of the height."""

    height: float
    period: float
    at_height: Where


def waves(context: LintContext) -> list[_Wave]:
    """Return the regular waves of a load case whose height and period are known."""
    found = []
    for where, entry in context.records("WAVE-REGULAR", "waves", "LOAD CASE"):
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


@rule(WAV001)
def airy_period_without_amplitude(context: LintContext) -> Iterator[Problem]:
    """A Stokes or Dean wave has the period of an equivalent Airy wave, but no amplitude for it.

    The response of a vessel is computed with the equivalent Airy wave. Without an amplitude the vessel does not
    respond, and the manual forbids it. Give the amplitude, or leave out both values.

    Example:
         $LOAD CASE
         *WAVE-STOKES
        - 6.0, 12.0, 180.0, 0.0, 12.0
        + 6.0, 12.0, 180.0, 3.0, 12.0

    Finds: 3:25
    """
    for where, wave in by_height(context):
        if wave.airy_period and not wave.airy_amplitude:
            message = "the equivalent Airy wave has a period and no amplitude: give both or neither"
            yield Problem(WAV001, message, where=where.inside("airy_period"))


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
    for where, current in context.records("CURRENT", "currents", "LOAD CASE"):
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


@rule(VES001)
def two_kinds_of_drift(context: LintContext) -> Iterator[Problem]:
    """A vessel drifts by a sinusoid and by a file.

    A file of displacements has the whole slow motion of a vessel, and the manual allows one kind of drift for each
    vessel. Either a line is left over from an earlier load case, or the name of another vessel was meant. Remove one
    kind.

    Example:
         $MODEL
         *VESSEL
          VESSEL=FPSO
          INITIAL POSITION=100.0, 0.0, 0.0
         $LOAD CASE
         *DRIFT
          VESSEL=FPSO, TYPE=SINUSOIDAL
          2, 4.0, 0.0, 120.0
        - VESSEL=FPSO, TYPE=FILE
        - FILE=drift.dat

    Finds: 9:20
    """
    kinds: dict[str, str] = {}
    for where, drift in context.records("DRIFT", "drifts", "LOAD CASE"):
        if not drift.vessel or not drift.type_:
            continue
        kind = kinds.setdefault(name_key(drift.vessel), drift.type_)
        if kind != drift.type_:
            message = f"vessel {shown(drift.vessel)} has a drift of TYPE={kind} above: give it one kind"
            yield Problem(VES001, message, where=where.inside("type"))
