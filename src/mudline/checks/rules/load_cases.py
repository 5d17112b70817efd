"""Missing sections, and keywords of a load case that lack what a run needs, or have no effect in it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, cast

from mudline.checks.context import LintContext
from mudline.checks.rules.references import in_water
from mudline.language.deck.parameters import name_key
from mudline.language.diagnostics import Code, Problem, Severity
from mudline.language.keywords import catalogue
from mudline.language.keywords.naming import names_given
from mudline.language.keywords.text import shown
from mudline.language.keywords.values import Names
from mudline.language.rules import rule

if TYPE_CHECKING:
    from mudline.language.keywords.library.analysis import AnalysisType
    from mudline.language.keywords.library.vessels import IntegratedVessels, Vessels

SYN019 = Code("SYN019", "no-section", Severity.ERROR)
VES002 = Code("VES002", "vessel-without-rao", Severity.WARNING)
TIM005 = Code("TIM005", "static-steps-without-effect", Severity.INFO)

_DYNAMIC = ("DYNAMIC", "TIME DOMAIN", "FREQUENCY DOMAIN")
_FREQUENCY = "FREQUENCY"


def _analysis(context: LintContext) -> set[str]:
    """Return the kinds of run that the deck names."""
    blocks = context.blocks("ANALYSIS TYPE", "LOAD CASE")
    return {str(cast("AnalysisType", block).type_).upper() for _, block in blocks if block.type_}


@rule(SYN019)
def no_section(context: LintContext) -> Iterator[Problem]:
    """The file has no section, so it is not a deck.

    An empty file is left by an interrupted copy or a full disk. A file of comments or text alone is a title whose deck
    is missing. Fetch the file again, or take it out of the folder of decks.

    Example:
         C Export riser, rev C
        +$MODEL
        +*OCEAN
        + 500.0, 1025.0, 9.81

    Finds: 1:1
    """
    deck = context.deck
    if deck.sections or any(problem.weight is Severity.ERROR for problem in deck.problems):
        return
    has = "has no $SECTION" if deck.comments or any(map(str.strip, deck.preamble)) else "is empty"
    yield Problem(SYN019, f"the file {has}: choose the file of a deck, or fetch it again")


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
    if not waves or not _analysis(context) & {*_DYNAMIC}:
        return
    moving = context.scene.deck.blocks_with("moves_vessels", "LOAD CASE")
    moved = {name_key(name) for _, block in moving for _, name in names_given(block, Names.VESSEL)}
    for keyword in catalogue.definers(Names.VESSEL):
        for where, block in context.blocks(keyword):
            for index, vessel in enumerate(cast("Vessels | IntegratedVessels", block).vessels):
                place = where.inside("vessels", index)
                name = str(getattr(vessel, "vessel", None) or "")
                still = name and name_key(name) not in moved and not getattr(vessel, "rao", None)
                if still and not getattr(vessel, "unread", None):
                    message = (
                        f"vessel {shown(name)} has no RAO and stands still in the waves: give RAO= in "
                        "*VESSEL,INTEGRATED, or the operators in *RAO"
                    )
                    yield Problem(VES002, message, where=place.inside("vessel"))


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
    if not kinds or any(kind.startswith(_FREQUENCY) for kind in kinds):
        return
    for where, _ in context.written("NON LINEAR STATIC", "LOAD CASE"):
        message = f"no effect: the run is {min(kinds).lower()}, not in the frequency domain; remove *NON LINEAR STATIC"
        yield Problem(TIM005, message, where=where)
