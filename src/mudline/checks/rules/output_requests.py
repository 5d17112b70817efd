"""Results that a deck requests: names of output variables."""

from __future__ import annotations

from collections.abc import Iterator

from mudline.basics.spelling import Effort, nearest
from mudline.checks.context import LintContext
from mudline.language.diagnostics import Code, Problem, Severity, Span, Where
from mudline.language.keywords.text import shown
from mudline.language.keywords.values import Names
from mudline.language.rules import rule
from mudline.language.syntax.fields import read_line
from mudline.model.scene.references import used_names
from mudline.model.scene.unread_lines import unread_lines

REF021 = Code("REF021", "misspelt-output", Severity.WARNING)

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
    requests = [(where, name) for where, name in used_names(context.deck, Names.VARIABLE) if where.section < own]
    for where, name in [*requests, *_of_kept_lines(context)]:
        words = name.upper().replace("-", " ").split()
        for word in words:
            near = nearest(word, WORDS, effort) if word not in WORDS and len(word) >= _SHORTEST else ""
            if near and word not in (f"{near}S", f"{near}ES"):
                message = f"output {shown(name)}: {shown(word)} is no usual word (did you mean {near}?)"
                yield Problem(REF021, f"{message}: correct it, else the run gives no such output", where=where)


def _of_kept_lines(context: LintContext) -> Iterator[tuple[Where, str]]:
    """Yield the texts at the start of unread postprocessing lines that begin without a setting."""
    for where, _, line in unread_lines(context.scene.context):
        if context.deck.sections[where.section].name.endswith(_REQUESTS):
            first = read_line(line, Span(0, len(line))).groups[0]
            if not first.key and first.fields[0].text[:1].isalpha():
                yield where.inside(*first.fields[0].span), first.fields[0].text
