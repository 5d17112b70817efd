"""Stiffnesses that lie too far apart."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from mudline.contact.input import LawKind
from mudline.diagnostics import Code, Problem, Severity
from mudline.keywords.text import shown
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.scene.context import MOST_REPORTED
from mudline.scene.force_curves import SceneCurve
from mudline.scene.model import Scene
from mudline.scene.numbering import Floats, Indices

STB003 = Code("STB003", "stiff-jump", Severity.WARNING)

FARTHEST = 1.0e4


@rule(STB003)
def stiff_jump(context: LintContext) -> Iterator[Problem]:
    """The stiffness of the seabed jumps by a factor of more than 10 000.

    It does so where two segments of a curve meet, flat ones left out, or where an element on a curve has a neighbour on
    a linear bed that is so much stiffer, or softer, than every segment. The solver loses digits over such a jump, and
    the pipe bends over the edge as over a knife. Mostly an exponent is wrong. Correct the point or the stiffness; real
    rock beside mud needs a transition.

    Example:
         $MODEL
         *SEABED STIFFNESS
          CURVE=Clay over Rock
          0.0, 0.0
        - 0.1, 5.0
        - 0.2, 2.0E6
        - 0.3, 4.0E6
        + 0.1, 5.0E2
        + 0.2, 2.0E4
        + 0.3, 4.0E4
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=Clay over Rock

    Finds: 5:2
    """
    for _, entry in context.odd_curves:
        if entry.curve is not None and entry.whole:
            yield from _inside(entry, entry.curve.ratios, entry.curve.slopes)
    yield from _beside(context.scene)


def _inside(entry: SceneCurve, ratios: Floats, slopes: Floats) -> Iterator[Problem]:
    """Jumps at points of a curve."""
    steep = np.flatnonzero(slopes)
    before, behind = np.abs(slopes[steep[:-1]]), np.abs(slopes[steep[1:]])
    jumps = np.flatnonzero((before / FARTHEST > behind) | (behind / FARTHEST > before))
    for at in jumps[:MOST_REPORTED].tolist():
        point = int(np.flatnonzero(entry.points[:, 0] == ratios[steep[at + 1]])[0])
        message = (
            f"the slope goes from {before[at]:.6g} to {behind[at]:.6g} here, over {FARTHEST:g} times: correct the "
            "point, or put a transition between"
        )
        yield Problem(STB003, message, where=entry.point(point))


def _beside(scene: Scene) -> Iterator[Problem]:
    """Jumps between an element on a curve and its neighbour on a linear bed, one for each pair of laws."""
    grants = scene.laws.set_laws
    told: set[tuple[int, int]] = set()
    slopes = [*map(_extremes, scene.laws.curves), (math.nan, math.nan)]
    if _near(scene, slopes):
        return
    linear, curved = _neighbours(scene)
    extremes = np.array(slopes)
    curve_of = np.array([*(grant.curve for grant in grants), -1], dtype=np.intp)
    stiffness = np.array([*(grant.stiffness for grant in grants), np.nan])[scene.laws.of_element[linear]]
    with np.errstate(all="ignore"):
        softest, steepest = (extremes[curve_of[scene.laws.of_element[curved]]] / scene.diameter[curved][:, None]).T
        far = (stiffness / FARTHEST > steepest) | ((stiffness > 0.0) & (softest / FARTHEST > stiffness))
    for at in np.flatnonzero(far).tolist():
        pair = (int(scene.laws.of_element[linear[at]]), int(scene.laws.of_element[curved[at]]))
        if pair in told or len(told) >= MOST_REPORTED:
            continue
        told.add(pair)
        message = (
            f"the linear stiffness {stiffness[at]:.6g} of element {scene.element_ids[linear[at]]} is over "
            f"{FARTHEST:g} times away from that of curve {shown(scene.laws.curves[curve_of[pair[1]]].name)} at its "
            f"neighbour {scene.element_ids[curved[at]]}, {softest[at]:.6g} to {steepest[at]:.6g}: correct it, or put a "
            "transition between"
        )
        yield Problem(STB003, message, where=grants[pair[0]].where)


def _near(scene: Scene, extremes: Sequence[tuple[float, float]]) -> bool:
    """Whether no linear stiffness is far from the slopes of any curve, on whatever diameter it stands."""
    linear = [grant.stiffness for grant in scene.laws.set_laws if grant.stiffness > 0.0]
    slopes = [(softest, steepest) for softest, steepest in extremes if softest > 0.0]
    thickest = float(np.fmax.reduce(scene.diameter, initial=0.0))
    if not linear or not slopes or thickest == 0.0:
        return True
    thinnest = float(np.fmin.reduce(scene.diameter, initial=math.inf))
    too_stiff = max(linear) / FARTHEST > min(steepest for _, steepest in slopes) / thickest
    too_soft = max(softest for softest, _ in slopes) / thinnest / FARTHEST > min(linear)
    return not too_stiff and not too_soft


def _extremes(entry: SceneCurve) -> tuple[float, float]:
    """The smallest and the largest slope of a curve, flat segments left out; NaN without any."""
    slopes = np.abs(entry.curve.slopes) if entry.curve is not None and entry.whole else np.zeros(0)
    slopes = slopes[slopes > 0.0]
    return (float(slopes.min()), float(slopes.max())) if slopes.size else (math.nan, math.nan)


def _neighbours(scene: Scene) -> tuple[Indices, Indices]:
    """Pairs of elements that meet at a node: one on a linear bed, one on a curve."""
    law = scene.law
    if not ((law == LawKind.LINEAR).any() and (law == LawKind.CURVE).any()):
        nothing: Indices = np.zeros(0, dtype=np.intp)
        return nothing, nothing
    nodes = scene.element_nodes.ravel()
    order = np.argsort(nodes, kind="stable")
    elements, at = order // 2, nodes[order]
    meet = (at[1:] == at[:-1]) & (at[1:] >= 0)
    one, other = elements[:-1][meet], elements[1:][meet]
    one, other = np.append(one, other), np.append(other, one)
    wanted = (law[one] == LawKind.LINEAR) & (law[other] == LawKind.CURVE)
    return one[wanted], other[wanted]
