"""Rigid or elastic: one type of seabed in a model, and what needs an elastic one."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, cast

from mudline.codes import SBD001, SBD002, SBD004, SBD005
from mudline.diagnostics import Code, Problem, Severity, Where
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.scene.laws import typed_blocks

if TYPE_CHECKING:
    from mudline.keywords.library.embedment import Embedment

SBD003 = Code("SBD003", "missing-type", Severity.ERROR)


@rule(SBD001)
def rigid_with_curve(context: LintContext) -> Iterator[Problem]:
    """A rigid seabed has a force-embedment curve, or a value that only an elastic one has.

    Nothing sinks into a rigid seabed, so a curve cannot hold there: it is an error, as one of the two is not what was
    meant. STIFFNESS= with a number, LATERAL= and SUCTION= count for nothing and are a warning. Choose TYPE=ELASTIC, or
    remove the line.

    Bad:
        $MODEL
        *SEABED STIFFNESS
         CURVE=Clay
         0.0, 0.0
         0.5, 4200.0
        *SEABED PROPERTIES
         TYPE=RIGID
         SET=ALL
         STIFFNESS=Clay

    Good:
        $MODEL
        *SEABED STIFFNESS
         CURVE=Clay
         0.0, 0.0
         0.5, 4200.0
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=Clay

    Finds: 9:12
    """
    yield from context.told(SBD001)


@rule(SBD002)
def two_seabed_types(context: LintContext) -> Iterator[Problem]:
    """The model has a rigid and an elastic seabed.

    A model has one of them for all its elements, whether it says so with TYPE= or with *RIGID SURFACE and *ELASTIC
    SURFACE. A block pasted from another deck is the usual cause. Remove one of them; a hard place in an elastic seabed
    takes a high stiffness instead.

    Bad:
        $MODEL
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=50000.0
        *SEABED PROPERTIES
         TYPE=RIGID
         SET=ALL

    Good:
        $MODEL
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=50000.0

    Finds: 7:7
    """
    yield from context.told(SBD002)


@rule(SBD003)
def missing_type(context: LintContext) -> Iterator[Problem]:
    """*SEABED PROPERTIES does not say whether the seabed is rigid or elastic.

    The type has no default: write TYPE=RIGID or TYPE=ELASTIC on the first line. A later block without TYPE= goes on
    with the type of the one before it. A SET= that is missing at the beginning is a warning: the lines before the first
    SET= are read as SET=ALL (inferred), and so are the points of *EMBEDMENT before its first SET=.

    Bad:
        $MODEL
        *SEABED PROPERTIES
         SET=ALL
         STIFFNESS=50000.0

    Good:
        $MODEL
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=50000.0

    Finds: 2:1
    """
    resolving = context.scene.context
    told = False
    for where, properties, type_ in typed_blocks(resolving):
        if type_ is None and not told and not resolving.disturbed(where):
            told = True
            yield Problem(
                SBD003, "the type is missing: write TYPE=RIGID or TYPE=ELASTIC as the first line", where=where
            )
        for index, entry in enumerate(properties.sets[:1]):
            yield from _without_set(context, entry.set_name, where._replace(path=("sets", index)), "lines")
    for where, block in context.scene.deck.blocks("EMBEDMENT"):
        for index, curve in enumerate(cast("Embedment", block).curves[:1]):
            yield from _without_set(context, curve.set_name, where._replace(path=("curves", index)), "points")


def _without_set(context: LintContext, name: str | None, where: Where, what: str) -> Iterator[Problem]:
    if name is None and not context.scene.context.lacks_value(where, "set"):
        message = f"{what} before any SET= are read as those of SET=ALL (inferred): write SET= before them"
        yield Problem(SBD003, message, None, Severity.WARNING, where)


@rule(SBD004)
def missing_embedment(context: LintContext) -> Iterator[Problem]:
    """*ELASTIC SURFACE gives no stiffness, and there is no *EMBEDMENT.

    The first field of *ELASTIC SURFACE may be empty only when curves of *EMBEDMENT carry the elements. Otherwise
    nothing holds them vertically, and a static run has no solution. Give a stiffness, here or with the newer keywords.

    Bad:
        $MODEL
        *ELASTIC SURFACE
         , 0.3, 0.6

    Good:
        $MODEL
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=50000.0
         FRICTION=0.3, 0.6

    Finds: 2:1
    """
    yield from context.told(SBD004)


@rule(SBD005)
def embedment_needs_elastic(context: LintContext) -> Iterator[Problem]:
    """*EMBEDMENT stands beside a rigid seabed, or beside none.

    A force-embedment curve describes how far a pipe sinks, so it holds only on an elastic seabed: *ELASTIC SURFACE, or
    *SEABED PROPERTIES with TYPE=ELASTIC. Choose the elastic seabed, or remove the curves.

    Bad:
        $MODEL
        *RIGID SURFACE
         0.3, 0.6
        *EMBEDMENT
         SET=ALL
         0.0, 0.0
         0.5, 4200.0

    Good:
        $MODEL
        *SEABED STIFFNESS
         CURVE=Clay
         0.0, 0.0
         0.5, 4200.0
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=Clay
         FRICTION=0.3, 0.6

    Finds: 5:2
    """
    yield from context.told(SBD005)
