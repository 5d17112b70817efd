"""Command `mudline backbone`: a force-embedment curve of a published model, as lines for a deck."""

from __future__ import annotations

import math
from typing import Any

import click
import numpy as np

from mudline.basics.quantities import shown
from mudline.cli import DONE, FOUND, options
from mudline.cli.plots import Plot, plot_option, write_plot
from mudline.cli.streams import emit, notify, refusing
from mudline.editing.backbone_block import COARSEST, FINEST, backbone
from mudline.language.keywords.writer import block_lines
from mudline.model.curves.backbones import MODELS, Backbone, Soil
from mudline.model.scene.curves import OF_SEABED

_DRAWN = 400


def _strength(_context: click.Context, _parameter: click.Parameter, value: str) -> tuple[float, float]:
    """Return `su0` or `su0,gradient` as two numbers."""
    try:
        numbers = [float(field) for field in value.split(",")]
    except ValueError:
        numbers = []
    strength, gradient = (*numbers, 0.0, 0.0)[:2]
    if len(numbers) > 2 or not (0.0 < strength < math.inf and 0.0 <= gradient < math.inf):
        raise click.BadParameter(f"{value!r}: expected su0 > 0, or su0,gradient with a gradient >= 0")
    return strength, gradient


@options.command("backbone")
@click.argument("model", type=click.Choice(list(MODELS)), metavar="MODEL")
@options.option("--diameter", type=float, required=True, metavar="D", help="External diameter of the pipe.")
@options.option(
    "--strength",
    callback=_strength,
    required=True,
    metavar="SU0[,GRADIENT]",
    help="Undrained shear strength at the mudline, and its increase with depth (default: 0).",
)
@options.option("--weight", type=float, default=0.0, metavar="W", help="Submerged unit weight of the soil.")
@options.option("--depth", type=float, metavar="RATIO", help="Largest ratio z/D (default: the published limit).")
@options.option(
    "--tolerance",
    type=click.FloatRange(FINEST, COARSEST),
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
    help="Smallest ratio z/D of a point above 0; below it a straight line with the slope there replaces the model.",
)
@options.option("--name", metavar="NAME", help="Name of the curve, or of the set with --legacy (default: MODEL).")
@options.flag("--legacy", help="Write *EMBEDMENT in place of *SEABED STIFFNESS.")
@options.flag("--extend", help="Continue beyond the ratios for which the model is published.")
@plot_option("model and curve")
@options.common
def command(*, model: str, plot: Plot, depth: float | None, extend: bool, **given: Any) -> int:  # noqa: ANN401 - as the function
    """Print the penetration resistance of a published MODEL as a *SEABED STIFFNESS block.

    MODEL: f114, skempton, aubeny, aubeny-rough, merifield, merifield-rough or randolph-quiggin. All numbers belong to
    one consistent system of units, such as N and m. The curve has as few points as the tolerance allows.
    """
    published = MODELS[model].published
    if depth is not None and published < depth < math.inf and not extend:
        end = f"{model} ends at z/D = {shown(published)}: {MODELS[model].range_note}"
        notify(f"{end}. Give --extend to go on to {depth:g}")
        return FOUND
    with refusing(ValueError, before="--"):
        curve, block = backbone(model, depth=depth, extend=extend, **given)
    if plot is not None:
        smooth = np.linspace(0.0, 1.0, _DRAWN) ** 2 * curve.ratios[-1]
        soil = Soil(given["diameter"], given["strength"][0], given["strength"][1], given["weight"])
        forces = Backbone(MODELS[model], soil).force(smooth)
        drawn = {"model": np.column_stack((smooth, forces)), curve.name: block.curves[0].points}
        rows = [{"name": name, "kind": OF_SEABED, "points": points} for name, points in drawn.items()]
        write_plot(plot, lambda plots: plots.curves.curves_figure(rows, "user"))
    emit(f"{line}\n" for line in block_lines(block))
    return DONE
