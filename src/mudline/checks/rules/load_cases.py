"""Load cases: the kind of run, its times, vessels and waves in it, and the results that are requested from it."""

from __future__ import annotations

import math
from collections.abc import Iterator

from mudline.basics.spelling import Effort, nearest
from mudline.checks.context import LintContext, records_of
from mudline.checks.rules.hydrodynamics import by_height, spans
from mudline.checks.rules.references import in_water
from mudline.language.deck.parameters import name_key
from mudline.language.diagnostics import Code, Problem, Severity, Span, Where
from mudline.language.keywords import catalogue
from mudline.language.keywords.contents import names_given
from mudline.language.keywords.text import shown
from mudline.language.keywords.values import Names
from mudline.language.rules import rule
from mudline.language.syntax.fields import read_line
from mudline.model.scene.deck_values import number

VES002 = Code("VES002", "vessel-without-rao", Severity.WARNING)
TIM005 = Code("TIM005", "static-steps-without-effect", Severity.INFO)
TIM001 = Code("TIM001", "end-not-after-start", Severity.ERROR)
TIM002 = Code("TIM002", "step-limits-out-of-order", Severity.ERROR)
WAV001 = Code("WAV001", "airy-period-without-amplitude", Severity.ERROR)
VES001 = Code("VES001", "two-kinds-of-drift", Severity.ERROR)
TIM006 = Code("TIM006", "storage-given-twice", Severity.ERROR)
TIM007 = Code("TIM007", "stored-after-the-end", Severity.WARNING)
REF021 = Code("REF021", "misspelt-output", Severity.WARNING)


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
        for where, vessel in records_of(context.blocks(keyword), "vessels"):
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


# ---------------------------------------------------------------------------------------------------- waves and vessels


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
    for where, drift in records_of(context.blocks("DRIFT", "LOAD CASE"), "drifts"):
        if not drift.vessel or not drift.type_:
            continue
        kind = kinds.setdefault(name_key(drift.vessel), drift.type_)
        if kind != drift.type_:
            message = f"vessel {shown(drift.vessel)} has a drift of TYPE={kind} above: give it one kind"
            yield Problem(VES001, message, where=where.inside("type"))


# ---------------------------------------------------------------------------------------------------- requested results

WORDS = (
    *("EFFECTIVE", "TENSION", "AXIAL", "FORCE", "LOCAL", "SHEAR", "BENDING", "MOMENT", "TORQUE", "CURVATURE"),
    *("RESULTANT", "STRESS", "STRAIN", "MISES", "REACTION", "MOTION", "DISPLACEMENT", "VELOCITY", "ACCELERATION"),
)
"""Words in the names of outputs, from the manual's page on the database of forces; the list is not complete."""
_REQUESTS = "POSTPROCESSING"
_SHORTEST = 4
"""Number of letters from which a word is compared."""


@rule(REF021)
def misspelt_output(context: LintContext) -> Iterator[Problem]:
    """The name of an output variable has a word that is nearly one of the usual words.

    Results are requested by name, such as EFFECTIVE TENSION. With one wrong letter the run ends without them, and hours
    are lost. Correct the word. Other words are not reported, as not every variable is known.

    Example:
         $SUMMARY POSTPROCESSING
         *PARA FORCE
          DATA1=12
          DATA2=1
        - DATA3=EFFECTIVE TENSON
        + DATA3=EFFECTIVE TENSION

    Finds: 5:8
    """
    if not any(section.name.endswith(_REQUESTS) for section in context.deck.own_sections):
        return
    effort = Effort()
    own = len(context.deck.own_sections)
    used = context.scene.context.names[Names.VARIABLE].used
    requests = [(use.where, use.name) for use in used if use.where.section < own]
    for where, name in [*requests, *_of_kept_lines(context)]:
        words = name.upper().replace("-", " ").split()
        for word in words:
            near = nearest(word, WORDS, effort) if word not in WORDS and len(word) >= _SHORTEST else ""
            if near and word not in (f"{near}S", f"{near}ES"):
                message = f"output {shown(name)}: {shown(word)} is no usual word (did you mean {near}?)"
                yield Problem(REF021, f"{message}: correct it, else the run gives no such output", where=where)


def _of_kept_lines(context: LintContext) -> Iterator[tuple[Where, str]]:
    """Yield the texts at the start of unread postprocessing lines that begin without a setting."""
    for where, _, line in context.scene.context.unread_lines:
        if context.deck.sections[where.section].name.endswith(_REQUESTS):
            first = read_line(line, Span(0, len(line))).groups[0]
            if not first.key and first.fields[0].text[:1].isalpha():
                yield where.inside(*first.fields[0].span), first.fields[0].text
