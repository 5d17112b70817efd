"""Suction: cut-offs, what a law needs, and two laws on one element."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mudline.diagnostics import Code, Problem, Severity
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.scene.model import Scene
from mudline.scene.numbering import Mask

EXT004 = Code("EXT004", "bad-cutoff", Severity.ERROR)
EXT005 = Code("EXT005", "suction-incomplete", Severity.ERROR)
EXT006 = Code("EXT006", "suction-conflict", Severity.ERROR)

_KEYWORD = "SEABED SUCTION"
_LOWEST, _HIGHEST = 0.01, 0.99


@rule(EXT004)
def bad_cutoff(context: LintContext) -> Iterator[Problem]:
    """The corners of the suction trapezoid are out of order or out of range.

    Suction rises up to the first corner, holds, and falls from the second one to breakout: both are fractions of the
    suction depth, 0.01 <= first <= second <= 0.99, so that rise and fall have a finite slope. Correct them.

    Bad:
        $MODEL
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=50000.0
        *SEABED SUCTION
         SET=ALL
         COHESION=5000.0
         CUTOFF=0.8, 0.2

    Good:
        $MODEL
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=50000.0
        *SEABED SUCTION
         SET=ALL
         COHESION=5000.0
         CUTOFF=0.2, 0.8

    Finds: 9:2
    """
    extension = context.scene.extensions.get(_KEYWORD)
    for entry, where in zip(extension.entries, extension.places, strict=True) if extension else ():
        cutoff = getattr(entry, "cutoff", None)
        corners = [getattr(cutoff, name, None) for name in ("first", "second")]
        known = [float(corner) for corner in corners if isinstance(corner, float | int) and np.isfinite(corner)]
        if any(not _LOWEST <= corner <= _HIGHEST for corner in known) or known != sorted(known):
            message = f"corners {', '.join(map(repr, known))}: they must be 0.01 <= first <= second <= 0.99"
            yield Problem(EXT004, message, where=where._replace(path=(*where.path, "cutoff")))


@rule(EXT005)
def suction_incomplete(context: LintContext) -> Iterator[Problem]:
    """A suction law lacks a value that it needs.

    COHESION= gives both the largest force and the suction depth; without it FORCE= and DEPTH= must both stand. The
    relation between cohesion and depth is not dimensionally homogeneous, and the default of REGULARISATION= is in m/s:
    with user units neither can be converted. Give what is missing.

    Bad:
        $MODEL
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=50000.0
        *SEABED SUCTION
         SET=ALL
         FORCE=3500.0, 0.18

    Good:
        $MODEL
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=50000.0
        *SEABED SUCTION
         SET=ALL
         FORCE=3500.0, 0.18
         DEPTH=0.3, 0.26

    Finds: 7:6
    """
    extension = context.scene.extensions.get(_KEYWORD)
    user = context.scene.units == "user"
    for entry, where in zip(extension.entries, extension.places, strict=True) if extension else ():
        lacks = {key for key in ("cohesion", "force", "depth", "regularisation") if getattr(entry, key, None) is None}
        title = where._replace(path=(*where.path, "set"))
        whole = not context.scene.context.disturbed(where)
        if "cohesion" in lacks and lacks & {"force", "depth"} and whole:
            missing = " and ".join(f"{key.upper()}=" for key in ("force", "depth") if key in lacks)
            yield Problem(EXT005, f"the suction law is incomplete: give COHESION=, or {missing}", where=title)
        if user and "cohesion" not in lacks:
            message = "COHESION= needs metric or imperial units, and the deck has user units: give FORCE= and DEPTH="
            yield Problem(EXT005, message, where=where._replace(path=(*where.path, "cohesion")))
        if user and "regularisation" in lacks and whole:
            message = "REGULARISATION= is missing: with user units it has no default; give it"
            yield Problem(EXT005, message, where=title)


@rule(EXT006)
def suction_conflict(context: LintContext) -> Iterator[Problem]:
    """Elements have two suction laws.

    *SEABED SUCTION describes the whole uplift resistance of an element. SUCTION= of *SEABED PROPERTIES, or a curve that
    is negative below the mudline and so pulls, would hold the pipe a second time. Remove one of them. A curve that
    pulls is a warning: with `--tension cut` its pull is left out, and there is one law only.

    Bad:
        $MODEL
        *NODE
         1, -0.05, 0.0
         5, -0.05, 40.0
         GEN=1, 5
        *ELEMENT
         1, 1, 2
         GEN=1, 4
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=50000.0
         SUCTION=8000.0, 0.15
        *SEABED SUCTION
         SET=ALL
         COHESION=5000.0

    Good:
        $MODEL
        *NODE
         1, -0.05, 0.0
         5, -0.05, 40.0
         GEN=1, 5
        *ELEMENT
         1, 1, 2
         GEN=1, 4
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=50000.0
        *SEABED SUCTION
         SET=ALL
         COHESION=5000.0

    Finds: 15:6
    """
    scene = context.scene
    extension = scene.extensions.get(_KEYWORD)
    if extension is None:
        return
    suction, pulled = scene.bed.column("suction") > 0.0, _pulled(context)
    for index, where in enumerate(extension.places):
        place = where._replace(path=(*where.path, "set"))
        held = extension.of_element == index
        if np.any(both := held & suction):
            message = f"{_counted(scene, both)} SUCTION= of the seabed too: remove one of the two"
            yield Problem(EXT006, message, where=place)
        if np.any(both := held & pulled):
            message = (
                f"{_counted(scene, both)} a curve that pulls too: remove one of the two, unless the curve is evaluated "
                "with --tension cut"
            )
            yield Problem(EXT006, message, None, Severity.WARNING, place)


def _counted(scene: Scene, elements: Mask) -> str:
    found = scene.element_ids[elements]
    return f"element {found[0]} has" if found.size == 1 else f"{found.size} elements (first: {found[0]}) have"


def _pulled(context: LintContext) -> Mask:
    """Elements whose curve is negative somewhere below the mudline; a stiffness of the nodes replaces the curve."""
    scene = context.scene
    pulls = [False] * (len(scene.laws.curves) + 1)
    for index, entry in enumerate(scene.laws.curves):
        if entry.curve is not None:
            ratios = entry.points[:, 0]
            force = entry.curve.evaluate(np.append(ratios[ratios > 0.0], 0.0))[0]
            pulls[index] = bool((force < 0.0).any())
    curves = [*(grant.curve for grant in scene.laws.grants), -1]
    found: Mask = np.array([pulls[curve] for curve in curves])[scene.laws.of_element]
    return found & ~scene.nodal
