"""`mudline backbone`: a force-embedment curve of a published model, as lines for a deck."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import click
import numpy as np

from mudline.basics.quantities import shown
from mudline.cli import DONE, FOUND, options
from mudline.cli.plots import Plot, plot_option
from mudline.cli.streams import emit, notify
from mudline.language.deck.loading import load_bytes
from mudline.language.keywords.fields import Comment
from mudline.language.keywords.library.seabed_curves import Embedment, SeabedStiffness
from mudline.language.keywords.model import Block
from mudline.language.keywords.writer import block_lines
from mudline.model.curves import CurveError, ForceCurve
from mudline.model.curves.backbones import MODELS, Backbone, Soil
from mudline.model.scene.deck_curves import OF_SEABED

if TYPE_CHECKING:
    from mudline.model.curves.points import FloatArray

_FINEST = 1e-5
_DRAWN = 400


def _strength(_context: click.Context, _parameter: click.Parameter, value: str) -> tuple[float, float]:
    """`su0` or `su0,gradient` as two numbers."""
    try:
        numbers = [float(field) for field in value.split(",")]
    except ValueError:
        numbers = []
    strength, gradient = (*numbers, 0.0, 0.0)[:2]
    if len(numbers) > 2 or not (0.0 < strength < math.inf and 0.0 <= gradient < math.inf):
        raise click.BadParameter(f"{value!r}: expected su0 > 0, or su0,gradient with a gradient >= 0")
    return strength, gradient


class Wanted(NamedTuple):
    """What is asked for.

    Attributes:
        name: of the curve, or of the set of `*EMBEDMENT`.
        depth: the largest ratio z/D.
        first: the smallest ratio above 0.
        tolerance: share of the largest force.
        legacy: whether to write `*EMBEDMENT`.
    """

    name: str
    depth: float
    first: float
    tolerance: float
    legacy: bool


@options.command("backbone")
@click.argument("model", type=click.Choice(list(MODELS)), metavar="MODEL")
@options.option("--diameter", type=float, required=True, metavar="D", help="External diameter of the pipe.")
@options.option(
    "--strength",
    callback=_strength,
    required=True,
    metavar="SU0[,GRADIENT]",
    help="Undrained shear strength at the mudline, and its increase per depth (default 0).",
)
@options.option("--weight", type=float, default=0.0, metavar="W", help="Submerged weight of the soil per volume.")
@options.option("--depth", type=float, metavar="RATIO", help="Largest ratio z/D (default: as far as published).")
@options.option(
    "--tolerance",
    type=click.FloatRange(_FINEST, 0.1),
    default=0.005,
    show_default=True,
    metavar="SHARE",
    help="Largest error of the interpolation, as a share of the largest force.",
)
@options.option(
    "--first",
    type=float,
    default=0.001,
    show_default=True,
    metavar="RATIO",
    help="Smallest ratio z/D of a point above 0; below it a straight line replaces the model, steep as it is there.",
)
@options.option("--name", metavar="NAME", help="Name of the curve, or of the set with --legacy (default: MODEL).")
@options.flag("--legacy", help="Write *EMBEDMENT in place of *SEABED STIFFNESS.")
@options.flag("--extend", help="Go on beyond the ratios for which the model is published.")
@plot_option("model and curve")
@options.common
def command(
    *,
    model: str,
    diameter: float,
    strength: tuple[float, float],
    weight: float,
    depth: float | None,
    first: float,
    name: str | None,
    plot: Plot,
    extend: bool,
    tolerance: float,
    legacy: bool,
) -> int:
    """Print the penetration resistance of a published MODEL as a *SEABED STIFFNESS block.

    MODEL: f114, skempton, aubeny, aubeny-rough, merifield, merifield-rough or randolph-quiggin. Numbers are in one
    system of units, as N and m; the points are as few as the tolerance needs.
    """
    chosen = MODELS[model]
    if not 0.0 < diameter < math.inf:
        raise click.UsageError(f"--diameter {diameter:g}: expected a number above 0")
    if not 0.0 <= weight < math.inf:
        raise click.UsageError(f"--weight {weight:g}: expected a submerged weight per volume, 0 or more")
    if weight and not chosen.weighs:
        raise click.UsageError("--weight: this model has no term of the soil's weight: leave it out")
    wanted = Wanted(
        name if name is not None else model,
        chosen.published if depth is None else depth,
        first,
        tolerance,
        legacy,
    )
    if not 0.0 < wanted.depth < math.inf:
        raise click.UsageError(f"--depth {wanted.depth:g}: expected a ratio z/D above 0")
    if not 0.0 <= first < wanted.depth:
        raise click.UsageError(f"--first {first:g}: expected a ratio z/D from 0 to below {wanted.depth:g}")
    if wanted.depth > chosen.published and not extend:
        end = f"{model} ends at z/D = {shown(chosen.published)}: {chosen.range_note}"
        notify(f"{end}. Give --extend to go on to {wanted.depth:g}")
        return FOUND
    backbone = Backbone(chosen, Soil(diameter, *strength, weight))
    with np.errstate(all="ignore"):
        if not 0.0 < backbone.largest(wanted.depth) < math.inf:
            raise click.UsageError("the force is too large or too small for a float64: check the units of the numbers")
        try:
            points = backbone.points(wanted.depth, wanted.tolerance, first)
        except OverflowError as error:
            raise click.UsageError(f"{error}: check the units of the numbers, --depth and --tolerance") from error
    text = _text(backbone, wanted, points)
    smooth = np.linspace(0.0, 1.0, _DRAWN) ** 2 * wanted.depth
    drawn = {"model": np.column_stack((smooth, backbone.force(smooth))), wanted.name: points} if plot.path else {}
    rows = [{"name": name, "kind": OF_SEABED, "points": given} for name, given in drawn.items()]
    plot.write(lambda plots: plots.curves_figure(rows, "user"))
    emit([text])
    return DONE


# ------------------------------------------------------------------------------------------------------------ block


def _text(backbone: Backbone, wanted: Wanted, points: FloatArray) -> str:
    """The block; raises click.UsageError for a name that a deck cannot have, and for points that are no curve."""
    try:
        ForceCurve(points)
    except CurveError as error:
        raise click.UsageError(f"--tolerance {wanted.tolerance:g} is too fine for this model: {error}") from error
    comments = [Comment(text=f" {line}", before=0) for line in _head(backbone, wanted, points)]
    curve, rows = "set" if wanted.legacy else "name", points.tolist()
    given = {"curves": [{curve: wanted.name, "points": rows}], "comments": comments}
    block: Block = (Embedment if wanted.legacy else SeabedStiffness).model_validate(given)
    text = "".join(f"{line}\n" for line in block_lines(block))
    # What a name may be is known to the reader alone.
    deck = load_bytes(f"$MODEL\n{text}".encode(), "backbone.keyxm")
    found = [curve for section in deck.sections for block in section.blocks for curve in getattr(block, "curves", ())]
    names = [getattr(curve, "set_name" if wanted.legacy else "name") for curve in found]
    if deck.problems or names != [wanted.name]:
        raise click.UsageError(f"--name {wanted.name!r}: a deck does not read this as a name: give letters and digits")
    return text


def _head(backbone: Backbone, wanted: Wanted, points: FloatArray) -> list[str]:
    """Source, parameters, error and range, as comments."""
    model, soil = backbone.model, backbone.soil
    largest = backbone.largest(wanted.depth)
    bound = 100.0 * wanted.tolerance
    steep = backbone.deviation(points[:2]) > wanted.tolerance * largest
    error = 100.0 * backbone.deviation(points[1:] if steep else points) / largest
    below = (
        f"; below z/D = {shown(wanted.first)} {100.0 * backbone.deviation(points[:2]) / largest:.2g} %" if steep else ""
    )
    weight = f", submerged weight of soil w {shown(soil.weight)}" if model.weighs else ""
    beyond = "; the last points are beyond it" if wanted.depth > model.published else ""
    return [
        f"{model.title}",
        f"Force per unit length: {model.formula}, r = z/D",
        f"D {shown(soil.diameter)}, s_u {shown(soil.strength)} + {shown(soil.gradient)} z{weight}",
        f"Error of interpolation: {error:.2g} % of the largest force {shown(largest)}, bound {bound:g} %{below}",
        f"Published for z/D from 0 to {shown(model.published)}: {model.range_note}{beyond}",
        "Ratios are z/D: penetration of the invert",
    ]
