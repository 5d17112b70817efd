"""Friction: the standard wants every coefficient written, so that nobody relies on a default."""

from __future__ import annotations

from collections.abc import Iterator

from mudline.plugins import Code, LintContext, Problem, Severity, rule

ACM001 = Code("ACM001", "friction-not-given", Severity.WARNING)


@rule(ACM001)
def friction_not_given(context: LintContext) -> Iterator[Problem]:
    """A set of *SEABED PROPERTIES has no friction coefficients.

    Without FRICTION= there is no friction, which is seldom meant. The company standard wants both coefficients
    written for every set; write zeros where there is none.

    Example:
         $MODEL
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=50000.0
        + FRICTION=0.3, 0.6

    Finds: 4:2
    """
    for where, block in context.scene.deck.blocks("SEABED PROPERTIES"):
        for index, entry in enumerate(getattr(block, "sets", ())):
            friction = entry.friction
            if friction is None or friction.longitudinal is None or friction.transverse is None:
                name = entry.set_name or "ALL"
                message = f"the friction coefficients of set {name} are not given: write FRICTION= with both of them"
                yield Problem(ACM001, message, where=where._replace(path=("sets", index)))
