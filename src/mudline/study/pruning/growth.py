"""How time grows with the points of a curve, the curves, the sets, the planes and the steps."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING, Annotated, NamedTuple, TypeAlias

import numpy as np

from mudline.contact.input import ContactInput, LawAssignment
from mudline.contact.model import ContactModel
from mudline.curves import ForceCurve
from mudline.study import scene_of
from mudline.study.pictures import Picture, label, panels, style
from mudline.study.pruning.cost import streamed
from mudline.study.pruning.scenes import Pipe, Variant, everything, line, planes, positions, series
from mudline.study.report import Layout, Section, StudyOptions, columns_of, grouped
from mudline.study.timing import Spread, paired

if TYPE_CHECKING:  # only drawing needs matplotlib
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

NODES = 10_001
FEW_NODES = 1001
ELEMENTS = 2048
_DEEPEST = 0.5
UPPER_EXPONENT, ONE_MORE = "exponent, upper half", "time of one more [us]"
"""Headings of the table."""


Call: TypeAlias = Callable[[], object]


class Ladder(NamedTuple):
    """Sizes of one thing, and the call that is timed for each size."""

    sizes: Sequence[int]
    prepared: Callable[[Pipe, int], Call]


class GrowthRow(NamedTuple):
    """Seconds for a size of one thing, the rest kept."""

    what: Annotated[str, "number of"]
    size: Annotated[int, "size"]
    best: Annotated[float, "best time [s]"]
    lower: Annotated[float, "lower quartile [s]"]
    seconds: Annotated[float, "median time [s]"]
    upper: Annotated[float, "upper quartile [s]"]


class Fit(NamedTuple):
    """How seconds grow with the size.

    exponent: of a power law through all sizes.
    upper: of one through the larger half.
    unit: seconds that one more unit costs at the upper end.
    """

    what: Annotated[str, "number of"]
    least: Annotated[int, "from"]
    largest: Annotated[int, "to"]
    exponent: Annotated[float, "exponent"]
    upper: Annotated[float, UPPER_EXPONENT]
    factor: Annotated[float, "time, largest / smallest"]
    unit: float
    largest_seconds: Annotated[float, "time of the largest [s]"]


FITS = Layout[Fit]("growth", "How time grows", {**columns_of(Fit), ONE_MORE: lambda fit: 1e6 * fit.unit})
SIZES = Layout("sizes", "Time against size", columns_of(GrowthRow), brief=False)


def study_growth(pipe: Pipe, options: StudyOptions) -> Section:
    """All ladders, with fitted power laws."""
    rows = list(growth(pipe, options))
    found = list(fits(rows))
    return Section((FITS.table(found), SIZES.table(rows)), [growth_picture(rows, found)])


def growth_picture(rows: Sequence[GrowthRow], found: Sequence[Fit]) -> Picture:
    """Time against the size of one thing each, with the fitted slopes."""
    caption = "Time against size, with fitted power laws."
    return Picture("growth", caption, partial(_draw, rows, found), (12.0, 7.5))


def _draw(rows: Sequence[GrowthRow], found: Sequence[Fit], figure: Figure) -> None:
    ladders = grouped(rows, lambda row: row.what)
    for axes, fit in zip(panels(figure, len(found), 3), found, strict=True):
        sizes = [row.size for row in ladders[fit.what]]
        seconds = [1e3 * row.seconds for row in ladders[fit.what]]
        axes.loglog(sizes, seconds, label="measured", **style(0) | {"linestyle": "none"})
        _slope(axes, sizes, seconds, fit.exponent, "--", "all sizes")
        half = len(sizes) // 2
        _slope(axes, sizes[half:], seconds[half:], fit.upper, "-", "larger half")
        axes.set_ylim(0.25 * min(seconds), max(4.0 * max(seconds), 50.0 * min(seconds)))
        axes.set_xlim(0.8 * min(sizes), 1.25 * max(sizes))
        label(axes, f"Number of {fit.what}", "number [-]", "time [ms]")
        axes.legend(fontsize="small", loc="upper left")


def _slope(
    axes: Axes, sizes: Sequence[float], milliseconds: Sequence[float], exponent: float, dash: str, what: str
) -> None:
    """A power law through the middle of the points."""
    if not np.isfinite(exponent):
        return
    x, y = np.log(sizes), np.log(milliseconds)
    color = style(1 if dash == "--" else 2)["color"]
    axes.loglog(
        sizes, np.exp(y.mean() + exponent * (x - x.mean())), dash, color=color, label=f"{what}: exponent {exponent:.2f}"
    )


def growth(pipe: Pipe, options: StudyOptions) -> Iterator[GrowthRow]:
    """All ladders, the sizes of each in turns; longer by a factor of four with `full`."""
    ladders = [
        (what, [*sizes, *((4 * sizes[-1],) if options.full else ())], prepared)
        for what, (sizes, prepared) in LADDERS.items()
    ]
    for what, sizes, prepared in options.each(ladders, lambda ladder: f"{ladder[0]}: up to {ladder[1][-1]}"):
        for size, seconds in zip(sizes, paired([prepared(pipe, size) for size in sizes]), strict=True):
            yield GrowthRow(what, size, *Spread.of(seconds))


def fits(rows: Sequence[GrowthRow]) -> Iterator[Fit]:
    """One for each ladder."""
    for what, ladder in grouped(rows, lambda row: row.what).items():
        sizes, seconds = [float(row.size) for row in ladder], [row.seconds for row in ladder]
        factor = seconds[-1] / seconds[0]
        numbers = (exponent(sizes, seconds), upper_half(sizes, seconds), factor, per_unit(sizes, seconds))
        yield Fit(what, ladder[0].size, ladder[-1].size, *numbers, seconds[-1])


def exponent(sizes: Sequence[float], seconds: Sequence[float]) -> float:
    """Slope of the straight line through log(size), log(seconds), by least squares; NaN for less than two sizes."""
    if len(set(sizes)) < 2:
        return float("nan")
    x, y = np.log(np.asarray(sizes, np.float64)), np.log(np.asarray(seconds, np.float64))
    x = x - x.mean()
    return float((x * (y - y.mean())).sum() / (x * x).sum())


def upper_half(sizes: Sequence[float], seconds: Sequence[float]) -> float:
    """The same for the larger half of the sizes, where the constant part of the cost matters least."""
    start = len(sizes) // 2
    return exponent(sizes[start:], seconds[start:])


def per_unit(sizes: Sequence[float], seconds: Sequence[float]) -> float:
    """Seconds that one more unit costs at the largest size: the difference of the last two points."""
    if len(sizes) < 2:
        return float("nan")
    return (seconds[-1] - seconds[-2]) / (sizes[-1] - sizes[-2])


def spread(points: int, scale: float) -> ForceCurve:
    """A curve of this many points, graded towards the mudline."""
    ratios = _DEEPEST * np.linspace(0.0, 1.0, points) ** 2
    return ForceCurve(np.column_stack([ratios, scale * np.sqrt(ratios)]))


def _points(pipe: Pipe, size: int) -> Call:
    return _pressed(pipe, replace(line(pipe, NODES), curves=(spread(size, 1000.0),)))


def _curves(pipe: Pipe, size: int) -> Call:
    """Curves on consecutive parts of the line, as sets have them."""
    elements = np.arange(NODES - 1)
    law = LawAssignment("curve", elements, {"curve": elements * size // (NODES - 1)})
    made = tuple(spread(10, 1000.0 + number) for number in range(size))
    return _pressed(pipe, replace(line(pipe, NODES), laws=(law,), curves=made))


def _sets(pipe: Pipe, size: int) -> Call:
    """From reading the deck to its evaluator."""
    del pipe
    text = deck_with_sets(size, ELEMENTS)
    return lambda: scene_of(text, "sets.keyxm").contact()


def _planes(pipe: Pipe, size: int) -> Call:
    return _pressed(pipe, replace(line(pipe, NODES), seabed=planes(size, pipe.length * NODES)))


def _pressed(pipe: Pipe, inputs: ContactInput) -> Call:
    model = ContactModel(inputs)
    points = positions(Variant("", lambda _: inputs), inputs, pipe)
    return lambda: model.evaluate(points)


def _stepped(make: Callable[[Pipe, int], ContactInput]) -> Callable[[Pipe, int], Call]:
    def prepared(pipe: Pipe, size: int) -> Call:
        inputs = make(pipe, FEW_NODES)
        points = positions(Variant("", lambda _: inputs), inputs, pipe)
        return streamed(ContactModel(inputs), series(points, pipe, size))

    return prepared


LADDERS = {
    "points on the curve": Ladder((2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096), _points),
    "curves": Ladder((1, 2, 4, 8, 16, 32, 64, 128, 256, 512), _curves),
    "sets": Ladder((1, 2, 4, 8, 16, 32, 64, 128, 256, 512), _sets),
    "planes": Ladder((1, 2, 4, 8, 16, 32, 64, 128, 256), _planes),
    "steps, curve": Ladder((1, 2, 4, 8, 16, 32, 64, 128, 256), _stepped(line)),
    "steps, everything": Ladder((1, 2, 4, 8, 16, 32, 64), _stepped(everything)),
}


def deck_with_sets(sets: int, elements: int) -> str:
    """The text of a straight line on linear seabeds; the elements are divided among the sets."""
    edges = [number * elements // sets for number in range(sets + 1)]
    ranges = [(f"Part {number + 1}", first + 1, last) for number, (first, last) in enumerate(pairwise(edges))]
    sets_of = "".join(f" SET={name}\n GEN={first}, {last}\n" for name, first, last in ranges)
    stiffnesses = "".join(f" SET={name}\n STIFFNESS={50_000 + first}\n" for name, first, _ in ranges)
    return f"""\
$MODEL
*NODE
 1, -0.01, 0.0, 0.0
 {elements + 1}, -0.01, {2.0 * elements}, 0.0
 GEN=1, {elements + 1}
*ELEMENT
 1, 1, 2
 GEN=1, {elements}
*ELEMENT SETS
{sets_of}\
*GEOMETRIC SETS
 OPTION=RIGID
 SET=ALL
 207.0E9, 79.6E9, 0.3, 0.25, 7850.0
*SEABED PROPERTIES
 TYPE=ELASTIC
{stiffnesses}\
$LOAD CASE
*ANALYSIS TYPE
 TYPE=STATIC
"""
