"""Backbone curve of a published model as a block of a deck, with its source, error and range in comments."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from mudline.basics.arguments import expect, expect_number, expect_word
from mudline.basics.quantities import shown
from mudline.language.deck.loading import load_bytes
from mudline.language.keywords.fields import Comment
from mudline.language.keywords.library.seabed_curves import Embedment, SeabedStiffness
from mudline.language.keywords.writer import block_lines
from mudline.model.curves import CurveError, ForceCurve
from mudline.model.curves.backbones import MODELS, Backbone, Soil

if TYPE_CHECKING:
    from mudline.model.curves import FloatArray

FINEST, COARSEST = 1e-5, 0.1
"""Smallest and largest tolerance."""


class BackboneCurve(NamedTuple):
    """A `curve` of a published model, and the `block` of a deck that contains it."""

    curve: ForceCurve
    block: SeabedStiffness | Embedment


def backbone(  # noqa: PLR0913 - as many as the command has options
    model: str,
    *,
    diameter: float,
    strength: float | tuple[float, float],
    weight: float = 0.0,
    depth: float | None = None,
    tolerance: float = 0.005,
    first: float = 0.001,
    name: str | None = None,
    legacy: bool = False,
    extend: bool = False,
) -> BackboneCurve:
    """Return the penetration resistance of a published model as a curve of few points, all in one system of units.

    Args:
        model: f114, skempton, aubeny, aubeny-rough, merifield, merifield-rough or randolph-quiggin.
        diameter: external diameter of the pipe.
        strength: undrained shear strength at the mudline, or a pair of it and its increase with depth.
        weight: submerged unit weight of the soil.
        depth: largest ratio z/D; the limit of the publication if None.
        tolerance: largest error of the interpolation, as a share of the largest force.
        first: smallest ratio of a point above 0; below it a straight line replaces the model.
        name: name of the curve, or of the set if `legacy`; that of the model if None.
        legacy: make a block of `*EMBEDMENT`, not of `*SEABED STIFFNESS`.
        extend: accept a `depth` beyond the ratios for which the model is published.

    Raises ValueError for an argument outside the model's range; the message begins with the name of the argument.
    """
    expect_word(model, "model", MODELS)
    for word, flag in (("legacy", legacy), ("extend", extend)):
        expect(flag, word, bool, "True or False")
    chosen = MODELS[model]
    su0, gradient = strength if isinstance(strength, tuple) and len(strength) == 2 else (strength, 0.0)
    far = chosen.published if depth is None else depth
    for word, value in (("diameter", diameter), ("strength", su0), ("depth", far), ("tolerance", tolerance)):
        expect_number(value, word)
    for word, value in (("strength", gradient), ("weight", weight), ("first", first)):
        expect_number(value, word, or_zero=True)
    if weight and not chosen.weighs:
        raise ValueError(f"weight: the model {model} has no term of the soil's weight: leave it out")
    if far > chosen.published and not extend:
        raise ValueError(f"depth: {model} ends at z/D = {shown(chosen.published)}; extend=True goes on to {far:g}")
    if first >= far:
        raise ValueError(f"first must be a ratio z/D below {shown(far)}, not {first!r}")
    if not FINEST <= tolerance <= COARSEST:
        raise ValueError(f"tolerance must be from 1e-5 to {COARSEST:g}, not {tolerance!r}")
    title = name if name is not None else model
    expect(title, "name", str, "a str")
    model_curve = Backbone(chosen, Soil(diameter, su0, gradient, weight))
    with np.errstate(all="ignore"):
        if not 0.0 < model_curve.largest(far) < math.inf:
            raise ValueError("strength: the force is too large or too small for a float64: check the units")
        try:
            points = model_curve.points(far, tolerance, first)
            curve = ForceCurve(points, title)
        except OverflowError as error:
            raise ValueError(f"tolerance: {error}: check the units, depth and tolerance") from error
        except CurveError as error:
            raise ValueError(f"tolerance {tolerance:g} is too fine for this model: {error}") from error
        comments = [Comment(text=f" {line}", before=0) for line in _head(model_curve, points, far, tolerance, first)]
    fields = {"curves": [{"set" if legacy else "name": title, "points": points}], "comments": comments}
    block = (Embedment if legacy else SeabedStiffness).model_validate(fields)
    # Only the reader knows which names are valid.
    text = "\n".join(["$MODEL", *block_lines(block), ""])
    if load_bytes(text.encode(errors="replace"), "").sections[0].blocks != [block]:
        raise ValueError(f"name {title!r} is not what a deck reads as a name: give letters and digits")
    return BackboneCurve(curve, block)


def _head(backbone: Backbone, points: FloatArray, depth: float, tolerance: float, first: float) -> list[str]:
    """Return source, parameters, error and range as lines of comments."""
    model, soil = backbone.model, backbone.soil
    largest, bound = backbone.largest(depth), 100.0 * tolerance
    steep = backbone.deviation(points[:2]) > tolerance * largest
    error = 100.0 * backbone.deviation(points[1:] if steep else points) / largest
    below = f"; below z/D = {shown(first)} {100.0 * backbone.deviation(points[:2]) / largest:.2g} %" if steep else ""
    weight = f", submerged weight of soil w {shown(soil.weight)}" if model.weighs else ""
    beyond = "; the last points are beyond it" if depth > model.published else ""
    return [
        model.title,
        f"Force per unit length: {model.formula}, r = z/D",
        f"D {shown(soil.diameter)}, s_u {shown(soil.strength)} + {shown(soil.gradient)} z{weight}",
        f"Error of interpolation: {error:.2g} % of the largest force {shown(largest)}, bound {bound:g} %{below}",
        f"Published for z/D from 0 to {shown(model.published)}: {model.range_note}{beyond}",
        "Ratios are z/D: penetration of the invert",
    ]
