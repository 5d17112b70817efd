"""`LATERAL=` of `*SEABED FRICTION`: a breakout and a residual."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.language.diagnostics import Code, Problem, Severity, Where
from mudline.language.keywords.unknown import is_partly_unknown
from mudline.language.rules import rule
from mudline.model.scene.deck_values import number
from mudline.model.scene.rules.laws import lacks_diameter

if TYPE_CHECKING:
    from mudline.language.keywords.library.seabed_lateral import FrictionSet
    from mudline.model.scene.resolved import ResolvedDeck

EXT013 = Code("EXT013", "bad-breakout", Severity.ERROR)


@rule(EXT013, blocks=True)
def bad_breakout(scene: ResolvedDeck) -> Iterator[Problem]:
    """The lateral breakout of *SEABED FRICTION is incomplete, impossible, or beside a law that it excludes.

    LATERAL=PEAK-RESIDUAL needs PEAK= and RESIDUAL= with a factor and a displacement each; the residual is at most the
    peak and is reached behind it. LATERAL=F114 needs the factor of PEAK= alone, and a diameter: the rest follows from
    the embedment. Both are a limit of their own across the line: CRITERION=ELLIPSE, and *SEABED TRENCH on the same
    element, have no place beside it. PEAK= or RESIDUAL= without them has no effect and is a warning.

    Example on seabed:
          STIFFNESS=50000.0
        |*SEABED FRICTION
        | SET=ALL
        | COEFFICIENTS=0.3, 0.6
        | STIFFNESS=20000.0
        | LATERAL=PEAK-RESIDUAL
        | PEAK=1.2, 0.03
        - RESIDUAL=1.3, 0.3
        + RESIDUAL=1.2, 0.3

    Finds: 12:2
    """
    extension = scene.extensions.get("SEABED FRICTION")
    if extension is None:
        return
    from mudline.model.scene.assignments import breaks_out  # noqa: PLC0415 - most decks have no such friction

    trench = scene.extensions.get("SEABED TRENCH")
    for index, (entry, where) in enumerate(zip(extension.entries, extension.places, strict=True)):
        given = cast("FrictionSet", entry)
        held = extension.of_element == index
        if not breaks_out(given):
            for name in ("peak", "residual"):
                if getattr(given, name) is not None:
                    message = (
                        f"{name.upper()}= has no effect under LATERAL=COULOMB: write LATERAL=PEAK-RESIDUAL or F114"
                    )
                    yield Problem(EXT013, message, None, Severity.WARNING, where.inside(name))
            continue
        yield from () if is_partly_unknown(given) else _of_block(given, where)
        if given.criterion == "ELLIPSE":
            yield Problem(
                EXT013,
                "a breakout across the line has no ellipse: write CRITERION=BOX",
                where=where.inside("criterion"),
            )
        if trench is not None and np.any(both := held & (trench.of_element >= 0)):
            message = (
                f"{scene.describe(both)} a trench too, whose resistance a breakout excludes: remove one of the two"
            )
            yield Problem(EXT013, message, where=where.inside("lateral"))
        bare = held & np.isnan(scene.diameter)
        if given.lateral == "F114" and bare.any():
            message = (
                f"{scene.describe(bare)} no external diameter for LATERAL=F114: give Do (or Dd) in *GEOMETRIC SETS"
            )
            yield lacks_diameter(scene, EXT013, message, where.inside("lateral"))


def _of_block(given: FrictionSet, where: Where) -> Iterator[Problem]:
    """What a block lacks, or has too much of."""
    (peak, at), (residual, end) = (
        (number(part, "factor"), number(part, "displacement")) for part in (given.peak, given.residual)
    )
    if given.lateral == "F114":
        if np.isnan(peak):
            yield Problem(
                EXT013, "LATERAL=F114 needs the factor at breakout: give PEAK=", where=where.inside("lateral")
            )
        if given.residual is not None or not np.isnan(at):
            name = "peak" if given.residual is None else "residual"
            message = f"LATERAL=F114 has displacements and a residual of its own: remove those of {name.upper()}="
            yield Problem(EXT013, message, where=where.inside(name))
    elif np.isnan([peak, at, residual, end]).any():
        message = "LATERAL=PEAK-RESIDUAL needs PEAK= and RESIDUAL=, a factor and a displacement each"
        yield Problem(EXT013, message, where=where.inside("lateral"))
    elif residual > peak or end <= at:
        what = (
            f"is above that of the peak, {peak!r}" if residual > peak else f"is reached no later than the peak, {at!r}"
        )
        yield Problem(EXT013, f"the residual {what}: correct one of the two", where=where.inside("residual"))
