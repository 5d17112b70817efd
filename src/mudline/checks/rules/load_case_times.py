"""Load cases in time, and contradictions between their values."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, cast

from mudline.checks.context import LintContext
from mudline.checks.rules.waves import by_height
from mudline.language.deck.parameters import name_key
from mudline.language.diagnostics import Code, Problem, Severity, Where
from mudline.language.keywords.text import shown
from mudline.language.keywords.unknown import is_unknown
from mudline.language.rules import rule
from mudline.model.scene.deck_values import number

if TYPE_CHECKING:
    from mudline.language.keywords.library.analysis import StepLimits, TimeSpan
    from mudline.language.keywords.library.summary import SummaryTime
    from mudline.language.keywords.library.vessel_motions import Drift

TIM001 = Code("TIM001", "end-not-after-start", Severity.ERROR)
TIM002 = Code("TIM002", "step-limits-out-of-order", Severity.ERROR)
WAV001 = Code("WAV001", "airy-period-without-amplitude", Severity.ERROR)
VES001 = Code("VES001", "two-kinds-of-drift", Severity.ERROR)
TIM006 = Code("TIM006", "storage-given-twice", Severity.ERROR)
TIM007 = Code("TIM007", "stored-after-the-end", Severity.WARNING)

_LAST_STORED = -1.0


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
    for where, block in context.blocks("TIME", "LOAD CASE"):
        for name in ("fixed", "variable"):
            span = getattr(cast("TimeSpan", block), name)
            yield from _backwards(span, where.inside(name))
    for where, block in context.blocks("TIME", "SUMMARY POSTPROCESSING"):
        summary = cast("SummaryTime", block)
        if summary.start != _LAST_STORED:
            yield from _backwards(summary, where)


def _backwards(span: object, where: Where) -> Iterator[Problem]:
    start, end = getattr(span, "start", None), getattr(span, "end", None)
    if isinstance(start, int | float) and isinstance(end, int | float) and end <= start:
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
        for index, limits in enumerate(cast("TimeSpan", block).limits or ()):
            place = where.inside("limits", index)
            yield from _disordered(limits, place)
            if isinstance(limits.since, int | float):
                if limits.since <= before:
                    message = f"this line holds from {limits.since!r} on, the one above it from {before!r}: sort them"
                    yield Problem(TIM002, message, where=place.inside("since"))
                before = limits.since


def _disordered(limits: StepLimits, where: Where) -> Iterator[Problem]:
    suggested, least, largest = limits.suggested, limits.least, limits.largest
    known = all(isinstance(value, int | float) and not is_unknown(value) for value in (suggested, least, largest))
    if known and not cast("float", least) <= cast("float", suggested) <= cast("float", largest):
        message = (
            f"the suggested step {suggested!r} does not lie between the least {least!r} and the largest {largest!r}: "
            "correct them"
        )
        yield Problem(TIM002, message, where=where.inside("suggested"))


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
            message = "this load case has a *DATABASE above: remove one of them"
            yield Problem(TIM006, message, where=where)
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
    for where, block in context.blocks("DRIFT", "LOAD CASE"):
        for index, drift in enumerate(cast("Drift", block).drifts):
            if not drift.vessel or not drift.type_:
                continue
            kind = kinds.setdefault(name_key(drift.vessel), drift.type_)
            if kind != drift.type_:
                message = f"vessel {shown(drift.vessel)} has a drift of TYPE={kind} above: give it one kind"
                yield Problem(VES001, message, where=where.inside("drifts", index, "type"))
